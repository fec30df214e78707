#include "studies/exchange/rexs/rexs_import.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "core/base/units.hpp"
#include "core/flank/measured_grid.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/study_file/grid_file.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/exchange/rexs/rexs_export.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/exchange/rexs/gear_train.hpp"
#include "tests/studies/exchange/rexs/small_rexs.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using Catch::Contains;
using study_texts::replaced;
using namespace small_rexs;

namespace {

Study study_of(const rexs::ImportedStudy& imported) { return parse_study(imported.text, "gears.toml"); }

/// The small file with modifications at the working flank of the pinion: components 20, 21 ...
std::string modified(const std::vector<std::string>& components) {
  std::string more, relations;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const std::string id = std::to_string(20 + i);
    more += "<component id=\"" + id + "\" " + components[i] + "</component>\n";
    relations +=
        "<relation id=\"" + id + "\" type=\"reference\"><ref id=\"6\" role=\"origin\"/><ref id=\"" + id + "\" role=\"referenced\"/></relation>\n";
  }
  return small_file(more, relations);
}

constexpr double round_off = 1e-12;

}  // namespace

TEST_CASE("A file of two stages needs a choice, and gives either", "[studies][rexs][import]") {
  const std::string text = sample_file("two_stages.rexs");
  CHECK_THAT(refusal(text), Contains("--stage 1 (cylindrical_stage 10") && Contains("cylindrical_gear 7 with 21 teeth"));
  CHECK_THAT(refusal(text, {.stage = 3}), Contains("--stage = 3") && Contains("--stage 2"));

  const Study first = study_of(import_text(text, {.stage = 1}));
  CHECK(first.pair.pinion.teeth == 19);
  CHECK(first.pair.wheel.teeth == 47);
  CHECK(first.pair.pinion_hand == Hand::Right);
  CHECK(first.torques == std::vector{420e3});

  const rexs::ImportedStudy second = import_text(text, {.stage = 2});
  const Study study = study_of(second);
  CHECK(study.pair.normal_module == 6.0);
  CHECK(study.pair.pinion.teeth == 21);
  CHECK(study.pair.wheel.teeth == 38);
  CHECK(study.pair.pinion_hand == Hand::Left);
  CHECK(study.pair.helix_angle == Approx(10 * units::deg).epsilon(round_off));
  CHECK(study.pair.centre_distance == 180.0);
  CHECK(study.pair.pinion.profile_shift == 0.12);
  CHECK(study.material.pinion.youngs_modulus == 208000.0);
  // A tip diameter of 1 mm is a placeholder, and said to be none.
  CHECK(std::isnan(study.pair.pinion.tip_diameter));
  REQUIRE(second.warnings.size() == 1);
  CHECK_THAT(second.warnings.front(), Contains("cylindrical_gear 7 tip_diameter = 1 mm") && Contains("not taken"));
  CHECK_THAT(second.text, Contains("#   - cylindrical_gear 7 tip_diameter = 1 mm"));
  // Power flows from shaft to shaft through the first stage; a load case each, with its share of time.
  REQUIRE(study.scenes.size() == 3);
  CHECK(study.scenes[1].torques.front() == Approx(260e3 * 47 / 19).epsilon(round_off));
  CHECK(study.scenes[1].weight == 0.6);
  CHECK_THAT(second.text, Contains("external_load 30 torque_around_u_axis, through cylindrical_stage 10"));
  CHECK(import_text(text, {.stage = 11}).text == second.text);
}

