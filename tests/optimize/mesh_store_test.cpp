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

TEST_CASE("A store forgets the meshes that were not used for longest", "[optimize][mesh-store]") {
  constexpr std::size_t two_fifths = MeshStore::most_bytes / 5 * 2;
  MeshStore store;
  const auto add = [&](int intervals) { return store.mesh(key_of(intervals), [](const std::vector<double>&) { return mesh_of_bytes(two_fifths); }); };
  const auto one = add(1);
  add(2);
  CHECK(store.mesh(key_of(1), [](const std::vector<double>&) -> MeshModel { throw std::logic_error("is known"); }) == one);
  add(3);
  CHECK(store.find(key_of(1)) == one);
  CHECK(store.find(key_of(2)) == nullptr);
  CHECK(store.find(key_of(3)) != nullptr);
}

TEST_CASE("A store keeps all placements of one resolution, and knows what others still have", "[optimize][mesh-store]") {
  constexpr std::size_t two_thirds = MeshStore::most_bytes / 3 * 2;
  MeshStore store;
  const auto add = [&](int intervals, double torque) {
    MeshKey key = key_of(intervals);
    key.placement.torque = torque;
    return store.mesh(key, [](const std::vector<double>&) { return mesh_of_bytes(two_thirds); });
  };
  const auto placed_at = [&](int intervals, double torque) {
    MeshKey key = key_of(intervals);
    key.placement.torque = torque;
    return store.find(key);
  };
  add(1, 1.0);
  const auto held = add(1, 2.0);
  CHECK(placed_at(1, 1.0) != nullptr);
  CHECK(placed_at(1, 2.0) == held);
  add(2, 1.0);
  CHECK(placed_at(1, 1.0) == nullptr);
  CHECK(placed_at(1, 2.0) == held);
}

TEST_CASE("A mesh at twice the phases has those that are known, to the last bit", "[optimize][mesh-store]") {
  DesignTask task = design_tasks::helical({0.0});
  task.resolution.phases = equally_spaced_phases(16);
  const DesignProblem alone(task);
  task.meshes = std::make_shared<MeshStore>();
  task.resolution.phases = equally_spaced_phases(8);
  const DesignProblem few(task);
  task.resolution.phases = equally_spaced_phases(16);
  const DesignProblem more(task);
  const auto positions = [](const DesignProblem& problem) -> const std::vector<MeshPosition>& { return problem.model(0).positions; };
  REQUIRE(positions(more).size() == 16);
  for (std::size_t i = 0; i < 16; ++i) {
    CHECK(positions(more)[i].phase == positions(alone)[i].phase);
    CHECK(positions(more)[i].influence == positions(alone)[i].influence);
  }
  std::vector<double> asked;
  MeshKey key{more.model(0).placement, {task.resolution.quadrature, {0.0, 0.25, 0.3}}, task.effects.list(), task.structure, task.root_stress, {}};
  task.meshes->mesh(key, [&](const std::vector<double>& phases) {
    asked = phases;
    return make_mesh_model(task.pair, task.material, {task.resolution.quadrature, phases}, task.effects, key.placement,
                           {.structure = task.structure.get(), .root_stress = task.root_stress.get()});
  });
  CHECK(asked == std::vector<double>{0.3});
}
