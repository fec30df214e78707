#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/problem/design_problem.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/core/load/load_cases.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

/// The task of the main example, coarser; the optimisation itself ends at once.
DesignTask main_task() {
  const studies::Study study = studies::read_study(
      FLANKWRIGHT_SOURCE_DIR "/studies/examples/helical-18-54.toml",
      {{"cycle.positions", "8"}, {"fidelity.quadrature.intervals", "4"}, {"optimise.max_evaluations", "1"}, {"optimise.comparison.rules", "off"}});
  return studies::optimised(studies::run_study(study)).task;
}

/// Root mean square of the noise of equally spaced values of a smooth function, from their third differences, in which noise of one
/// value has the weights 1, -3, 3, -1: a variance of 20 times its own.
double noise_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 3; i < values.size(); ++i) {
    const double third = values[i] - 3.0 * values[i - 1] + 3.0 * values[i - 2] - values[i - 3];
    sum += third * third;
  }
  return std::sqrt(sum / 20.0 / static_cast<double>(values.size() - 3));
}

}  // namespace

TEST_CASE("Hard: along random lines in design space objectives have no noise that would mislead an optimiser", "[hard_cases][optimize][slow]") {
  constexpr double kNoise = 1e-9;  // relative
  constexpr int samples = 9, lines = 6;
  DesignProblem problem(main_task());
  Random random(2026);
  double worst_stress = 0.0, worst_te = 0.0;
  for (int line = 0; line < lines; ++line) {
    const Eigen::VectorXd from = random.vector(problem.variables(), 0.1, 0.9);
    Eigen::VectorXd along = random.vector(problem.variables(), -1.0, 1.0);
    // 1 um of the variable that moves most.
    double longest = 0.0;
    for (int i = 0; i < problem.variables(); ++i) {
      longest = std::max(longest, std::abs(problem.unscaled(from + along, i) - problem.unscaled(from, i)));
    }
    along *= units::um / longest;
    for (const double step : {1e-6, 1e-5, 1e-4}) {
      std::vector<double> stress, te;
      for (int i = 0; i < samples; ++i) {
        const DesignAnalysis& analysis = problem.analyse(from + i * step * along, false);
        stress.push_back(problem.objective(analysis));
        te.push_back(summarise(problem.model(1), analysis.cycles[1]).te_harmonics.front());
      }
      CAPTURE(line, step);
      REQUIRE(stress.front() > 0.0);
      CHECK(noise_of(stress) <= kNoise * stress.front());
      CHECK(noise_of(te) <= kNoise * te.front());
      worst_stress = std::max(worst_stress, noise_of(stress) / stress.front());
      worst_te = std::max(worst_te, noise_of(te) / te.front());
      // What is left of the values' own change stands far above it: differences show the slope.
      CHECK(std::abs(stress.back() - stress.front()) > 10.0 * noise_of(stress));
    }
  }
  CAPTURE(worst_stress, worst_te);
  CHECK(worst_stress <= kNoise);
}