TEST_CASE("A planetary gear unit gives sun and planet, and reports missing data", "[studies][rexs][import]") {
  const std::string text = sample_file("planetary.rexsj");
  const rexs::ImportedStudy imported = import_text(text, {.stage = 1});
  const Study study = study_of(imported);
  CHECK(study.pair.pinion.teeth == 17);
  CHECK(study.pair.wheel.teeth == 22);
  CHECK(study.modification.pinion.lead_crowning == Approx(0.004).epsilon(round_off));
  CHECK(study.modification.pinion.lead_slope == Approx(-0.007).epsilon(round_off));
  CHECK(study.modification.wheel == Modification{});
  CHECK(study_of(import_text(text, {.stage = 1, .slope_end = rexs::SlopeEnd::DatumFace})).modification.pinion.lead_slope ==
        -study.modification.pinion.lead_slope);
  // The sun's torque is shared by three planets, how the file does not say.
  CHECK(study.torques == std::vector{0.0});
  CHECK_THAT(imported.text, Contains("not give the torque"));
  // Every attribute of the stage that was not taken is named.
  CHECK_THAT(imported.not_taken, Contains("cylindrical_stage 11:") && Contains("tooth_tip_chamfer") && Contains("10 x coupling"));
  CHECK_THAT(imported.text, Contains("of cylindrical_stage") && Contains("10 x coupling"));
  CHECK_THAT(refusal(text, {.stage = 4}), Contains("ring_gear 58") && Contains("internal gears are not modelled"));
}

TEST_CASE("The external meshes of a planetary gear unit are imported, the internal ones are named", "[studies][rexs][import]") {
  const std::string text = sample_file("planetary.rexsj");
  const rexs::UnitImport all = rexs::import_unit(text, "planetary.rexsj", {.grid_stem = "s"});
  REQUIRE(all.stages.size() == 3);
  for (const auto& [number, study] : all.stages) {
    CHECK(study_of(study).pair.pinion.teeth == 17);
    CHECK(study.text == rexs::import_stage(text, "planetary.rexsj", {.stage = number, .grid_stem = rexs::stem_of_stage("s", number)}).text);
  }
  REQUIRE(all.left_out.size() == 1);  // three stages for one reason
  CHECK_THAT(all.left_out.front(), Contains("cylindrical_stage 15, 16, 17: ring_gear 58") && Contains("internal gears are not modelled"));
}

TEST_CASE("The same stage in other units is the same study", "[studies][rexs][import][units]") {
  std::string text = modified({"type=\"tip_relief\">" + attribute("tip_relief_depth", "0.025") + attribute("tip_relief_datum_diameter", "85")});
  const Study study = study_of(import_text(text));
  CHECK(study.modification.pinion.tip_relief.amount == Approx(0.025).epsilon(round_off));
  CHECK(study.modification.pinion.tip_relief.height == Approx(1.5).epsilon(round_off));  // d_a = 88 mm
  text = replaced(text, attribute("tip_relief_depth", "0.025"), attribute("tip_relief_depth", "25", "mum"));
  text = replaced(text, attribute("tip_relief_datum_diameter", "85"), attribute("tip_relief_datum_diameter", "0.085", "m"));
  text = replaced(text, attribute("normal_module", "4"), attribute("normal_module", "0.4", "cm"));
  text = replaced(text, attribute("helix_angle_reference_diameter", "0", "deg"), attribute("helix_angle_reference_diameter", "0", "\xc2\xb0"));
  const Study other = study_of(import_text(text));
  CHECK(other.pair.normal_module == Approx(study.pair.normal_module).epsilon(round_off));
  CHECK(other.modification.pinion.tip_relief.amount == Approx(0.025).epsilon(round_off));
  CHECK(other.modification.pinion.tip_relief.height == Approx(1.5).epsilon(round_off));
}

