#include <catch2/catch.hpp>

#include "optimize/design/design_optimiser.hpp"
#include "optimize/design/outputs/scene_outputs.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/optimize/output_gradients.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// A spur pair whose rounded tip edges carry until they are relieved, with oil.
DesignTask edges_in_oil() {
  DesignTask task = relieved_spur();
  LifeModel life;
  life.lubricant = Lubricant{.viscosity_40 = 220.0, .viscosity_100 = 19.0, .temperature = 80.0};
  life.roughness = 0.5;
  life.permissible_film = 0.3;
  life.scuffing_temperature = 400.0;
  task.life = std::make_shared<const LifeModel>(life);
  for (DesignScene& scene : task.scenes) scene.operation.speed = 150.0;
  return task;
}

const std::vector<Output> in_oil{Output::SpecificFilmThickness, Output::FlashTemperature, Output::ContactTemperature, Output::MicropittingUtilisation,
                                 Output::ScuffingUtilisation};

}  // namespace

TEST_CASE("Film and temperatures on tip edges have the gradients of differences", "[optimize][design][life][gradient]") {
  DesignProblem problem(edges_in_oil());
  const Eigen::VectorXd x = Eigen::Vector2d(0.03, 0.05);
  const DesignAnalysis at = problem.analyse(x, false);
  std::vector<ObjectiveTerm> terms;
  for (const Output output : in_oil) {
    terms.push_back(term(output));
    const LoadedScene scene = problem.scene(at, 0);
    const PeakCandidate worst = leading_candidates(terms.back(), scene, 0.0, 1).front();
    CAPTURE(terms.back().name);
    CHECK(scene.cycle.positions[static_cast<std::size_t>(worst.position)].edge_stress[worst.other] > 0.0);
  }
  // As in the gradients of every output.
  CHECK(check_output_gradients(problem, x, terms, 2e-5, 1e-6) >= terms.size());
}

TEST_CASE("A search for a thick film or a cool contact relieves the tip edges", "[optimize][design][life]") {
  DesignTask task = edges_in_oil();
  const Output output = GENERATE(Output::MicropittingUtilisation, Output::ContactTemperature);
  task.objective = {term(output)};
  CAPTURE(task.objective.front().name);
  DesignProblem problem(task);
  const auto on_edges = [&](const DesignAnalysis& analysis) { return output_value(term(Output::EdgeStress), problem.scene(analysis, 0)); };
  const auto on_flanks = [&](const DesignAnalysis& analysis) { return output_value(term(Output::PeakContactStress), problem.scene(analysis, 0)); };
  const DesignResult found = optimise_design(problem, DesignOptions{});
  REQUIRE(on_edges(found.before.analysis) > 0.0);
  CHECK(on_edges(found.after.analysis) < 0.7 * on_edges(found.before.analysis));
  CHECK(on_flanks(found.after.analysis) < on_flanks(found.before.analysis));
}
