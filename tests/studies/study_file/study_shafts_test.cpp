#include "studies/study_file/study_shafts.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "studies/compliance/study_compliance.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/axial_hold_note.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/studies/small_studies.hpp"

namespace flankwright::studies {
namespace {

using json = Json;

constexpr double shaft_round_off = 1e-14;

const std::string pair_text = small::helical_pair();

const std::string shaft_text = R"([pinion.shaft]
sections = [{ length = 80, outer_diameter = 50 }, { length = "100 mm", outer_diameter = 60, inner_diameter = 20 }]
bearings = [{ position = 10, radial_stiffness = 800 }, { position = 170, radial_stiffness = "400 kN/mm", tilting_stiffness = 5 }]
gear_position = 90
torque_position = 0
)";

Study read_shafts(const std::string& text, const std::vector<Override>& overrides = {}) { return parse_study(text, "shaft.toml", overrides); }

json run_shafts(const std::string& text, const std::vector<Override>& overrides = {}) {
  return json::parse(results_json(run_study(read_shafts(text, overrides))));
}

const json& effect(const json& results, const std::string& name) {
  for (const json& one : results.at("effects")) {
    if (one.at("name") == name) return one;
  }
  throw std::runtime_error(name);
}

/// The problems of a study that must be refused.
std::vector<StudyProblem> shaft_problems(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    read_shafts(text, overrides);
  } catch (const StudyErrors& errors) {
    return errors.problems();
  }
  return {};
}

}  // namespace

TEST_CASE("A shaft under axial force that no given bearing holds axially is held by its first, and a note says so", "[studies][shafts][notes]") {
  using Catch::Contains;
  const std::string pair =
      "[pair]\nnormal_module = 4\nhelix_angle = {}\n[pinion]\nteeth = 20\nface_width = 30\n[wheel]\nteeth = 40\nface_width = 30\n[load]\ntorque = 100\n";
  const std::string shaft = "[pinion.shaft]\nsections = [{ length = 120, outer_diameter = 40 }]\ngear_position = 60\ntorque_position = 0\n";
  const auto notes = [&](const std::string& helix, const std::string& bearings) {
    std::string text = pair;
    text.replace(text.find("{}"), 2, helix);
    return axial_hold_notes(parse_study(text + shaft + "bearings = [" + bearings + "]\n", "held.toml"));
  };
  const std::string free = "{ position = 10, name = \"A\" }, { position = 110 }";
  REQUIRE(notes("15", free).size() == 1);
  CHECK_THAT(notes("15", free).front(), Contains("\"pinion\"") && Contains("bearing \"A\" at 10 mm") && Contains("rigidly along its axis"));
  CHECK(notes("0", free).empty());  // nothing pushes it
  CHECK(notes("15", "{ position = 10 }, { position = 110, axial_stiffness = 200 }").empty());
}

TEST_CASE("A shaft is read with its units, the gear's material and one bearing that holds axially", "[studies][shaft]") {
  const Study study = read_shafts(pair_text + shaft_text, {{"material.youngs_modulus", "210000"}});
  REQUIRE(study.shaft.pinion);
  CHECK_FALSE(study.shaft.wheel);
  const ShaftData& shaft = *study.shaft.pinion;
  REQUIRE(shaft.sections.size() == 2);
  CHECK(shaft.sections[0].outer_diameter == 50.0);
  CHECK(shaft.sections[0].inner_diameter == 0.0);
  CHECK(shaft.sections[1].length == 100.0);
  CHECK(shaft.sections[1].inner_diameter == 20.0);
  REQUIRE(shaft.bearings.size() == 2);
  CHECK(shaft.bearings[0].radial_stiffness == Approx(8e5).epsilon(shaft_round_off));
  CHECK(shaft.bearings[1].radial_stiffness == Approx(4e5).epsilon(shaft_round_off));
  CHECK(shaft.bearings[1].tilting_stiffness == Approx(5e3).epsilon(shaft_round_off));
  CHECK(std::isinf(shaft.bearings[0].axial_stiffness));
  CHECK(shaft.bearings[1].axial_stiffness == 0.0);
  CHECK(shaft.gear_stiffens);
  CHECK(shaft.material.youngs_modulus == 210000.0);
  CHECK_FALSE(read_shafts(pair_text + shaft_text + "gear_stiffens = \"no\"\n").shaft.pinion->gear_stiffens);
  CHECK(read_shafts(pair_text + shaft_text, {{"pinion.shaft.bearings.1.axial_stiffness", "5"}}).shaft.pinion->bearings[0].axial_stiffness == 0.0);
}

