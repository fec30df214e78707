#include "tests/core/compliance/fitted/synthetic_gear.hpp"

#include <cmath>

#include "core/base/units.hpp"

namespace flankwright::testing {
namespace {

constexpr int kAxial = 12, kRadial = 4, kBasis = kAxial * kRadial;
constexpr double kHeight = 2.2;
using Row = Eigen::Matrix<double, 1, kBasis>;
struct Basis {
  Row value, dx, dy;
};
struct Node {
  double x, weight;
};

/// Legendre polynomials and their slopes up to degree n - 1.
std::pair<std::vector<double>, std::vector<double>> legendre(int n, double x) {
  std::vector<double> P{1, x}, slope{0, 1};
  for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(n); ++k) {
    const auto d = static_cast<double>(k);
    P.push_back(((2 * d + 1) * x * P[k] - d * P[k - 1]) / (d + 1));
    slope.push_back(slope[k - 1] + (2 * d + 1) * P[k]);
  }
  return {P, slope};
}

std::vector<Node> gauss(int n) {
  std::vector<Node> nodes;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(units::pi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 20; ++step) {
      const auto [P, dP] = legendre(n + 1, x);
      slope = dP.back();
      x -= P.back() / slope;
    }
    nodes.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

/// (1 + y) P_i(x) P_j(y): zero at the root.
Basis basis(double x, double y) {
  const auto [Px, dPx] = legendre(kAxial, x);
  const auto [Py, dPy] = legendre(kRadial, y);
  Basis f;
  for (int i = 0; i < kAxial; ++i) {
    for (int j = 0; j < kRadial; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const int k = i * kRadial + j;
      f.value[k] = (1 + y) * Px[a] * Py[b];
      f.dx[k] = (1 + y) * dPx[a] * Py[b];
      f.dy[k] = Px[a] * (Py[b] + (1 + y) * dPy[b]);
    }
  }
  return f;
}

}  // namespace

SyntheticGear::SyntheticGear(GearProportions facts, double skew) : facts_(facts) {
  constexpr int kAxialGauss = 24, kRadialGauss = 8;
  const double B = facts.relative_face, nu = 0.3;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * kBasis, 3 * kBasis);
  for (const auto& [x, wx] : gauss(kAxialGauss)) {
    for (const auto& [y, wy] : gauss(kRadialGauss)) {
      const Basis f = basis(x, y);
      // d/dx at fixed y and d/dy at fixed x on the skew plate, x = (x_ref + 1) B/2 + skew y.
      const Row f_x = f.dx * (2 / B), f_y = f.dy * (2 / kHeight) - skew * f_x;
      const double t = 1.6 - 0.7 * y, area = wx * wy * B / 2 * kHeight / 2;
      const double D = t * t * t / (12 * (1 - nu * nu)), shear = 5.0 / 6 * t / (2 * (1 + nu));
      Eigen::Matrix<double, 5, 3 * kBasis> strain = Eigen::Matrix<double, 5, 3 * kBasis>::Zero();
      strain.block<1, kBasis>(0, kBasis) = f_x;
      strain.block<1, kBasis>(1, 2 * kBasis) = f_y;
      strain.block<1, kBasis>(2, kBasis) = f_y;
      strain.block<1, kBasis>(2, 2 * kBasis) = f_x;
      strain.block<1, kBasis>(3, 0) = f_x;
      strain.block<1, kBasis>(3, kBasis) = -f.value;
      strain.block<1, kBasis>(4, 0) = f_y;
      strain.block<1, kBasis>(4, 2 * kBasis) = -f.value;
      Eigen::Matrix<double, 5, 5> law = Eigen::Matrix<double, 5, 5>::Zero();
      law(0, 0) = law(1, 1) = D;
      law(0, 1) = law(1, 0) = nu * D;
      law(2, 2) = D * (1 - nu) / 2;
      law(3, 3) = law(4, 4) = shear;
      stiffness.noalias() += area * strain.transpose() * law * strain;
    }
  }
  factor_.compute(stiffness);
}

InfluenceSample SyntheticGear::sample(const std::vector<FlankStation>& points) const {
  const auto n = static_cast<Eigen::Index>(points.size());
  const double B = facts_.relative_face;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * kBasis, n);
  for (Eigen::Index p = 0; p < n; ++p) {
    const FlankStation& point = points[static_cast<std::size_t>(p)];
    loads.col(p).head<kBasis>() = basis(2 * point.zeta / B - 1, point.u).value.transpose();
  }
  const Eigen::MatrixXd half = factor_.matrixL().solve(Eigen::MatrixXd(factor_.transpositionsP() * loads));
  const Eigen::VectorXd pivots = factor_.vectorD();
  InfluenceSample sample{facts_, points, half.transpose() * pivots.cwiseInverse().asDiagonal() * half};
  for (Eigen::Index p = 0; p < n; ++p) {
    for (Eigen::Index q = 0; q < n; ++q) {
      const FlankStation &a = points[static_cast<std::size_t>(p)], &b = points[static_cast<std::size_t>(q)];
      const double m = a.tooth - b.tooth, axial = a.zeta - b.zeta + units::pi * std::sin(facts_.helix_angle) * m;
      const double d2 = axial * axial + units::pi * units::pi * m * m;
      const double tilt = (2 * a.zeta / B - 1) * (2 * b.zeta / B - 1);
      if (m != 0) sample.compliance(p, q) = 0;
      sample.compliance(p, q) +=
          1.2 * (1 + 0.3 * a.u) * (1 + 0.3 * b.u) / std::sqrt(1 + d2) + 0.3 + 0.1 * tilt * std::cos(2 * units::pi * m / facts_.teeth);
    }
  }
  sample.compliance = (0.5 * (sample.compliance + sample.compliance.transpose())).eval();
  return sample;
}

std::vector<FlankStation> SyntheticGear::grid(int radial, int axial, int first, int last) const {
  std::vector<FlankStation> points;
  for (int m = first; m <= last; ++m) {
    for (int i = 0; i < radial; ++i) {
      for (int j = 0; j < axial; ++j) {
        const double x = -std::cos(units::pi * (j + 0.5) / axial);
        points.push_back({m, radial == 1 ? 0.0 : -0.95 + 1.9 * i / (radial - 1), facts_.relative_face * 0.5 * (1 + x)});
      }
    }
  }
  return points;
}

}  // namespace flankwright::testing