TEST_CASE("Ends and flanks follow the datum face", "[studies][rexs][import]") {
  const std::vector<std::string> at_flank{"type=\"helix_slope\">" + attribute("helix_slope", "0.010"),
                                          "type=\"profile_twist\">" + attribute("profile_twist", "0.003")};
  const std::string negative = modified(at_flank);
  const Modification from_low = study_of(import_text(negative)).modification.pinion;
  CHECK(from_low.lead_slope == Approx(0.010).epsilon(round_off));
  CHECK(from_low.twist == Approx(0.003).epsilon(round_off));
  // The datum face at the other end: what was seen as the right flank is now the left one, and both amounts turn round.
  std::string positive = replaced(negative, "role=\"left\"", "role=\"held\"");
  positive = replaced(positive, "role=\"right\"", "role=\"left\"");
  positive = replaced(positive, "role=\"held\"", "role=\"right\"");
  for (const std::string id : {"2", "3"}) {
    const std::string start = "<component id=\"" + id + "\" type=\"cylindrical_gear\">\n";
    positive = replaced(positive, start, start + attribute("datum_face_orientation", "positive", "none"));
  }
  const Modification from_high = study_of(import_text(positive)).modification.pinion;
  CHECK(from_high.lead_slope == -from_low.lead_slope);
  CHECK(from_high.twist == -from_low.twist);
}

TEST_CASE("Amounts of another range are carried on to the borders of the flank", "[studies][rexs][import]") {
  const auto flank = [](const std::string& component) { return study_of(import_text(modified({component}))).modification.pinion; };
  // Crowning 8 um at 10 mm off centre is 32 um at the ends of a 40 mm face: a parabola.
  CHECK(flank("type=\"helix_crowning\">" + attribute("helix_crowning_amount_datum_face", "0.008") +
              attribute("helix_crowning_amount_non_datum_face", "0.008") +
              attribute("coordinate_where_helix_crowning_is_specified_datum_face", "-10") +
              attribute("coordinate_where_helix_crowning_is_specified_non_datum_face", "10"))
            .lead_crowning == Approx(0.032).epsilon(round_off));
  // K = 1e-4/mm from the apex at z = 4: C = K 20^2, slope -2 K 4 b.
  const Modification off_centre = flank("type=\"helix_crowning\">" + attribute("helix_crowning_amount_datum_face", "0.0576") +
                                        attribute("helix_crowning_amount_non_datum_face", "0.0256") + attribute("helix_highest_point", "4"));
  CHECK(off_centre.lead_crowning == Approx(1e-4 * 400.0).epsilon(round_off));
  CHECK(off_centre.lead_slope == Approx(-2e-4 * 4.0 * 40.0).epsilon(round_off));
  CHECK(flank("type=\"helix_slope\">" + attribute("helix_slope", "0.010") + attribute("helix_evaluation_start", "-16") +
              attribute("helix_evaluation_end", "16"))
            .lead_slope == Approx(0.0125).epsilon(round_off));
  // Linear relief from d = 84 to 88 mm, 10 um at d = 86.
  CHECK(flank("type=\"tip_relief\">" + attribute("tip_relief_depth", "0.010") + attribute("tip_relief_datum_diameter", "84") +
              attribute("tip_relief_evaluation_reference", "86"))
            .tip_relief.amount == Approx(0.020).epsilon(round_off));
  // By roll length from the tip: the radius where the involute is that much shorter.
  const double rb = 40.0 * std::cos(20 * units::deg), roll = std::sqrt(44.0 * 44.0 - rb * rb) - 5.0;
  CHECK(flank("type=\"tip_relief\">" + attribute("tip_relief_depth", "0.010") + attribute("tip_relief_datum_length", "5")).tip_relief.height ==
        Approx(44.0 - std::hypot(rb, roll)).epsilon(1e-9));
}

