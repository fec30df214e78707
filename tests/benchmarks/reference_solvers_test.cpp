#include "core/load/solve/load_solver.hpp"
#include "tests/benchmarks/reference_solvers.hpp"

#include <catch2/catch.hpp>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "tests/benchmarks/load_scene.hpp"

using namespace flankwright;
using namespace flankwright::reference_solvers;

TEST_CASE("Ipopt and SLSQP find the loads that the solver finds", "[core][load][independent]") {
  // Where their own tests of convergence leave them, relative to the mean line load.
  constexpr double kInteriorPoint = 1e-6, kQuasiNewton = 1e-3;
  const MeshModel model = load_scene::model(4, 5, false);
  for (const MeshPosition& at : model.positions) {
    const LoadProblem problem{at.influence, at.weight, plane_of_action_gap(model.pair, at.points, load_scene::condition()).total, at.laws,
                              model.normal_force(load_scene::torque)};
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    const double mean = problem.force / problem.weight.sum();
    const Answer interior = solve_by_ipopt(problem), sequential = solve_by_slsqp(problem);
    REQUIRE(interior.line_load.size() == found.line_load.size());
    REQUIRE(sequential.line_load.size() == found.line_load.size());
    CHECK((interior.line_load - found.line_load).cwiseAbs().maxCoeff() <= kInteriorPoint * mean);
    CHECK((sequential.line_load - found.line_load).cwiseAbs().maxCoeff() <= kQuasiNewton * mean);
    CHECK(natural_residual(problem, found.line_load) <= 1e-11);                                        // round-off
    CHECK(natural_residual(problem, Eigen::VectorXd::Constant(found.line_load.size(), mean)) > 1e-2);  // it can tell
  }
}
