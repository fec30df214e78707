#include "core/load/solve/quadratic_program.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <limits>
#include <optional>

#include "tests/core/load/load_cases.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

struct Minimum {
  Eigen::VectorXd x;
  double multiplier;
  int factorisations;
  bool solved;
};

struct Programme {
  Eigen::MatrixXd H;
  Eigen::VectorXd b, a;
  double F;

  /// From no load at all.
  Minimum solve(const Flags& guess) const {
    QuadraticProgram program;
    const bool solved = program.minimise({H, b, a, F, Eigen::VectorXd::Zero(b.size())}, guess);
    return {program.loads(), program.multiplier(), program.factorisations(), solved};
  }
  double objective(const Eigen::VectorXd& x) const { return 0.5 * x.dot(H * x) + b.dot(x); }
};

/// Random definite programme; ridge is what is left of the smallest eigenvalues, relative to the largest entries.
Programme random_programme(Eigen::Index n, Random& random, double ridge) {
  Programme p;
  const Eigen::MatrixXd factor = random.matrix(n, std::max<Eigen::Index>(1, n / 2));
  p.H = factor * factor.transpose();
  p.H.diagonal().array() += ridge * p.H.diagonal().maxCoeff();
  p.b = random.vector(n, -1.0, 1.0);
  p.a = random.vector(n, 0.2, 2.0);
  p.F = random.log_uniform(0.01, 100.0);
  return p;
}

Flags subset(Eigen::Index n, unsigned bits) {
  Flags flags(n);
  for (Eigen::Index i = 0; i < n; ++i) flags[i] = (bits >> i & 1U) != 0;
  return flags;
}

/// The lowest objective over all sets of free points whose equality-constrained minimiser is non-negative.
Eigen::VectorXd minimiser_by_enumeration(const Programme& p) {
  const Eigen::Index n = p.b.size();
  Eigen::VectorXd best;
  double lowest = std::numeric_limits<double>::infinity();
  for (unsigned bits = 1; bits < (1U << n); ++bits) {
    std::vector<Eigen::Index> set;
    for (Eigen::Index i = 0; i < n; ++i) {
      if ((bits >> i & 1U) != 0) set.push_back(i);
    }
    const auto m = static_cast<Eigen::Index>(set.size());
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(m + 1, m + 1);
    kkt.topLeftCorner(m, m) = p.H(set, set);
    kkt.topRightCorner(m, 1) = kkt.bottomLeftCorner(1, m).transpose() = p.a(set);
    Eigen::VectorXd right(m + 1);
    right << -p.b(set), p.F;
    const Eigen::VectorXd free = kkt.partialPivLu().solve(right).head(m);
    if (free.minCoeff() < 0.0) continue;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    x(set) = free;
    if (p.objective(x) < lowest) {
      lowest = p.objective(x);
      best = x;
    }
  }
  return best;
}

/// Largest violation of the optimality conditions, relative to the terms of the gradient.
double violation(const Programme& p, const Minimum& m) {
  const Eigen::VectorXd slack = p.H * m.x + p.b - m.multiplier * p.a;
  const Eigen::VectorXd terms = p.H.cwiseAbs() * m.x + p.b.cwiseAbs() + std::abs(m.multiplier) * p.a;
  double worst = std::abs(p.a.dot(m.x) - p.F) / p.F;
  for (Eigen::Index i = 0; i < slack.size(); ++i) {
    worst = std::max(worst, (m.x[i] > 0.0 ? std::abs(slack[i]) : -slack[i]) / terms[i]);
  }
  return worst;
}

}  // namespace

TEST_CASE("The quadratic programme finds the best of all sets of loaded points", "[core][load][independent]") {
  constexpr double kRoundOff = 1e-10;  // condition of H here up to about 1e4
  Random random(17);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = random.integer(1, trial < 20 ? 10 : 7);
    const Programme p = random_programme(n, random, random.log_uniform(1e-3, 1.0));
    const Minimum found = p.solve(Flags::Constant(n, true));
    CAPTURE(trial, n);
    REQUIRE(found.solved);
    CHECK(found.x.minCoeff() >= 0.0);
    CHECK((found.x - minimiser_by_enumeration(p)).norm() <= kRoundOff * found.x.norm());
  }
}

TEST_CASE("Every guess of the loaded points leads to the same minimiser", "[core][load]") {
  constexpr double kRoundOff = 1e-12;
  Random random(18);
  const Programme p = random_programme(7, random, 0.05);
  const Minimum reference = p.solve(Flags::Constant(7, true));
  REQUIRE(reference.solved);
  for (unsigned bits = 0; bits < 128; ++bits) {  // 0 is "no idea"
    const Minimum found = p.solve(subset(7, bits));
    CAPTURE(bits);
    REQUIRE(found.solved);
    CHECK((found.x - reference.x).norm() <= kRoundOff * reference.x.norm());
    CHECK(found.multiplier == Approx(reference.multiplier).epsilon(kRoundOff));
  }
}

TEST_CASE("Points that just touch without load do not make the quadratic programme cycle", "[core][load][hard]") {
  constexpr double kRoundOff = 1e-13;
  // Springs of compliance 1 that meet at heights 0, 0, 1, 1, 1: the first two carry the force 2 at approach 1, where
  // the others begin to touch.
  const int count = 5;
  Programme p{Eigen::MatrixXd::Identity(count, count), Eigen::VectorXd(count), Eigen::VectorXd::Ones(count), 2.0};
  p.b << 0.0, 0.0, 1.0, 1.0, 1.0;
  for (unsigned bits = 0; bits < 32; ++bits) {
    const Minimum found = p.solve(subset(count, bits));
    CAPTURE(bits);
    REQUIRE(found.solved);
    CHECK(found.multiplier == Approx(1.0).epsilon(kRoundOff));
    CHECK((found.x - Eigen::VectorXd(Eigen::VectorXd::Unit(count, 0) + Eigen::VectorXd::Unit(count, 1))).norm() <= kRoundOff);
  }
  // The same with rounded coupling: nothing comes out as an exact zero.
  Random random(19);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = random.integer(2, 30);
    Programme tied = random_programme(n, random, random.log_uniform(1e-6, 1.0));
    const Flags first_half = subset(n, (1U << (n / 2 + 1)) - 1U);
    Eigen::VectorXd x = first_half.select(random.vector(n, 0.5, 1.5), Eigen::VectorXd::Zero(n));
    tied.b = 0.7 * tied.a - tied.H * x;  // slack zero at every point, loaded or not
    tied.F = tied.a.dot(x);
    const Minimum found = tied.solve(Flags::Constant(n, true));
    CAPTURE(trial, n);
    REQUIRE(found.solved);
    CHECK(violation(tied, found) <= kRoundOff);
  }
}

TEST_CASE("The quadratic programme is solved where H is nearly singular", "[core][load][hard]") {
  // Round-off: the loads of a singular structure are large against their sum.
  constexpr double kRoundOff = 1e-11;
  Random random(20);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = random.integer(2, 120);
    const Programme p = random_programme(n, random, random.log_uniform(1e-8, 1e-4));
    const Minimum found = p.solve(Flags::Constant(n, true));
    CAPTURE(trial, n);
    REQUIRE(found.solved);
    CHECK(found.x.minCoeff() >= 0.0);
    CHECK(violation(p, found) <= kRoundOff);
    CHECK(found.factorisations <= 10 * n);
  }
}
