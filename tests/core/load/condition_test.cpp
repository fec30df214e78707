#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/load/solve/load_solver.hpp"
#include "tests/core/load/load_cases.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

/// H = aKa + a c' over the loaded points of a solution.
Eigen::MatrixXd loaded_matrix(const LoadProblem& problem, const LoadDistribution& found, std::vector<Eigen::Index>& loaded) {
  for (Eigen::Index i = 0; i < found.line_load.size(); ++i) {
    if (found.line_load[i] > 0.0) loaded.push_back(i);
  }
  const Eigen::VectorXd a = problem.weight(loaded);
  Eigen::MatrixXd H = a.asDiagonal() * problem.influence(loaded, loaded) * a.asDiagonal();
  for (std::size_t i = 0; i < loaded.size() && !problem.laws.empty(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    H(row, row) += a[row] * problem.laws[static_cast<std::size_t>(loaded[i])].slope(found.line_load[loaded[i]]);
  }
  return H;
}

}  // namespace

TEST_CASE("The condition of a load distribution is that of its loaded points' matrix", "[core][load][hard]") {
  Random random(1988);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const LoadProblem problem = load_cases::random_problem(random.integer(1, 60), random);
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    if (problem.laws.empty()) continue;
    std::vector<Eigen::Index> loaded;
    const Eigen::MatrixXd H = loaded_matrix(problem, found, loaded);
    const Eigen::MatrixXd inverse = H.inverse();
    const double norms = H.cwiseAbs().colwise().sum().maxCoeff() * inverse.cwiseAbs().colwise().sum().maxCoeff();
    CAPTURE(i, loaded.size(), norms);
    CHECK(found.condition >= 1.0 - 1e-12);
    if (norms > 1e12) continue;  // the inverse itself has few digits left
    ++compared;
    // The estimate of ||H^-1|| is a lower bound, hardly ever less than a third; H is that of the step before, 1e-7 away.
    CHECK(found.condition <= norms * (1.0 + 1e-3));
    CHECK(found.condition >= norms / 10.0);
  }
  CHECK(compared >= 200);
}

TEST_CASE("Loads lose the digits that the condition says, f_t none of them", "[core][load][hard]") {
  constexpr double share = 1e-10;  // of every entry of K
  Random random(1989);
  double worst_condition = 0.0;
  for (int i = 0; i < 200; ++i) {
    const int n = random.integer(2, 40);
    const LoadProblem problem = load_cases::random_problem(n, random);
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    if (problem.laws.empty() || found.condition > 1e8) continue;
    LoadProblem disturbed = problem;
    const Eigen::MatrixXd noise = random.matrix(n, n);
    disturbed.influence.array() *= 1.0 + share * 0.5 * (noise + noise.transpose()).array();
    const LoadDistribution other = solve_load_distribution(disturbed);
    REQUIRE(other.usable());
    CAPTURE(i, n, found.condition);
    const double loads = (other.line_load - found.line_load).lpNorm<1>() / found.line_load.lpNorm<1>();
    // Twice the bound of a linear system of n entries, for the balance that comes with it; 1e-9: residual bound of both answers.
    CHECK(loads <= 2.0 * n * found.condition * share + 1e-9);
    const Eigen::VectorXd terms = problem.influence.cwiseAbs() * problem.weight.cwiseProduct(found.line_load) + found.contact_deflection;
    const double digits = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(found.transmission_error);
    CHECK(std::abs(other.transmission_error - found.transmission_error) <= 2.0 * share * terms.maxCoeff() + digits);
    worst_condition = std::max(worst_condition, found.condition);
  }
  CHECK(worst_condition > 1e4);  // it is put to the test
}
