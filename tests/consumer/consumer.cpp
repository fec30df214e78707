#include <cstdio>

#include "core/gear/gear_pair.hpp"
#include "studies/base/version.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"

int main() {
  using namespace flankwright;
  const studies::Study study = studies::parse_study(
      "[pair]\nnormal_module = 3\n[pinion]\nteeth = 20\nface_width = 20\n[wheel]\nteeth = 40\nface_width = 20\n"
      "[load]\ntorque = 100\n[cycle]\npositions = 2\npeaks = \"sampled\"\n[fidelity]\ncompliance = \"thin_slice\"\n",
      "consumer");
  const studies::StudyResults results = studies::run_study(study);
  std::printf("%s %.0f %zu\n", studies::version(), make_gear_pair(study.pair).centre_distance, results.loaded.size());
}
