#include "studies/analysis/effect_sizes.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"

namespace flankwright::studies {
namespace {

using json = Json;
using study_texts::results_of;

}  // namespace

TEST_CASE("Results have the size of each effect as far as the study asks for it", "[studies][effects]") {
  // At the resolution that estimates are made at, so that they differ by their order alone.
  const std::vector<Override> coarse{{"cycle.positions", "16"}, {"fidelity.quadrature", "{ rule = \"graded\", intervals = 6 }"}};
  const auto sized = [&](const char* how) {
    std::vector<Override> overrides = coarse;
    overrides.push_back({"fidelity.effect_sizes", how});
    return results_of(small::analysis(), overrides);
  };
  const json off = sized("off"), exact = sized("exact");
  for (const json& effect : off["effects"]) CHECK((effect["estimate"].is_null() && effect["exact"].is_null()));
  CHECK(off["loaded"] == exact["loaded"]);  // to find out changes nothing
  for (const json& effect : exact["effects"]) {
    const std::string name = effect["name"];
    CAPTURE(name);
    const bool has_size = effect["on"] && name != "unloaded_contact" && name != "root_stress";
    CHECK(effect["estimate"].is_object() == has_size);
    CHECK(effect["exact"].is_object() == has_size);
    if (!has_size) continue;
    constexpr double first_order = 0.1, negligible = 0.1;  // of a size, and in % where it is small
    CHECK(effect["estimate"]["share_percent"] == Approx(effect["exact"]["share_percent"].get<double>()).epsilon(first_order).margin(negligible));
    CHECK(effect["estimate"]["positions"]["solved_again"] <= effect["estimate"]["positions"]["solved"]);
  }
  for (const json& effect : exact["effects"]) {
    if (effect["name"] != "misalignment") continue;
    CHECK(effect["exact"]["scene"] == "bent");
    CHECK(effect["exact"]["peak_contact_stress_change_MPa"] > 0.0);
  }
}

TEST_CASE("The results list steps of a run beside its effects", "[studies][effects]") {
  const json results = results_of(small::optimisation());
  std::set<std::string> steps;
  for (const json& step : results["steps"]) {
    steps.insert(step["name"].get<std::string>());
    CHECK(step["seconds"] >= 0.0);
  }
  CHECK(steps == std::set<std::string>{"load_distribution", "before_and_after", "edge_contact", "proof_of_the_optimum", "effect_sizes"});
}

}  // namespace flankwright::studies
