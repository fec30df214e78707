#include "studies/exchange/rexs/rexs_export.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/base/units.hpp"
#include "core/flank/flank.hpp"
#include "studies/study_file/grid_file.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/common/random.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using Catch::Contains;

namespace {

/// A study whose every number is drawn, in the digits that people write.
std::string random_study(unsigned seed) {
  tests::Random32 random(seed);
  const auto number = [&](double low, double high) { return std::to_string(std::round(100.0 * random(low, high)) / 100.0); };
  const auto relief = [&](double height) {
    return "{ amount = " + number(1, 30) + ", height = " + number(0.3, height) + (random.below(2) == 0 ? ", shape = \"parabolic\" }" : " }");
  };
  std::string text = "[pair]\nnormal_module = 5\nhelix_angle = " + number(1, 30) + "\npressure_angle = " + number(18, 25) +
                     "\nworking_flank = " + (random.below(2) == 0 ? "\"right\"" : "\"left\"") +
                     "\ndriver = " + (random.below(2) == 0 ? "\"pinion\"" : "\"wheel\"") + "\n[load]\ntorque = [" + number(10, 500) + ", " +
                     number(501, 900) + "]\n";
  for (const std::string gear : {"pinion", "wheel"}) {
    text += "[" + gear + "]\nteeth = " + (gear == "pinion" ? "20" : "43") + "\nface_width = " + number(30, 60) +
            "\nprofile_shift = " + number(-0.1, 0.3) + "\ntooth_thickness_allowance = " + number(-200, -10) +
            (gear == "pinion" ? std::string("\nhand = ") + (random.below(2) == 0 ? "\"right\"" : "\"left\"") : "") +
            "\nrack = { dedendum = " + number(1.2, 1.3) + ", root_radius = " + number(0.1, 0.2) + " }\n[" + gear +
            ".material]\nyoungs_modulus = " + number(1e5, 2e5) + "\n[" + gear + ".modification]\nlead_crowning = " + number(-10, 20) +
            "\nlead_slope = " + number(-20, 20) + "\naddendum_crowning = " + number(0, 9) + "\ndedendum_crowning = " + number(0, 9) +
            "\nprofile_slope = " + number(-9, 9) + "\ntip_relief = " + relief(2.0) + "\nroot_relief = " + relief(1.0) +
            "\nend_relief = { amount = " + number(1, 9) + ", length = " + number(2, 9) + " }\ntwist = " + number(-9, 9) +
            "\ntriangular_tip_relief = " + relief(2.0) + "\ntriangular_root_relief = " + relief(1.0) + "\n";
  }
  return text;
}

/// Equal but for the last of fifteen digits, which is rounded on each of the two ways, or, of differences, for 1e-9 mm.
void check_same(double a, double b) { CHECK(std::abs(a - b) <= 1.1e-14 * std::abs(a)); }
void check_same_length(double a, double b) { CHECK(std::abs(a - b) <= 0.5e-9); }

void check_same(const ProfileRelief& a, const ProfileRelief& b) {
  check_same(a.amount, b.amount);
  check_same_length(a.height, b.height);
  CHECK(a.shape == b.shape);
}

void check_same(const Modification& a, const Modification& b) {
  check_same(a.lead_crowning, b.lead_crowning);
  check_same(a.lead_slope, b.lead_slope);
  check_same(a.addendum_crowning, b.addendum_crowning);
  check_same(a.dedendum_crowning, b.dedendum_crowning);
  check_same(a.profile_slope, b.profile_slope);
  check_same(a.tip_relief, b.tip_relief);
  check_same(a.root_relief, b.root_relief);
  check_same(a.triangular_tip_relief, b.triangular_tip_relief);
  check_same(a.triangular_root_relief, b.triangular_root_relief);
  check_same(a.end_relief.amount, b.end_relief.amount);
  check_same(a.end_relief.length, b.end_relief.length);
  check_same(a.twist, b.twist);
}

void check_same(const GearData& a, const GearData& b) {
  CHECK(a.teeth == b.teeth);
  check_same(a.face_width, b.face_width);
  check_same(a.profile_shift, b.profile_shift);
  check_same(a.rack.addendum, b.rack.addendum);
  check_same(a.rack.dedendum, b.rack.dedendum);
  check_same(a.rack.root_radius, b.rack.root_radius);
}

}  // namespace

