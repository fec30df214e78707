#include <algorithm>
#include <catch2/catch.hpp>

#include "studies/analysis/requirements.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/analysis/study_notes.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright::studies;

TEST_CASE("A unit so soft that its misalignment is no small motion says so, and a stiff one does not", "[studies][analysis][unit]") {
  const auto is_said = [](const std::string& stiffness) {  // of one bearing [N/um]
    const Json results = study_texts::results_of(small::unit_pair() + small::unit(), {{"pinion.shaft.bearings.0.radial_stiffness", stiffness}});
    return std::ranges::any_of(results.at("notes"),
                               [](const Json& note) { return note.get<std::string>().find("misalign the pair by") != std::string::npos; });
  };
  CHECK(!is_said("800"));
  CHECK(is_said("0.01"));
}

TEST_CASE("Another stage of a unit whose shafts gape is named", "[studies][analysis][unit]") {
  const auto is_said = [](const std::string& position) {  // of one bearing of the input shaft, whose other one is at 20 mm
    const Json results = study_texts::results_of(small::unit_pair() + small::unit(), {{"unit.shafts.0.bearings.1.position", position},
                                                                                      {"unit.shafts.0.bearings.1.radial_stiffness", "5"},
                                                                                      {"unit.meshes.0.face_width_1", "20"},
                                                                                      {"unit.meshes.0.face_width_2", "20"}});
    return std::ranges::any_of(results.at("notes"),
                               [](const Json& note) { return note.get<std::string>().find("shafts misalign first by") != std::string::npos; });
  };
  CHECK(!is_said("150"));
  CHECK(is_said("21"));
}

TEST_CASE("A bearing in whose clearance the shaft floats is named with its shaft and the torque", "[studies][analysis][unit]") {
  const auto said = [](const std::string& clearance) {  // of a bearing between the others [um]
    const Json results = study_texts::results_of(
        small::unit_pair() + small::unit(),
        {{"load.torque", "[150, 300]"},
         {"pinion.shaft.bearings",
          "[{ position = 10, radial_stiffness = 800 }, { name = \"middle\", position = 90, radial_stiffness = 800, radial_clearance = " + clearance +
              " }, { position = 170, radial_stiffness = 400 }]"}});
    std::vector<std::string> found;
    for (const Json& note : results.at("notes")) {
      if (note.get<std::string>().find("carries nothing") != std::string::npos) found.push_back(note);
    }
    for (const Json& loaded : results.at("loaded")) CHECK(loaded.at("unit").at("bearings").at(1).at("carries").get<bool>() == found.empty());
    return found;
  };
  CHECK(said("0.1").empty());
  CHECK(said("500") ==
        std::vector<std::string>{"bearing \"middle\" of the shaft \"pinion\" carries nothing in scene \"nominal\" at 150 N·m and in 1 "
                                 "further load case: the shaft floats in its clearance of 500 um there, where small forces that the study "
                                 "leaves out, such as its weight, can move it"});
}

TEST_CASE("Thin slices that cannot be calibrated to ISO 6336-1 say so", "[studies][analysis]") {
  const auto is_said = [](const std::vector<Override>& overrides) {
    const std::string gear = "face_width = 1000\nprofile_shift = 0.5\nrack = { addendum = 0.5, dedendum = 0.65, root_radius = 0.1 }\n";
    const Study study =
        parse_study("[pair]\nnormal_module = 100\npressure_angle = 34\nhelix_angle = 20\n[pinion]\nteeth = 66\n" + gear + "[wheel]\nteeth = 71\n" +
                        gear + "[material]\npoissons_ratio = 0\n[load]\ntorque = 1e6\n[fidelity]\ncompliance = \"thin_slice\"\n",
                    "stub.toml", overrides);
    return std::ranges::any_of(study_notes(study, flankwright::make_gear_pair(study.pair)),
                               [](const std::string& note) { return note.find("cannot be calibrated to the standard") != std::string::npos; });
  };
  const Override stiff{"material.youngs_modulus", "1e7"};
  CHECK(!is_said({}));
  CHECK(is_said({stiff}));
  CHECK(!is_said({stiff, {"fidelity.compliance", "fitted"}}));
  CHECK(!is_said({stiff, {"load.torque", "0"}}));
}

TEST_CASE("A torque that no tooth bears is said to leave no small deflections", "[studies][analysis]") {
  const auto is_said = [](const std::string& torque) {
    const Json results = study_texts::results_of(small::helical_pair("", "", torque));
    return std::ranges::any_of(results.at("notes"),
                               [](const Json& note) { return note.get<std::string>().find("no small deflection") != std::string::npos; });
  };
  CHECK(!is_said("300"));
  CHECK(is_said("1e7"));
}

