#include <catch2/catch.hpp>

#include "studies/json_format.hpp"
#include "studies/results_json.hpp"
#include "studies/run_study.hpp"
#include "studies/study_file.hpp"
#include "tests/studies/study_texts.hpp"

namespace flankwright::studies {
namespace {

using json = Json;
using study_texts::problem_of;

const std::string loaded_study = study_texts::small_study + R"(
[pinion.modification]
lead_crowning = 6
tip_relief = { amount = 5, height = 2 }
[misalignment]
crossing = "0.3 arcmin"
axial_offset = 0.05
mesh_misalignment = 4
[load]
torque = 300
[cycle]
positions = 7
peaks = "sampled"
[fidelity]
compliance = "thin_slice"
quadrature = { rule = "gauss2", intervals = 4 }
)";

json loaded(const std::vector<Override>& overrides) {
  return json::parse(results_json(run_study(parse_study(loaded_study, "small.toml", overrides)))).at("loaded").at(0);
}

}  // namespace

TEST_CASE("Results give derivatives of every output by the keys asked for, in the units of the study", "[studies][gradient]") {
  constexpr double kDifference = 1e-5;  // step^2 times curvature of central differences, relative
  struct Key {
    std::string path;
    double value, step;
    std::string unit;
  };
  const std::vector<Key> keys{{"pinion.modification.lead_crowning", 6, 0.01, "um"},
                              {"pinion.modification.tip_relief.amount", 5, 0.01, "um"},
                              {"misalignment.crossing", 0.3, 0.0005, "arcmin"},
                              {"misalignment.mesh_misalignment", 4, 0.01, "um"},
                              {"misalignment.axial_offset", 0.05, 0.0005, "mm"},
                              {"load.torque", 300, 0.05, "N·m"}};
  std::string asked;
  for (const Key& key : keys) asked += (asked.empty() ? "[\"" : ", \"") + key.path + "\"";
  const json result = loaded({{"analyse.gradients", asked + "]"}});
  const json& gradients = result.at("gradients");
  REQUIRE(gradients.at("parameters").size() == keys.size());
  for (std::size_t p = 0; p < keys.size(); ++p) {
    CAPTURE(keys[p].path);
    CHECK(gradients.at("parameters").at(p) == keys[p].path);
    CHECK(gradients.at("units").at(p) == keys[p].unit);
    const auto moved = [&](double by) { return loaded({{keys[p].path, std::to_string(keys[p].value + by)}}); };
    const json up = moved(keys[p].step), down = moved(-keys[p].step);
    const auto check = [&](const json& exact, const json& high, const json& low, double scale) {
      const double difference = (high.get<double>() - low.get<double>()) / (2 * keys[p].step);
      CHECK(std::abs(exact.get<double>() - difference) <= kDifference * (std::abs(difference) + std::abs(scale)));
    };
    for (const char* output : {"te_peak_to_peak_um", "te_mean_um", "peak_load_N_per_mm", "peak_contact_stress_MPa",
                               "mean_stiffness_N_per_mm_um", "load_factor"}) {
      CAPTURE(output);
      check(gradients.at("summary").at(output).at(p), up.at("summary").at(output), down.at("summary").at(output),
            0.1 * result.at("summary").at(output).get<double>() / keys[p].value);
    }
    for (std::size_t order = 0; order < result.at("summary").at("te_harmonics_um").size(); ++order) {
      check(gradients.at("summary").at("te_harmonics_um").at(order).at(p), up.at("summary").at("te_harmonics_um").at(order),
            down.at("summary").at("te_harmonics_um").at(order), 0.1);
    }
    for (std::size_t k = 0; k < result.at("cycle").size(); ++k) {
      for (const char* output : {"te_um", "stiffness_N_per_mm_um"}) {
        check(gradients.at("cycle").at(k).at(output).at(p), up.at("cycle").at(k).at(output), down.at("cycle").at(k).at(output),
              0.1 * result.at("cycle").at(k).at(output).get<double>() / keys[p].value);
      }
    }
  }
  // Points in the order of teeth[].points[]; the force stays while it is not the torque that changes.
  const json& position = gradients.at("cycle").at(3);
  std::size_t points = 0;
  double force = 0.0;
  for (const json& tooth : result.at("cycle").at(3).at("teeth")) {
    for (const json& point : tooth.at("points")) force += point.at("length_mm").get<double>() * position.at("load_N_per_mm").at(points++).at(0).get<double>();
  }
  CHECK(position.at("load_N_per_mm").size() == points);
  CHECK(position.at("contact_stress_MPa").size() == points);
  CHECK(std::abs(force) <= 1e-9 * result.at("normal_force_N").get<double>());  // round-off
  CHECK(gradients.at("summary").at("peak_root_stress_MPa").is_null());         // thin slices have none
  CHECK_FALSE(loaded({}).contains("gradients"));                               // nobody asked
}

TEST_CASE("Derivatives of located peaks and load factors stand beside them", "[studies][gradient]") {
  constexpr double kLocated = 0.03;  // both peaks of a difference are located to 2e-4 base pitches
  const auto at = [](double crowning) {
    return loaded({{"analyse.gradients", R"(["pinion.modification.lead_crowning"])"}, {"cycle.peaks", "\"located\""},
                   {"pinion.modification.lead_crowning", std::to_string(crowning)}});
  };
  const json here = at(6), up = at(6.05), down = at(5.95);
  for (const char* path : {"/peaks/with_spikes/contact_stress_MPa", "/peaks/without_spikes/contact_stress_MPa", "/load_factors/without_spikes/K_H"}) {
    const json::json_pointer key(path);
    const auto value = [&](const json& result) { return result.at("summary").at(key).get<double>(); };
    const double exact = here.at("gradients").at("summary").at(key).at(0), difference = (value(up) - value(down)) / 0.1;
    CAPTURE(path);
    CHECK(std::abs(exact - difference) <= kLocated * (std::abs(difference) + 0.1 * value(here) / 6));
  }
}

TEST_CASE("What has no derivative is refused", "[studies][gradient][input]") {
  CHECK(problem_of("[analyse]\ngradients = [\"pair.helix_angle\"]").key == "analyse.gradients");
  CHECK_THAT(problem_of("[analyse]\ngradients = [\"misalignment.crosing\"]").allowed, Catch::Contains("did you mean crossing?"));
  CHECK(problem_of("[analyse]\ngradients = \"misalignment.crossing\"").key == "analyse.gradients");
  CHECK(problem_of("[analyse]\ngradients = [3]").key == "analyse.gradients");
  // A relief is spread over its height, which must be known.
  CHECK(problem_of("[analyse]\ngradients = [\"wheel.modification.tip_relief.amount\"]").key == "wheel.modification.tip_relief.height");
}

}  // namespace flankwright::studies