TEST_CASE("A study survives the way to REXS and back to its last digit", "[studies][rexs][export]") {
  const unsigned seed = GENERATE(range(1U, 41U));
  const rexs::Form form = seed % 2 == 0U ? rexs::Form::Json : rexs::Form::Xml;
  const std::vector<std::string> versions{"1.0", "1.2", "1.3", "1.4", "1.7", "2.0"};
  const std::string version = versions[seed % versions.size()];
  CAPTURE(seed, version);
  const Study study = parse_study(random_study(seed), "there.toml");
  const rexs::Model model = rexs::export_stage(study, {version, "2026-01-01T00:00:00+00:00"}).model;
  const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(model, form), "there.rexs", {});
  CHECK(imported.warnings.empty());
  const Study back = parse_study(imported.text, "back.toml");

  check_same(study.pair.normal_module, back.pair.normal_module);
  check_same(study.pair.helix_angle, back.pair.helix_angle);
  check_same(study.pair.pressure_angle, back.pair.pressure_angle);
  CHECK(study.pair.pinion_hand == back.pair.pinion_hand);
  CHECK(study.pair.working_flank == back.pair.working_flank);
  CHECK(study.pair.driver == back.pair.driver);
  check_same(study.pair.pinion, back.pair.pinion);
  check_same(study.pair.wheel, back.pair.wheel);
  for (const Member m : {Member::Pinion, Member::Wheel}) {  // the format has it since 1.3, as a profile shift
    check_same_length(version < "1.3" ? 0.0 : study.pair[m].tooth_thickness_allowance, back.pair[m].tooth_thickness_allowance);
  }
  check_same(make_gear_pair(study.pair).centre_distance, make_gear_pair(back.pair).centre_distance);
  check_same(make_gear_pair(study.pair).pinion.tip_radius, make_gear_pair(back.pair).pinion.tip_radius);
  check_same(study.modification.pinion, back.modification.pinion);
  check_same(study.modification.wheel, back.modification.wheel);
  check_same(study.material.pinion.youngs_modulus, back.material.pinion.youngs_modulus);
  check_same(study.material.wheel.youngs_modulus, back.material.wheel.youngs_modulus);
  REQUIRE(back.scenes.size() == 2);
  check_same(study.torques[0], back.scenes[0].torques.front());
  check_same(study.torques[1], back.scenes[1].torques.front());
}

TEST_CASE("A load spectrum comes back with its times and speeds, and the oil with its temperature", "[studies][rexs][export][life]") {
  const std::string version = GENERATE("1.0", "1.3", "2.0");
  CAPTURE(version);
  std::string text = random_study(7);
  text.insert(
      text.find("\n[load]"),
      "\n[lubricant]\nbase = \"polyalphaolefin\"\nviscosity_40 = 220\nviscosity_100 = 25\ndensity = 860\ntemperature = 70\nroughness = 0.3\n");
  const std::size_t torque = text.find("torque = [");
  text.replace(torque, text.find('\n', torque) - torque,
               "spectrum = [{ torque = 900, speed = 1480, hours = 20 }, { torque = 350, speed = 1200, hours = 20000, temperature = 60 }]");
  const Study there = parse_study(text, "there.toml");
  const rexs::Model model = rexs::export_stage(there, {version, "2026-01-01T00:00:00+00:00"}).model;
  for (const rexs::Form form : {rexs::Form::Xml, rexs::Form::Json}) {
    const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(model, form), "there.rexs", {});
    const Study back = parse_study(imported.text, "back.toml");
    CAPTURE(imported.text);
    REQUIRE(back.spectrum.size() == there.spectrum.size());
    constexpr double round_off = 1e-9;
    for (std::size_t i = 0; i < back.spectrum.size(); ++i) {
      CHECK(back.spectrum[i].torque == Approx(there.spectrum[i].torque).epsilon(round_off));
      CHECK(back.spectrum[i].speed == Approx(there.spectrum[i].speed).epsilon(round_off));
      CHECK(back.spectrum[i].hours == Approx(there.spectrum[i].hours).epsilon(round_off));
    }
    CHECK(back.spectrum[1].temperature == Approx(60.0).epsilon(round_off));
    CHECK(back.life.lubricant.viscosity_40 == Approx(220.0).epsilon(round_off));
    CHECK(back.life.lubricant.viscosity_100 == Approx(25.0).epsilon(round_off));
    CHECK(back.life.lubricant.density_15 == Approx(860.0).epsilon(round_off));
    CHECK(back.life.lubricant.temperature == Approx(70.0).epsilon(round_off));
    CHECK(back.life.roughness == Approx(0.3 * units::um).epsilon(round_off));
    if (version != "1.0") CHECK(back.life.lubricant.base == BaseOil::Polyalphaolefin);
  }
}