TEST_CASE("A film that is thinnest on a tip edge is shown beside that of the flanks", "[studies][analysis][life]") {
  const std::string oil =
      "[lubricant]\nviscosity_40 = 100\nviscosity_100 = 11\ntemperature = 80\nroughness = 0.5\n[load]\ntorque = 150\nspeed = 1500\n[fidelity]\ncompliance = \"thin_slice\"\n";
  const auto relieved_by = [&](const std::string& amount) {
    const std::string relief = "{ amount = " + amount + ", height = 1 }";
    return study_texts::results_of(small::spur_pair() + oil, {{"pinion.modification.tip_relief", relief}, {"wheel.modification.tip_relief", relief}});
  };
  const auto is_said = [](const Json& results) {
    return std::ranges::any_of(results.at("notes"), [](const Json& note) {
      return note.get<std::string>().find("the film is thinnest on a tip edge") != std::string::npos;
    });
  };
  const Json carrying = relieved_by("0"), clear = relieved_by("60");
  const Json &on_edge = carrying.at("life").at("cases")[0], &on_flank = clear.at("life").at("cases")[0];
  CHECK(is_said(carrying));
  CHECK_FALSE(is_said(clear));
  CHECK(on_edge.at("specific_film_thickness").get<double>() < on_edge.at("film_thickness_of_flanks").get<double>());
  CHECK(on_edge.at("contact_temperature_degC").get<double>() > on_edge.at("flank_temperature_degC").get<double>());
  CHECK(on_flank.at("specific_film_thickness") == on_flank.at("film_thickness_of_flanks"));
  CHECK(on_flank.at("contact_temperature_degC") == on_flank.at("flank_temperature_degC"));

  SECTION("and on a sharp edge, whose pressure is not known, it is said to be too favourable") {
    const Json sharp = study_texts::results_of(small::spur_pair() + oil, {{"pinion.edges.tip_rounding", "0"}, {"wheel.edges.tip_rounding", "0"}});
    CHECK_FALSE(is_said(sharp));
    CHECK(std::ranges::any_of(sharp.at("notes"), [](const Json& note) {
      return note.get<std::string>().find("contact reaches a sharp tip edge (scene \"nominal\", 150 N·m)") != std::string::npos;
    }));
  }
}

TEST_CASE("Teeth are not blamed for what soft bearings yield", "[studies][analysis][unit]") {
  const Json results = study_texts::results_of(small::unit_pair() + small::unit(), {{"pinion.shaft.bearings.0.radial_stiffness", "0.01"}});
  const double module = results.at("used").at("pair").at("normal_module_mm");
  REQUIRE(results.at("loaded")[0].at("summary").at("te_mean_um").get<double>() > 1e3 * 0.1 * module);  // as much as would be said of teeth
  for (const Json& note : results.at("notes")) CHECK(note.get<std::string>().find("no small deflection") == std::string::npos);
}

TEST_CASE("Shafts that move the flanks further than teeth can mesh over are a requirement that is not met", "[studies][analysis][requirements]") {
  using Catch::Contains;
  // Two bearings alike, at the same distance from the gear or not: it moves away from its mate, or tilts as well.
  const auto on_bearings = [](const std::string& stiffness, const std::string& gear_position) {
    return run_study(parse_study(
        small::helical_pair() +
            "[pinion.shaft]\nsections = [{ length = 200, outer_diameter = 80 }]\nbearings = [{ position = 10, radial_stiffness = " + stiffness +
            " }, { position = 190, radial_stiffness = " + stiffness + " }]\ngear_position = " + gear_position + "\ntorque_position = 0\n",
        "shaft.toml"));
  };
  CHECK(on_bearings("300", "60").requirements.empty());
  const StudyResults soft = on_bearings("0.01", "60");
  REQUIRE(soft.requirements.size() == 1);
  CHECK_THAT(soft.requirements.front(), Contains("300 N·m") && Contains("the teeth cannot mesh"));

  // Independent route: at mid span both springs bear half of the force in the plane of action, which the bent shaft hardly adds to.
  const StudyResults centred = on_bearings("0.1", "100");
  const std::optional<FlankMotion> motion = largest_flank_motion(centred, centred.loaded.front());
  REQUIRE(motion);
  const double spring = 100.0, in_plane = centred.loaded.front().torque / centred.pair.pinion.base_radius;  // N/mm, N
  CHECK_FALSE(motion->is_misalignment);
  CHECK(motion->motion == Approx(in_plane / (2.0 * spring)).epsilon(0.1));  // model: along the normal, axial force and its moment included
  CHECK(motion->limit == centred.pair.pinion.tip_radius + centred.pair.wheel.tip_radius - centred.pair.centre_distance);
  CHECK(centred.requirements.size() == (motion->excess() > 1.0 ? 1 : 0));
}

TEST_CASE("A key that acts only beside others is said to be unused without them", "[studies][analysis]") {
  const auto is_said = [](const std::string& study, const std::string& key, const std::string& value) {
    const Json results = study_texts::results_of(study, {{key, value}});
    return std::ranges::any_of(results.at("notes"),
                               [&](const Json& note) { return note.get<std::string>().find(key + " is not used") != std::string::npos; });
  };
  const std::string alone = small::helical_pair("", "", "300"), in_unit = small::unit_pair() + small::unit();
  CHECK(is_said(alone, "pinion.meshes_per_revolution", "2"));
  CHECK(is_said(alone, "unit.reference_torque", "300"));
  CHECK(!is_said(in_unit, "unit.reference_torque", "300"));
}

TEST_CASE("A table of another task is said to be unused where the study names no task", "[studies][analysis]") {
  const auto said = [](const std::string& table, const std::vector<Override>& overrides) {
    const Study study = study_texts::read(table, overrides);
    std::vector<std::string> found;
    for (const std::string& note : study_notes(study, flankwright::make_gear_pair(study.pair))) {
      if (note.find("but no task") != std::string::npos) found.push_back(note);
    }
    return found;
  };
  const std::string fit = "[fit]\nmax_iterations = 300\n", finest = "[accuracy.finest]\nintervals = 32\n";
  CHECK(said("", {}).empty());
  CHECK(said("[analyse]\ngradients = [\"misalignment.crossing\"]\n", {}).empty());
  CHECK(said(fit, {}) == std::vector<std::string>{"the study has [fit] but no task, so it is analysed: task = \"fit\" would use it"});
  CHECK(said(fit + finest, {}).size() == 2);
  CHECK(said(fit, {{"task", "analyse"}}).empty());
  CHECK(said(fit + finest, {{"task", "fit"}}).empty());
}