TEST_CASE("A shaft is no thicker than the gear that it runs through", "[studies][shaft]") {
  const std::vector<StudyProblem> problems = shaft_problems(pair_text + shaft_text, {{"pinion.shaft.sections.1.outer_diameter", "5000"}});
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().key == "pinion.shaft.sections.1.outer_diameter");
  CHECK_THAT(problems.front().allowed, Catch::Contains("the tip diameter of the gear"));
}

TEST_CASE("Impossible shafts are refused with their position in the file", "[studies][shaft]") {
  CHECK(shaft_problems(pair_text + shaft_text).empty());
  const int lines = static_cast<int>(std::count(pair_text.begin(), pair_text.end(), '\n'));
  struct Case {
    std::string from, to, key;
    int line;  ///< of the shaft's table
  };
  const Case wrong = GENERATE(Case{", outer_diameter = 50 ", " ", "pinion.shaft.sections.0.outer_diameter", 2},
                              Case{"inner_diameter = 20", "inner_diameter = 70", "pinion.shaft.sections.1.inner_diameter", 2},
                              Case{"length = 80", "lenght = 80", "pinion.shaft.sections.0.lenght", 2},
                              Case{"position = 170", "position = 190", "pinion.shaft.bearings.1.position", 3},
                              Case{"gear_position = 90", "gear_position = 10", "pinion.shaft.gear_position", 4},
                              Case{"torque_position = 0", "torque_position = 95", "pinion.shaft.torque_position", 5},
                              Case{"torque_position = 0", "", "pinion.shaft.torque_position", 1},
                              Case{"[{ position = 10, radial_stiffness = 800 }, ", "[", "pinion.shaft.bearings", 3});
  std::string text = shaft_text;
  const std::size_t at = text.find(wrong.from);
  REQUIRE(at != std::string::npos);
  text.replace(at, wrong.from.size(), wrong.to);
  if (wrong.key.ends_with("bearings")) text.replace(text.find(", tilting_stiffness = 5"), 23, "");
  CAPTURE(text);
  const std::vector<StudyProblem> problems = shaft_problems(pair_text + text);
  REQUIRE_FALSE(problems.empty());
  CHECK(problems.front().key == wrong.key);
  CHECK(problems.front().line == lines + wrong.line);
}

