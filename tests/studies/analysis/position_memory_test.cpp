#include "studies/analysis/position_memory.hpp"

#include <catch2/catch.hpp>

#include "studies/analysis/step_progress.hpp"

namespace flankwright::studies {
namespace {

constexpr Eigen::Index points = 10;  // of a position
constexpr std::size_t bytes = sizeof(double) * points * points;

/// A mesh whose influence is its phase, and how often positions of it were made.
struct CountedMesh {
  double sign;
  int made{0};

  MeshAt at() {
    return [this](const std::vector<double>& phases) {
      MeshModel mesh;
      for (const double phase : phases) {
        ++made;
        MeshPosition& position = mesh.positions.emplace_back();
        position.phase = phase;
        position.influence = Eigen::MatrixXd::Constant(points, points, sign * phase);
      }
      return mesh;
    };
  }
};

}  // namespace

TEST_CASE("Mesh positions are made once while the memories of a run keep no more than their budget", "[studies][memory]") {
  PositionBudget budget(3 * bytes);
  PositionMemory memory(budget), other_memory(budget);
  CountedMesh mesh{1.0}, other{-1.0};
  const MeshAt at = memory.remembering(mesh.at()), other_at = other_memory.remembering(other.at());
  const std::vector<double> phases{0.25, 0.5};

  CHECK(at(phases).positions[1].influence(0, 0) == 0.5);
  CHECK(at({0.5, 0.25, 0.5}).positions[2].influence(0, 0) == 0.5);
  CHECK(mesh.made == 2);

  // Two positions more are beyond the budget: the memory that was used longest ago forgets, and makes them anew where it is asked.
  CHECK(other_at(phases).positions[0].influence(0, 0) == -0.25);
  CHECK(other_at(phases).positions[0].influence(0, 0) == -0.25);
  CHECK(other.made == 2);
  CHECK(at(phases).positions[0].influence(0, 0) == 0.25);
  CHECK(mesh.made == 4);
  CHECK(at(phases).positions[0].influence(0, 0) == 0.25);
  CHECK(mesh.made == 4);
}

TEST_CASE("A memory that goes takes its positions out of the budget", "[studies][memory]") {
  PositionBudget budget(2 * bytes);
  PositionMemory memory(budget);
  CountedMesh mesh{1.0}, other{-1.0};
  const MeshAt at = memory.remembering(mesh.at());
  {
    PositionMemory gone(budget);
    gone.remembering(other.at())({0.1, 0.2});
  }
  at({0.25, 0.5});
  at({0.25, 0.5});
  CHECK(mesh.made == 2);
}

TEST_CASE("A step that is done at once reports no progress", "[studies][progress]") {
  int reports = 0;
  const ProgressReport progress = [&](const std::string&, int, int, const std::string&) { ++reports; };
  StepProgress step(progress, "analysing", 3);
  for (int i = 0; i < 3; ++i) step.add_one();
  CHECK(reports == 0);
}

}  // namespace flankwright::studies
