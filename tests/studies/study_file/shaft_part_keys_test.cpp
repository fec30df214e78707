#include "studies/study_file/shaft_part_keys.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"

namespace flankwright::studies {
namespace {

/// A pair whose pinion's shaft has these bearings.
std::string pair_with_bearings(const std::string& bearings) {
  return small::helical_pair("", "", "[150, 300]") + R"(quadrature = { rule = "graded", intervals = 12 }
[pinion.shaft]
sections = [{ length = 180, outer_diameter = 50 }]
gear_position = 90
torque_position = 0
bearings = [)" +
         bearings + "]\n";
}

Json run_with_bearings(const std::string& bearings) {
  return Json::parse(results_json(run_study(parse_study(pair_with_bearings(bearings), "bearings.toml"))));
}

std::string bearing_refusal(const std::string& bearings, const std::string& more = "") {
  try {
    parse_study(pair_with_bearings(bearings) + more, "bearings.toml");
  } catch (const StudyErrors& errors) {
    const StudyProblem& first = errors.problems().front();
    return first.key + " = " + first.value + ": " + first.allowed;
  }
  return {};
}

const std::string ball = R"({ position = 20, type = "deep_groove_ball", elements = 9, element_diameter = 12 })";
const std::string by_table = "{ position = 160, force_table = [1000, 4000], deflection_table = [8, 20] }";

}  // namespace

TEST_CASE("Bearings whose stiffness depends on the load say what was given and what is used", "[studies][shaft][unit][bearing]") {
  const Json results = run_with_bearings(ball + ", " + by_table);
  const Json& given = results.at("/used/pair/pinion/shaft/bearings"_json_pointer);
  CHECK(given.at(0).at("radial_stiffness_N_per_um") == "deep_groove_ball");
  CHECK(given.at(0).at("elements") == 9);
  CHECK(given.at(1).at("radial_stiffness_N_per_um") == "force_table");
  CHECK(given.at(1).at("deflection_table_um").at(1).get<double>() == Approx(20).epsilon(1e-14));  // round-off
  double before = 0.0;
  for (const Json& loaded : results.at("loaded")) {
    const Json& unit = loaded.at("unit");
    CHECK(unit.at("bearings_are") == "linearised at their equilibrium under mean forces");
    CHECK(unit.at("equilibrium").at("converged") == true);
    CHECK_FALSE(unit.contains("clearances"));
    for (const Json& shaft : unit.at("shafts")) CHECK(shaft.at("equilibrium_residual").get<double>() < 1e-9);
    const Json &first = unit.at("bearings").at(0), &second = unit.at("bearings").at(1);
    const double force = first.at("radial_force_N");
    const Json& used = first.at("radial_stiffness");
    const double deflection_um = 0.436 * std::pow(5 * force / 9, 2.0 / 3.0) / std::cbrt(12.0);
    CHECK(used.at("given") == "deep_groove_ball");
    CHECK(used.at("deflection_um").get<double>() == Approx(deflection_um).epsilon(1e-9));
    CHECK(used.at("secant_N_per_um").get<double>() == Approx(force / deflection_um).epsilon(1e-9));
    CHECK(used.at("used_N_per_um").get<double>() == Approx(1.5 * force / deflection_um).epsilon(1e-9));
    CHECK(used.at("used_across_N_per_um").get<double>() == Approx(force / deflection_um).epsilon(1e-9));
    const Json& of_table = second.at("radial_stiffness");
    const double on_table = second.at("radial_force_N");
    CHECK(of_table.at("given") == "force_table");
    CHECK(of_table.at("beyond_table") == (on_table > 4000));
    CHECK(of_table.at("deflection_um").get<double>() == Approx(on_table < 1000 ? 8e-3 * on_table : 8 + (on_table - 1000) * 4e-3).epsilon(1e-9));
    CHECK(used.at("used_N_per_um").get<double>() > before);  // stiffer under more load
    before = used.at("used_N_per_um");
  }
}

TEST_CASE("Bearings that a study cannot have are refused by key, value and what is allowed", "[studies][shaft][unit][bearing]") {
  using Catch::Contains;
  CHECK(bearing_refusal(ball + ", " + by_table).empty());
  CHECK_THAT(bearing_refusal(ball + ", { position = 160, force_table = [1000, 900], deflection_table = [8, 20] }"),
             Contains("pinion.shaft.bearings.1.force_table = 900: allowed is above 1000 N"));
  CHECK_THAT(bearing_refusal(ball + ", { position = 160, force_table = [-1, 900], deflection_table = [8, 20] }"),
             Contains("force_table") && Contains("0 .. 1000000000 N"));
  CHECK_THAT(bearing_refusal(ball + ", { position = 160, force_table = [800, 900], deflection_table = [8, 7] }"),
             Contains("pinion.shaft.bearings.1.deflection_table = 7: allowed is above 8 um"));
  CHECK_THAT(bearing_refusal(by_table + R"(, { position = 20, type = "deep_groove_ball", element_diameter = 12 })"),
             Contains("pinion.shaft.bearings.1.elements = (not given): allowed is an integer of at least 3"));
  CHECK_THAT(bearing_refusal(by_table + R"(, { position = 20, type = "tapered_roller", elements = 17, element_length = 16 })"),
             Contains("pinion.shaft.bearings.1.contact_angle = (not given): allowed is 0 .. 60 deg"));
  CHECK_THAT(bearing_refusal(by_table + R"(, { position = 20, type = "needle", elements = 17 })"),
             Contains("type") && Contains("cylindrical_roller"));
  CHECK_THAT(
      bearing_refusal(by_table + R"(, { position = 20, radial_stiffness = 500, type = "cylindrical_roller", elements = 17, element_length = 16 })"),
      Contains("pinion.shaft.bearings.1.radial_stiffness") && Contains("beside a table or a type"));
  // Of a further shaft of a unit.
  CHECK_THAT(bearing_refusal(ball + ", " + by_table, R"([[unit.shafts]]
name = "beside"
sections = [{ length = 100, outer_diameter = 40 }]
bearings = [{ position = 20, type = "angular_contact_ball", elements = 9, element_diameter = 12 }, { position = 80 }]
torque_position = 0
)"),
             Contains("unit.shafts.0.bearings.0.contact_angle"));
}

}  // namespace flankwright::studies