TEST_CASE("A triangular relief is taken to start along a line of contact", "[studies][rexs][import]") {
  const std::string component = "type=\"triangular_tip_relief\">" + attribute("triangular_tip_relief_depth", "0.02") +
                                attribute("triangular_tip_relief_datum_diameter", "85") + attribute("shape_of_relief", "parabolic", "none");
  const std::string spur = modified({component});
  CHECK_THAT(import_text(spur).warnings.front(), Contains("lines of contact of a spur gear cut off no corner"));
  const auto helical = [&](const std::string& file) {
    return replaced(replaced(file, attribute("helix_angle_reference_diameter", "0", "deg"), attribute("helix_angle_reference_diameter", "20", "deg")),
                    attribute("helix_angle_reference_diameter", "0", "deg"), attribute("helix_angle_reference_diameter", "-20", "deg"));
  };
  const rexs::ImportedStudy imported = import_text(helical(spur));
  const Study study = study_of(imported);
  const ProfileRelief& relief = study.modification.pinion.triangular_tip_relief;
  CHECK(relief.amount == Approx(0.02).epsilon(1e-12));
  CHECK(make_gear_pair(study.pair).pinion.tip_form_radius - relief.height == Approx(42.5).epsilon(1e-9));  // the file's datum diameter
  CHECK(relief.shape == ReliefShape::Parabolic);
  CHECK(std::ranges::none_of(imported.warnings, [](const std::string& warning) { return warning.find("triangular") != std::string::npos; }));
  CHECK_THAT(imported.text, Contains("taken to start along a line of contact, at the corner z = "));
}

TEST_CASE("Data without a key of a study are named", "[studies][rexs][import]") {
  const std::string component =
      GENERATE("type=\"triangular_tip_relief\">" + attribute("triangular_tip_relief_depth", "0.01"),
               "type=\"tip_relief\">" + attribute("tip_relief_depth", "0.01") + attribute("tip_relief_datum_diameter", "85") +
                   attribute("shape_of_relief", "logarithmic", "none"),
               "type=\"tip_relief\">" + attribute("tip_relief_depth", "0.01") + attribute("tip_relief_datum_diameter", "99"),
               "type=\"tip_relief\">" + attribute("tip_relief_depth", "0.01"),
               "type=\"end_relief_datum_face\">" + attribute("end_relief_depth_datum_face", "0.01") + attribute("end_relief_length_datum_face", "5") +
                   attribute("shape_of_relief", "exponential", "none"),
               "type=\"topographical_modification\">" + attribute("coordinates_of_topographical_modification", "<array><c>1</c></array>"));
  CAPTURE(component);
  const rexs::ImportedStudy imported = import_text(modified({component}));
  CHECK(study_of(imported).modification.pinion == Modification{});
  REQUIRE(imported.warnings.size() == 1);
  CHECK_THAT(imported.warnings.front(), Contains(" 20: not taken, "));
  CHECK_THAT(imported.text, Contains("#   - " + imported.warnings.front()));
}

TEST_CASE("Equal end reliefs are one, modifications of one kind add up", "[studies][rexs][import]") {
  const Modification m =
      study_of(
          import_text(modified({
              "type=\"end_relief_datum_face\">" + attribute("end_relief_depth_datum_face", "0.01") + attribute("end_relief_length_datum_face", "5"),
              "type=\"end_relief_non_datum_face\">" + attribute("end_relief_depth_non_datum_face", "0.01") +
                  attribute("end_relief_length_non_datum_face", "5"),
              "type=\"helix_slope\">" + attribute("helix_slope", "0.004"),
              "type=\"helix_slope\">" + attribute("helix_slope", "0.003"),
          })))
          .modification.pinion;
  CHECK(m.end_relief.amount == Approx(0.010).epsilon(round_off));
  CHECK(m.end_relief.length == 5.0);
  CHECK(m.lead_slope == Approx(0.007).epsilon(round_off));
}