TEST_CASE("A tip rounding comes back by the circle at which the flank ends", "[studies][rexs][export][edge]") {
  std::string text = random_study(7);
  text.insert(text.find("\nrack"), "\nedges = { tip_rounding = 0.3 }");
  const Study there = parse_study(text, "there.toml");
  const rexs::Model model = rexs::export_stage(there, {"2.0", "2026-01-01T00:00:00+00:00"}).model;
  const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(model, rexs::Form::Xml), "there.rexs", {});
  const Study back = parse_study(imported.text, "back.toml");
  CHECK(back.pair.pinion.tip_rounding == Approx(0.3).epsilon(1e-9));  // round-off of the difference of two diameters
  check_same(make_gear_pair(there.pair).pinion.tip_form_radius, make_gear_pair(back.pair).pinion.tip_form_radius);
  CHECK_THAT(imported.text, Contains("tip_form_diameter"));
}

TEST_CASE("A tip form diameter that is no end of the flank is not taken, with the reason", "[studies][rexs][import][edge]") {
  const Study there = parse_study(random_study(7), "there.toml");
  rexs::Model model = rexs::export_stage(there, {"2.0", "2026-01-01T00:00:00+00:00"}).model;
  const auto gear = std::ranges::find(model.components, std::string("cylindrical_gear"), &rexs::Component::type);
  const double wrong = 2.0 * make_gear_pair(there.pair).pinion.reference_radius - 1.0;
  std::erase_if(gear->attributes, [](const rexs::Attribute& attribute) { return attribute.id == "tip_form_diameter"; });
  gear->attributes.push_back({.id = "tip_form_diameter", .unit = "mm", .type = rexs::ValueType::Number, .text = std::to_string(wrong)});
  const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(model, rexs::Form::Xml), "there.rexs", {});
  CHECK(parse_study(imported.text, "back.toml").pair.pinion.tip_rounding == there.pair.pinion.tip_rounding);
  CHECK_THAT(imported.text, Contains("is no end of a flank"));
}

TEST_CASE("A tip chamfer comes back with its amount and the flank's end; its angle is said to be taken", "[studies][rexs][export][edge]") {
  std::string text = random_study(7);
  text.insert(text.find("\nrack"), "\nedges = { tip_chamfer = { amount = 0.35, angle = 30, radius = 0.1 } }");
  const rexs::Model model = rexs::export_stage(parse_study(text, "there.toml"), {"2.0", "2026-01-01T00:00:00+00:00"}).model;
  const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(model, rexs::Form::Xml), "there.rexs", {});
  const EdgeChamfer chamfer = parse_study(imported.text, "back.toml").pair.pinion.tip_chamfer;
  CHECK(chamfer.amount == 0.35);
  CHECK(chamfer.angle == Approx(45 * units::deg).epsilon(1e-14));  // round-off
  const Study back = parse_study(imported.text, "back.toml");
  check_same(make_gear_pair(parse_study(text, "there.toml").pair).pinion.tip_form_radius, make_gear_pair(back.pair).pinion.tip_form_radius);
  CHECK_THAT(imported.text, Contains("tooth_tip_chamfer") && Contains("the angle is not in the file: 45 deg") && Contains("tip_form_diameter"));
}