TEST_CASE("The effect shafts is on where a shaft is described and loaded, with its reason", "[studies][shaft]") {
  const json rigid = run_shafts(pair_text), with = run_shafts(pair_text + shaft_text);
  CHECK(effect(rigid, "shafts").at("on") == false);
  CHECK(effect(with, "shafts").at("on") == true);
  CHECK(effect(with, "shafts").at("seconds").get<double>() >= 0.0);
  CHECK_FALSE(rigid.at("loaded")[0].contains("shafts"));
  CHECK(with.at("used").at("pair").at("pinion").at("shaft").at("bearings")[0].at("axial_stiffness_N_per_um") == "rigid");
  CHECK(with.at("used").at("pair").at("wheel").at("shaft") == false);
  // Shafts yield beside the teeth: the wheel lags further by what they move, and only where they are on.
  const double lag =
      with.at("loaded")[0].at("summary").at("te_mean_um").get<double>() - rigid.at("loaded")[0].at("summary").at("te_mean_um").get<double>();
  CHECK(lag > 0.0);
  const json& motion = with.at("loaded")[0].at("shafts");
  REQUIRE(motion.size() == 4);
  double moved = 0.0;
  for (const json& position : motion) {
    moved += position.at("pinion").at("displacement_um").get<double>() / 4;
    CHECK(position.at("wheel").is_null());
    CHECK(position.at("mesh_misalignment_um") == position.at("pinion").at("misalignment_um"));
  }
  CHECK(lag == Approx(moved).epsilon(0.1));  // model: the motion of one place stands for all, along the normal
  const json off = run_shafts(
      pair_text + shaft_text,
      {{"fidelity.effects", "[\"bending\", \"hertzian_contact\", \"free_ends\", \"tip_corner\", \"extended_contact_region\", \"edge_contact\"]"}});
  CHECK(effect(off, "shafts").at("on") == false);
  CHECK(off.at("loaded")[0].at("summary").at("te_mean_um") == rigid.at("loaded")[0].at("summary").at("te_mean_um"));
  const std::vector<StudyProblem> problems = shaft_problems(pair_text, {{"fidelity.effects", "[\"bending\", \"shafts\"]"}});
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().key == "fidelity.effects");
}

TEST_CASE("K_Hbeta counts the deflection of the shafts, K_Halpha does not", "[studies][shaft][load-factors]") {
  // A soft bearing tilts a stiff shaft, so that the mesh opens linearly along the face.
  const std::vector<Override> located{
      {"cycle.peaks", "\"refined\""}, {"load.torque", "300"}, {"fidelity.quadrature", "{ rule = \"graded\", intervals = 10 }"}};
  std::vector<Override> tilted = located, given = located;
  for (const char* diameter : {"pinion.shaft.sections.0.outer_diameter", "pinion.shaft.sections.1.outer_diameter"})
    tilted.push_back({diameter, "72"});
  tilted.push_back({"pinion.shaft.bearings.0.radial_stiffness", "60"});
  const json with = run_shafts(pair_text + shaft_text, tilted).at("loaded").at(0).at("summary");
  const double opened = with.at("shaft_misalignment_um");
  REQUIRE(std::abs(opened) > 5.0);
  // The same misalignment on rigid shafts.
  given.push_back({"misalignment.mesh_misalignment", std::to_string(opened)});
  const json by_hand = run_shafts(pair_text, given).at("loaded").at(0).at("summary");
  for (const char* by : {"without_spikes", "line_load"}) {
    const json &here = with.at("load_factors").at(by), &there = by_hand.at("load_factors").at(by);
    const double factor = here.at("K_Hbeta"), same = there.at("K_Hbeta");
    CAPTURE(by, factor, same, opened);
    CHECK(same > 1.1);
    CHECK(factor - 1.0 == Approx(same - 1.0).epsilon(0.2));  // model: torsion curves the line of the shaft, and f_sh is a mean over the cycle
    CHECK(here.at("K_Halpha") == 1.0);
    CHECK(here.at("K_H") == here.at("K_Hbeta"));
  }
  // To ISO there is nothing else along the face.
  constexpr double digits = 1e-6;  // of std::to_string()
  CHECK(with.at("iso6336").at("F_beta_y_um").get<double>() == Approx(std::abs(opened)).epsilon(1e-9));
  CHECK(with.at("iso6336").at("K_Hbeta").get<double>() == Approx(by_hand.at("iso6336").at("K_Hbeta").get<double>()).epsilon(digits));
}