namespace {

/// Deepest departure of the imported grid's surface from a removal, at 21 x 21 places between the lines of the grid [mm].
template <typename Removed>
double worst_departure(const rexs::ImportedStudy& imported, const Removed& removed) {
  REQUIRE(imported.grids.size() == 1);
  const GearPair pair = make_gear_pair(parse_study(study_texts::replaced(imported.text, "grid = ", "# grid = "), "gears.toml").pair);
  const auto field = make_grid_field(parse_grid(imported.grids.front().text, "g"), pair.pinion.base_radius, pair.base_helix_angle).field;
  double worst = 0.0;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const double r = std::lerp(pair.pinion.active_root_radius, pair.pinion.tip_radius, (i + 0.37) / 21.0), z = 40.0 * ((j + 0.37) / 21.0 - 0.5);
      worst = std::max(worst, std::abs(field->at(pair.pinion.roll_length_at(r), z).value - removed(r, z)));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("Modifications without a key become a grid, and its departure is reported", "[studies][rexs][import]") {
  constexpr double smooth = 1e-9;         // [mm] a parabola is a cubic spline's own; decimals of the table
  constexpr double beside_a_kink = 1e-4;  // [mm] discretisation: slope 2 um/mm jumps between lines half a millimetre apart
  const auto relief = [](double amount, double share) { return share > 0.0 ? amount * share : 0.0; };
  {
    const auto imported = import_text(modified({"type=\"helix_crowning\">" + attribute("helix_crowning_amount_datum_face", "0.01") +
                                                attribute("helix_crowning_amount_non_datum_face", "0.02")}));
    // The curvature jumps at mid face, a line of the grid.
    CHECK(worst_departure(imported, [](double, double z) { return (z < 0.0 ? 0.01 : 0.02) * z * z / 400.0; }) < 1e-6);
    CHECK_THAT(imported.warnings.front(),
               Contains("helix_crowning 20: taken as a grid of 3 radii and 81 axial positions") && Contains("departs from it by at most "));
  }
  const auto one_end = import_text(modified({"type=\"end_relief_non_datum_face\">" + attribute("end_relief_depth_non_datum_face", "0.01") +
                                             attribute("end_relief_length_non_datum_face", "5")}));
  CHECK(worst_departure(one_end, [&](double, double z) { return relief(0.01, (z - 15.0) / 5.0); }) < beside_a_kink);
  CHECK(worst_departure(one_end, [&](double, double z) { return relief(0.01, (-z - 15.0) / 5.0); }) > 0.008);  // at that end, not at the other

  // Parabolic ends, 5 mm and 8 mm, a slope that a study has a key for, and a topography on top of them.
  const std::string array = "<array><c>-20</c><c>20</c><c>-20</c><c>20</c></array>";
  const auto sum =
      import_text(modified({"type=\"end_relief_datum_face\">" + attribute("end_relief_depth_datum_face", "0.01") +
                                attribute("end_relief_length_datum_face", "5") + attribute("shape_of_relief", "parabolic", "none"),
                            "type=\"end_relief_non_datum_face\">" + attribute("end_relief_depth_non_datum_face", "0.02") +
                                attribute("end_relief_length_non_datum_face", "8") + attribute("shape_of_relief", "parabolic", "none"),
                            "type=\"helix_slope\">" + attribute("helix_slope", "0.004"),
                            "type=\"topographical_modification\">" + attribute("coordinates_of_topographical_modification", array) +
                                attribute("diameters_of_topographical_modification", "<array><c>76</c><c>76</c><c>88</c><c>88</c></array>") +
                                attribute("topographical_modification_amounts", "<array><c>0.001</c><c>0.003</c><c>0.001</c><c>0.003</c></array>")}));
  CHECK_THAT(sum.text, Contains("lead_slope = 4"));
  const auto squared = [](double amount, double share) { return share > 0.0 ? amount * share * share : 0.0; };
  CHECK(worst_departure(sum, [&](double, double z) {
          return squared(0.01, (-z - 15.0) / 5.0) + squared(0.02, (z - 12.0) / 8.0) + 0.002 + 0.001 * z / 20.0;
        }) < 3e-5);

  // A second tip relief of another height; the first stays a key.
  const auto two =
      import_text(modified({"type=\"tip_relief\">" + attribute("tip_relief_depth", "0.01") + attribute("tip_relief_datum_diameter", "84"),
                            "type=\"tip_relief\">" + attribute("tip_relief_depth", "0.006") + attribute("tip_relief_datum_diameter", "86") +
                                attribute("shape_of_relief", "parabolic", "none")}));
  CHECK_THAT(two.text, Contains("tip_relief = { amount = 10, height = 2"));
  CHECK(worst_departure(two, [&](double r, double) { return squared(0.006, r - 43.0); }) < 3e-5);
  // Smooth all over: nothing is lost but decimals.
  CHECK(worst_departure(import_text(modified({"type=\"end_relief_datum_face\">" + attribute("end_relief_depth_datum_face", "0.01") +
                                              attribute("end_relief_length_datum_face", "40") + attribute("shape_of_relief", "parabolic", "none")})),
                        [&](double, double z) { return squared(0.01, (20.0 - z) / 40.0); }) < smooth);
}

TEST_CASE("A tangential transition joins the flank and a linear relief without a kink", "[studies][rexs][import]") {
  const std::string transition = attribute("specify_tangential_transition", "true", "none");
  constexpr double beside_a_bend = 3e-5;  // [mm] discretisation: curvature jumps between lines of the grid
  // Tip relief from radius 42 mm (d_a = 88 mm); in the middle of its transition, so that this is a parabola of half the slope.
  const auto tip = [&](const std::string& start, const std::string& end) {
    return import_text(modified({"type=\"tip_relief\">" + attribute("tip_relief_depth", "0.01") + attribute("tip_relief_datum_diameter", "84") +
                                 transition + attribute("tip_relief_diameter_where_tangential_transition_starts", start) +
                                 attribute("tip_relief_diameter_where_tangential_transition_ends", end)}));
  };
  CHECK(worst_departure(tip("83", "85"), [](double r, double) {
          return r < 41.5 ? 0.0 : r < 42.5 ? 0.005 * 0.5 * (r - 41.5) * (r - 41.5) : 0.005 * (r - 42.0);
        }) < beside_a_bend);
  // Beside the middle: no kink at either end, and nothing below the flank.
  const auto field_departure = worst_departure(tip("83.2", "85"), [](double r, double) {
    const double t = std::clamp((r - 41.6) / 0.9, 0.0, 1.0), line = 0.005 * (r - 42.0);
    return r > 42.5 ? line : 0.005 * (0.5 * t * t * (3.0 - 2.0 * t) + 0.9 * t * t * (t - 1.0));
  });
  CHECK(field_departure < beside_a_bend);
  // End relief over 8 mm; its transition from 10 to 6 mm from the end.
  const auto end = import_text(modified({"type=\"end_relief_datum_face\">" + attribute("end_relief_depth_datum_face", "0.01") +
                                         attribute("end_relief_length_datum_face", "8") + transition +
                                         attribute("end_relief_datum_face_length_of_tangential_transition_start", "10") +
                                         attribute("end_relief_datum_face_length_of_tangential_transition_end", "6")}));
  CHECK(worst_departure(end, [](double, double z) {
          const double depth = -z - 12.0;  // past the start of the relief
          return depth < -2.0 ? 0.0 : depth < 2.0 ? 0.01 / 8.0 * (depth + 2.0) * (depth + 2.0) / 8.0 : 0.01 / 8.0 * depth;
        }) < beside_a_bend);
  // What cannot be taken leaves the relief as a key of the study, and is named.
  for (const auto& [start, stop] : {std::pair("83.9", "85"), {"84.5", "85"}, {"85", "83"}}) {
    CAPTURE(start, stop);
    const rexs::ImportedStudy kinked = tip(start, stop);
    CHECK_THAT(kinked.text, Contains("tip_relief = { amount = 10, height = 2"));
    REQUIRE(kinked.warnings.size() == 1);
    CHECK_THAT(kinked.warnings.front(), Contains("tangential transition is not taken") && Contains("middle third"));
  }
}