TEST_CASE("A chamfer of the tooth's ends comes back with the usable face width", "[studies][rexs][export][edge]") {
  std::string text = random_study(7);
  text.insert(text.find("\nrack"), "\nedges = { end_chamfer = { amount = 0.4 } }");
  const Study there = parse_study(text, "there.toml");
  rexs::Model model = rexs::export_stage(there, {"2.0", "2026-01-01T00:00:00+00:00"}).model;
  const auto imported = [&] { return rexs::import_stage(rexs::model_text(model, rexs::Form::Xml), "there.rexs", {}).text; };
  const GearPair back = make_gear_pair(parse_study(imported(), "back.toml").pair);
  CHECK(back.pinion.data.end_chamfer.amount == 0.4);
  check_same(back.pinion.face.width(), make_gear_pair(there.pair).pinion.face.width());
  CHECK(back.wheel.data.end_chamfer.amount == 0.0);
  CHECK_THAT(imported(), Contains("chamfer_at_tooth_end") && Contains("angle and edge radius are not in the file: 45 deg"));

  // One that takes the whole flank is left out, and said to be.
  const auto gear = std::ranges::find(model.components, std::string("cylindrical_gear"), &rexs::Component::type);
  std::ranges::find(gear->attributes, std::string("chamfer_at_tooth_end"), &rexs::Attribute::id)->text =
      std::to_string(0.5 * there.pair.pinion.face_width);
  CHECK(parse_study(imported(), "back.toml").pair.pinion.end_chamfer.amount == 0.0);
  CHECK_THAT(imported(), Contains("leaves nothing of a face width"));
}

TEST_CASE("A generated flank comes back as the grid of its points", "[studies][rexs][export]") {
  const Study study = parse_study(
      "[pair]\nnormal_module = 5\nhelix_angle = 20\n[pinion]\nteeth = 20\nface_width = 40\n"
      "generation = { kind = \"parabolic_rack\", coefficient = 0.0008 }\n[wheel]\nteeth = 43\nface_width = 40\n",
      "a.toml");
  const rexs::ExportedStage stage = rexs::export_stage(study, {});
  CHECK_THAT(stage.notes.front(), Contains("pinion: what no component of the format says is exported as 625 points"));
  const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(stage.model, rexs::Form::Xml), "a.rexs", {.grid_stem = "a"});
  CHECK_THAT(imported.text, Contains("grid = \"a-pinion.csv\""));
  REQUIRE(imported.grids.size() == 1);
  CHECK(imported.grids.front().name == "a-pinion.csv");
  const MeasuredGrid grid = parse_grid(imported.grids.front().text, "a-pinion.csv");
  const GearPair pair = make_gear_pair(study.pair);
  const Flank flank = make_flank(pair, Member::Pinion, {}, {});
  double largest = 0.0;
  for (int i = 0; i < grid.deviation.rows(); ++i) {
    for (int j = 0; j < grid.deviation.cols(); ++j) {
      const double removed = flank.deviation(flank.roll_at(grid.radii[static_cast<std::size_t>(i)]), grid.z[static_cast<std::size_t>(j)], 0);
      // The tool's field is found by iteration; 15 digits of the radius move it by less than that.
      CHECK(std::abs(grid.deviation(i, j) + removed * std::cos(pair.base_helix_angle)) < 1e-12);
      largest = std::max(largest, std::abs(removed));
    }
  }
  CHECK(largest > 1e-3);
}