TEST_CASE("The best lead slope takes back what the shafts do", "[studies][shaft][physics]") {
  // Thin enough to open the mesh by some 20 um; one gear is corrected for both.
  const json results = run_shafts("task = \"optimise\"\n" + pair_text + shaft_text +
                                      "[optimise.variables]\n\"pinion.modification.lead_slope\" = [-60, 60]\n"
                                      "\"pinion.modification.lead_crowning\" = [0, 40]\n",
                                  {{"pinion.face_width", "60"},
                                   {"wheel.face_width", "60"},
                                   {"load.torque", "700"},
                                   {"cycle.positions", "8"},
                                   {"pinion.shaft.sections.0.outer_diameter", "45"},
                                   {"pinion.shaft.sections.1.outer_diameter", "50"},
                                   {"pinion.shaft.gear_stiffens", "no"},
                                   {"fidelity.quadrature.intervals", "10"}});
  const json& optimise = results.at("optimise");
  const double slope = optimise.at("after").at("variables").at("pinion.modification.lead_slope").get<double>();
  const json& after = results.at("loaded").back();
  REQUIRE(after.at("design") == "after");
  const double opened = after.at("summary").at("shaft_misalignment_um").get<double>();
  CHECK(opened > 10.0);
  CHECK(slope == Approx(-opened).epsilon(0.1));  // model: the shaft's line is not quite straight
  CHECK(optimise.at("after").at("objective").get<double>() < 0.85 * optimise.at("before").at("objective").get<double>());
}

TEST_CASE("Finite elements leave their torsion to start where the study's torque leaves the gear", "[studies][shaft][fe]") {
  const auto task = [](const std::string& text, Member member, const std::vector<Override>& overrides = {}) {
    std::vector<Override> all = overrides;
    all.push_back({"fidelity.compliance", "fe"});
    const Study study = read_shafts(text, all);
    return influence_table_task(compliance_task(study, make_gear_pair(study.pair)), member);
  };
  const auto end = [&](auto&&... of) { return task(of...).gear.body.torque_end; };
  using Overrides = std::vector<Override>;
  // The acute end of a right-hand pinion is at +b/2, its mate's at -b/2.
  CHECK(end(pair_text, Member::Pinion) == FaceEnd::Obtuse);
  CHECK(end(pair_text + shaft_text, Member::Pinion) == FaceEnd::Obtuse);
  CHECK(end(pair_text + shaft_text, Member::Wheel) == FaceEnd::Obtuse);
  CHECK(end(pair_text + shaft_text, Member::Pinion, Overrides{{"pinion.shaft.torque_position", "180"}}) == FaceEnd::Acute);
  CHECK(end(pair_text + shaft_text, Member::Pinion, Overrides{{"pair.working_flank", "left"}}) == FaceEnd::Acute);
  // Its bearings hold it axially.
  CHECK(task(pair_text, Member::Pinion).removed == RemovedRigidMotion::TranslationTorsionAndTilt);
  CHECK(task(pair_text + shaft_text, Member::Pinion).removed == RemovedRigidMotion::WholeTranslationTorsionAndTilt);
}

TEST_CASE("Errors of single teeth are read as lists, one value a tooth", "[studies][shaft]") {
  std::string values = "[1, -2, 3";
  for (int tooth = 3; tooth < 21; ++tooth) values += ", 0";
  values += "]";
  const Study study = read_shafts(pair_text + "[pinion.error]\nhelix_slope = " + values + "\nprofile_slope = 5\ntwist = " + values + "\n");
  CHECK(study.error.pinion.helix_slope == 0.0);
  REQUIRE(study.error.pinion.helix_slopes.size() == 21);
  CHECK(study.error.pinion.helix_slopes[1] == Approx(-0.002).epsilon(shaft_round_off));
  CHECK(study.error.pinion.profile_slope == Approx(0.005).epsilon(shaft_round_off));
  CHECK(study.error.pinion.profile_slopes.empty());
  CHECK(study.error.pinion.twists[2] == Approx(0.003).epsilon(shaft_round_off));
  for (const char* key : {"helix_slope", "profile_slope", "twist", "pitch"}) {
    const std::vector<StudyProblem> problems = shaft_problems(pair_text + "[pinion.error]\n" + key + " = [1, 2, 3]\n");
    REQUIRE(problems.size() == 1);
    CHECK(problems.front().key == std::string("pinion.error.") + key);
  }
}

}  // namespace flankwright::studies
