#include <catch2/catch.hpp>

#include "core/load/cycle/cycle_figures.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/common/random.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

/// A pair within the library of fits: spur or helical, crowned and misaligned as may be.
std::string random_pair(unsigned seed) {
  tests::Random32 random(seed);
  const double helix = random.chance(0.3) ? 0.0 : random(5.0, 30.0), face = random(5.0, 9.0);
  const int pinion = static_cast<int>(random(17.0, 40.0)), wheel = static_cast<int>(random(40.0, 80.0));
  const double shift = random(-0.2, 0.4), crowning = random(0.0, 10.0), misalignment = random(-15.0, 15.0), torque = random(1.0, 8.0);
  const auto key = [](const char* name, double value) { return name + std::string(" = ") + std::to_string(value) + "\n"; };
  return "[pair]\nnormal_module = 1\n" + key("helix_angle", helix) + "[pinion]\nteeth = " + std::to_string(pinion) + "\n" +
         key("profile_shift", shift) + key("face_width", face) + key("modification.lead_crowning", 0.1 * crowning) +
         "[wheel]\nteeth = " + std::to_string(wheel) + "\n" + key("profile_shift", -shift) + key("face_width", face) + "[load]\n" +
         key("torque", torque) + "[misalignment]\n" + key("mesh_misalignment", 0.1 * misalignment) + "[cycle]\npeaks = \"sampled\"\n";
}

CycleFigures figures(const std::string& pair, const std::string& compliance) {
  const StudyResults results = run_study(parse_study(
      pair + "positions = 32\n[fidelity]\nquadrature = { rule = \"graded\", intervals = 12 }\ncompliance = \"" + compliance + "\"\n", "pair.toml"));
  const LoadedCycle& cycle = results.loaded.front().cycle;
  return figures_of(cycle, summarise(results.models.front(), cycle));
}

}  // namespace

TEST_CASE("Estimated errors of compliance models hold beside finite elements", "[.soak][studies][accuracy][fe]") {
  int drawn = 0, within = 0, over_tenfold = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const std::string pair = random_pair(seed);
    const StudyResults chosen = run_study(parse_study(pair + "[fidelity]\naccuracy = \"50 %\"\n", "pair.toml"));
    REQUIRE(chosen.fidelity_choice);
    const CycleFigures truth = figures(pair, "fe");
    for (const ModelCandidate& model : chosen.fidelity_choice->compliances) {
      if (model.name == "fe") continue;
      const double stated = largest(model.error), found = largest(figure_errors(figures(pair, model.name), truth));
      UNSCOPED_INFO(seed << ", " << model.name << ": stated " << 100 * stated << " %, found " << 100 * found << " %");
      ++drawn;
      within += found <= stated ? 1 : 0;
      over_tenfold += stated > 10.0 * found ? 1 : 0;
    }
  }
  CAPTURE(within, over_tenfold);
  CHECK(within >= 0.95 * drawn);
  CHECK(over_tenfold <= 0.1 * drawn);
}
