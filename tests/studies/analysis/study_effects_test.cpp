#include "studies/analysis/study_effects.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"

namespace flankwright::studies {

namespace {

/// A helical pair whose gears are ground by generating, without a modification.
const std::string ground = R"([pair]
normal_module = 4
helix_angle = 20
[pinion]
teeth = 21
face_width = 40
process = "generating_grinding"
[wheel]
teeth = 40
face_width = 40
process = "generating_grinding"
[load]
torque = 300
[cycle]
positions = 4
peaks = "sampled"
[fidelity]
compliance = "thin_slice"
quadrature.intervals = 4
)";

bool has_effect(const std::string& text, const char* effect) { return is_on(study_effects(parse_study(text, "small.toml")), effect); }

const LoadedResult& loaded_of(const StudyResults& results, const std::string& scene, const std::string& design) {
  for (const LoadedResult& loaded : results.loaded) {
    if (loaded.scene == scene && loaded.design == design) return loaded;
  }
  FAIL("no load case of " << scene << ", " << design);
  return results.loaded.front();
}

}  // namespace

TEST_CASE("An effect is on where anything that varies calls for it: variables, ties, tolerances, sweeps, derivatives", "[studies][effects]") {
  CHECK_FALSE(has_effect(ground, "natural_twist"));
  const std::string optimise = "task = \"optimise\"\n" + ground + "[optimise]\nobjective = \"te_peak_to_peak\"\n";
  CHECK(has_effect(optimise + "[optimise.variables]\n\"wheel.modification.lead_crowning\" = [0, 20]\n", "natural_twist"));
  const std::string profile = optimise + "[optimise.variables]\n\"pinion.modification.profile_crowning\" = [0, 20]\n";
  CHECK_FALSE(has_effect(profile, "natural_twist"));
  const std::string tolerances = "[optimise.scenes_drawn]\nsamples = 8\n[optimise.tolerances]\n";
  CHECK(has_effect(profile + tolerances + "\"wheel.modification.lead_crowning\" = { uniform = [-5, 5] }\n", "natural_twist"));
  // One of twenty values is not 0: few draws need not meet it.
  const std::string rare = "{ values = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 15] }\n";
  CHECK_FALSE(has_effect(profile, "misalignment"));
  CHECK(has_effect(profile + tolerances + "\"misalignment.mesh_misalignment\" = " + rare, "misalignment"));
  const std::string tie = "[optimise.ties]\n\"wheel.modification.lead_crowning\" = { as = \"pinion.modification.profile_crowning\" }\n";
  CHECK(has_effect(profile + tie, "natural_twist"));

  const std::string sweep = "task = \"sweep\"\n" + ground + "[sweep]\nsamples = 8\n[sweep.parameters]\n";
  // Given compensated and without an amount, neither of the two alone brings a twist.
  const std::string both = "\"pinion.twist_compensation\" = { values = [0, 1] }\n\"pinion.modification.lead_crowning\" = { values = [0, 20] }\n";
  std::string compensated = sweep + both;
  compensated.replace(compensated.find("face_width = 40\n"), 16, "face_width = 40\ntwist_compensation = 1\n");
  CHECK(has_effect(compensated, "natural_twist"));
  CHECK(has_effect(sweep + "\"misalignment.crossing\" = { normal = [0, 13] }\n", "misalignment"));  // beyond the range at a millionth
  CHECK(has_effect(sweep + "\"misalignment.mesh_misalignment\" = { values = [0, 10, 0] }\n", "misalignment"));

  CHECK(has_effect("task = \"analyse\"\nanalyse.gradients = [\"pinion.modification.lead_crowning\"]\n" + ground, "natural_twist"));
}

TEST_CASE("A drawn gear is a gear with that deviation, whatever was found of it after the search", "[studies][optimise][slow]") {
  const std::string tolerance =
      "[optimise.scenes_drawn]\nsamples = 1\n[optimise.tolerances]\n\"pinion.modification.lead_slope\" = { values = [9] }\n";
  const StudyResults drawn = run_study(parse_study(small::optimisation() + tolerance, "drawn.toml"));
  const CycleSummary shown = loaded_of(drawn, "drawn 1", "before").summary;
  const StudyResults given =
      run_study(parse_study(small::optimisation(), "given.toml",
                            {{"task", "analyse"}, {"pinion.modification.lead_slope", "9"}, {"pinion.modification.lead_crowning", "0"}}));
  const CycleSummary alone = given.loaded.front().summary;
  CHECK(shown.te_peak_to_peak == Approx(alone.te_peak_to_peak).epsilon(1e-9));  // of loads solved from other starts
  CHECK(shown.peak_contact_stress == Approx(alone.peak_contact_stress).epsilon(1e-9));
  CHECK(shown.peak_line_load == Approx(alone.peak_line_load).epsilon(1e-9));
}

}  // namespace flankwright::studies
