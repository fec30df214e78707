#include "optimize/design/problem/mesh_store.hpp"

#include <catch2/catch.hpp>

#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;

namespace {

/// A mesh with nothing but an influence matrix of so many bytes.
MeshModel mesh_of_bytes(std::size_t bytes) {
  MeshModel mesh;
  mesh.positions.resize(1);
  mesh.positions[0].influence.resize(static_cast<Eigen::Index>(bytes / sizeof(double)), 1);
  return mesh;
}

MeshKey key_of(int intervals) {
  MeshKey key;
  key.resolution = {{QuadratureRule::Graded, intervals}, {0.0}};
  return key;
}

}  // namespace

TEST_CASE("Design problems that share a store have the same meshes, and the same answers as without one", "[optimize][mesh-store]") {
  DesignTask task = design_tasks::helical({0.0, 12.0});
  const DesignProblem alone(task);
  task.meshes = std::make_shared<MeshStore>();
  const DesignProblem first(task);
  DesignTask other_limits = task;
  other_limits.constraints.push_back({.output = design_tasks::term(Output::TePeakToPeak), .maximum = 1.0});
  const DesignProblem second(other_limits);
  CHECK(&first.model(0) == &second.model(0));
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(first.variables(), 0.4);
  const DesignAnalysis expected = alone.analyse_design(alone.modification(x)), found = second.analyse_design(second.modification(x));
  for (std::size_t s = 0; s < expected.cycles.size(); ++s) CHECK(found.cycles[s].transmission_error() == expected.cycles[s].transmission_error());

  DesignTask finer = task;
  finer.resolution.quadrature.intervals *= 2;
  CHECK(&DesignProblem(finer).model(0) != &first.model(0));
  DesignTask without = task;
  without.effects = MeshEffects::all_but({"free_ends"});
  CHECK(&DesignProblem(without).model(0) != &first.model(0));
  DesignTask softer = task;
  softer.root_stress = nullptr;
  CHECK(&DesignProblem(softer).model(0) != &first.model(0));
}

TEST_CASE("A store forgets the mesh that was not used for longest", "[optimize][mesh-store]") {
  constexpr std::size_t two_fifths = MeshStore::most_bytes / 5 * 2;
  MeshStore store;
  const auto add = [&](int intervals) { return store.mesh(key_of(intervals), [] { return mesh_of_bytes(two_fifths); }); };
  const auto one = add(1);
  add(2);
  CHECK(store.mesh(key_of(1), []() -> MeshModel { throw std::logic_error("is known"); }) == one);
  add(3);
  CHECK(store.find(key_of(1)) == one);
  CHECK(store.find(key_of(2)) == nullptr);
  CHECK(store.find(key_of(3)) != nullptr);
}