TEST_CASE("A ground flank comes back as its crowning and the grid of its natural twist", "[studies][rexs][export][grinding]") {
  const Study study = parse_study(
      "[pair]\nnormal_module = 5\nhelix_angle = 20\n[pinion]\nteeth = 20\nface_width = 40\nprocess = \"generating_grinding\"\n"
      "[wheel]\nteeth = 43\nface_width = 40\n[pinion.modification]\nlead_crowning = 8\n",
      "a.toml");
  const rexs::ExportedStage stage = rexs::export_stage(study, {});
  const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(stage.model, rexs::Form::Xml), "a.rexs", {.grid_stem = "a"});
  CHECK_THAT(imported.text, Contains("lead_crowning = 8"));
  REQUIRE(imported.grids.size() == 1);
  const GearPair pair = make_gear_pair(study.pair);
  const MeasuredGrid grid = parse_grid(imported.grids.front().text, "a-pinion.csv");
  const Flank ground = make_flank(pair, Member::Pinion, study.modification.pinion, {});
  Modification back;
  back.lead_crowning = study.modification.pinion.lead_crowning;
  back.topography = make_grid_field(grid, pair.pinion.base_radius, pair.base_helix_angle).field;
  const Flank read = make_flank(pair, Member::Pinion, back, {});
  for (const double radius : grid.radii) {
    for (const double z : grid.z) {
      constexpr double written = 1e-7;  // half of the grid's last digit, normal to the flank
      CHECK(std::abs(ground.deviation(ground.roll_at(radius), z, 0) - read.deviation(read.roll_at(radius), z, 0)) <= written);
    }
  }
}

TEST_CASE("Every modification parameter survives the way to REXS and back, as a component or as points", "[studies][rexs][export][modification]") {
  const std::string pair_text =
      "[pair]\nnormal_module = 5\nhelix_angle = 20\n[pinion]\nteeth = 20\nface_width = 40\n[wheel]\nteeth = 43\nface_width = 40\n";
  for (const ModificationDescriptor& d : modification_parameters) {
    if (d.kind == ParameterKind::Extent) continue;  // comes with its amount
    CAPTURE(std::string(d.key));
    const std::string extent = d.extent.empty() ? "" : std::string(d.extent) + " = 1.5\n";
    const Study study = parse_study(pair_text + "[pinion.modification]\n" + std::string(d.key) + " = 0.4\n" + extent, "a.toml");
    const rexs::ExportedStage stage = rexs::export_stage(study, {});
    const rexs::ImportedStudy imported = rexs::import_stage(rexs::model_text(stage.model, rexs::Form::Xml), "a.rexs", {.grid_stem = "a"});
    std::string text = imported.text;
    if (const std::size_t at = text.find("grid = "); at != text.npos) text.erase(at, text.find('\n', at) - at);  // its file is nowhere
    Study back = parse_study(text, "back.toml");
    const GearPair pair = make_gear_pair(study.pair);
    for (const auto& grid : imported.grids) {
      back.modification.pinion.topography = make_grid_field(parse_grid(grid.text, grid.name), pair.pinion.base_radius, pair.base_helix_angle).field;
    }
    const Flank there = make_flank(pair, Member::Pinion, study.modification.pinion, {}),
                here = make_flank(pair, Member::Pinion, back.modification.pinion, {});
    double largest = 0.0, departure = 0.0;
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j <= 10; ++j) {
        const double rho = there.roll_at(std::lerp(pair.pinion.active_root_radius, pair.pinion.tip_radius, 0.05 + 0.09 * i)),
                     z = 39.0 * (0.1 * j - 0.5);
        largest = std::max(largest, std::abs(there.deviation(rho, z, 0)));
        departure = std::max(departure, std::abs(there.deviation(rho, z, 0) - here.deviation(rho, z, 0)));
      }
    }
    CHECK(largest > 1e-5);
    CHECK(departure < 1e-3 * largest);  // of the surface through the points
  }
}

TEST_CASE("Names and units are those of the version; another version is refused", "[studies][rexs][export]") {
  const Study study = parse_study(random_study(3), "a.toml");
  const auto text = [&](const std::string& version) { return rexs::model_text(rexs::export_stage(study, {version, ""}).model, rexs::Form::Xml); };
  CHECK_THAT(text("1.2"), Contains("\"flank_geometry\"") && Contains("\"stage_gear_data\"") && Contains("unit=\"\xc2\xb0\"") && Contains("N / mm^2"));
  CHECK_THAT(text("1.4"), Contains("\"cylindrical_gear_flank\"") && Contains("unit=\"deg\"") && Contains("tip_radius_factor"));
  CHECK_THAT(text("2.0"), Contains("MPa") && Contains("tip_corner_radius_factor_reference_profile"));
  CHECK_THROWS_AS(text("3.0"), InvalidInput);
}
