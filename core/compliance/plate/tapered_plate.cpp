#include "core/compliance/plate/tapered_plate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void validate(const PlateShape& shape, int along, int up) {
  const auto refuse = [](const char* field, double value, const char* allowed) {
    throw InvalidInput(std::string("plate.") + field, std::to_string(value), allowed);
  };
  if (!(shape.length > 0)) refuse("length", shape.length, "positive");
  if (!(shape.poissons_ratio >= 0 && shape.poissons_ratio < 0.5)) {
    refuse("poissons_ratio", shape.poissons_ratio, "at least 0 and below 0.5");
  }
  if (!(shape.shear_factor > 0)) refuse("shear_factor", shape.shear_factor, "positive");
  const EdgeCompliance& edge = shape.edge;
  const double determinant = edge.force * edge.moment - edge.cross * edge.cross;
  if (!(edge.force > 0 && determinant > 0)) refuse("edge", determinant, "a positive definite compliance");
  if (along < 2 || up < 2) refuse("polynomials", std::min(along, up), "two or more each way");
  if (shape.heights.size() < 2 || !std::is_sorted(shape.heights.begin(), shape.heights.end(), std::less_equal{})) {
    refuse("heights", static_cast<double>(shape.heights.size()), "two or more, ascending");
  }
}

/// Integrals over the height, weighted by a stiffness that depends on it: of q_i q_j, q_i' q_j, q_i' q_j'.
struct HeightProducts {
  MatrixXd values, mixed, slopes;
  explicit HeightProducts(Index n) : values(MatrixXd::Zero(n, n)), mixed(values), slopes(values) {}
  void add(double weight, const LegendreValues& q) {
    values += weight * q.value * q.value.transpose();
    mixed += weight * q.slope * q.value.transpose();
    slopes += weight * q.slope * q.slope.transpose();
  }
};

/// block += factor * kron(X, Y)
void add_product(Eigen::Ref<MatrixXd> block, const MatrixXd& X, const MatrixXd& Y, double factor = 1) {
  const Index n = Y.rows();
  for (Index i = 0; i < X.rows(); ++i) {
    for (Index j = 0; j < X.cols(); ++j) {
      if (X(i, j) != 0) block.block(i * n, j * n, n, n) += factor * X(i, j) * Y;
    }
  }
}

/// Mean of the polynomials under the weights of PlateLoad, as far as these lie in the interval.
Eigen::VectorXd weighted_mean(const LegendreBasis& basis, const GaussRule& rule, double centre, double half) {
  const double low = std::max(basis.low(), centre - half), high = std::min(basis.high(), centre + half);
  if (!(high > low)) return basis.at(centre).value;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(basis.count());
  double total = 0;
  for (Index k = 0; k < rule.nodes.size(); ++k) {
    const double x = 0.5 * (low + high + rule.nodes[k] * (high - low));
    const double t = (x - centre) / half;
    const double weight = rule.weights[k] * (1 - t * t) * (1 - t * t);
    sum += weight * basis.at(x).value;
    total += weight;
  }
  return sum / total;
}

}  // namespace

TaperedPlate::TaperedPlate(const PlateShape& shape, int along, int up)
    : along_((validate(shape, along, up), 0.0), shape.length, along),
      up_(shape.heights.front(), shape.heights.back(), up),
      along_rule_(along / 2 + 3),
      up_rule_(up / 2 + 3) {
  const double nu = shape.poissons_ratio;
  HeightProducts bending(up), shear(up);
  const GaussRule rule(up + 12);
  for (std::size_t piece = 0; piece + 1 < shape.heights.size(); ++piece) {
    const double low = shape.heights[piece], high = shape.heights[piece + 1];
    for (Index k = 0; k < rule.nodes.size(); ++k) {
      // y = foot + (high - foot) t^2 on the lowest piece takes the square root out of a fillet that ends flat.
      const double t = 0.5 * (1 + rule.nodes[k]);
      const double y = low + (high - low) * (piece == 0 ? t * t : t);
      const double dy = 0.5 * rule.weights[k] * (high - low) * (piece == 0 ? 2 * t : 1);
      const double s = shape.thickness(y);
      const LegendreValues q = up_.at(y);
      bending.add(dy * s * s * s / (12 * (1 - nu * nu)), q);
      shear.add(dy * shape.shear_factor * s / (2 * (1 + nu)), q);
    }
  }

  const Index n = static_cast<Index>(along) * up;
  const MatrixXd I = MatrixXd::Identity(along, along), C = along_.slope_products(), CC = C * C.transpose();
  const double turn = 0.5 * (1 - nu);
  MatrixXd A = MatrixXd::Zero(3 * n, 3 * n);
  const auto block = [&](Index row, Index column) { return A.block(row * n, column * n, n, n); };
  add_product(block(0, 0), CC, shear.values);
  add_product(block(0, 0), I, shear.slopes);
  add_product(block(1, 0), C.transpose(), shear.values, -1);
  add_product(block(2, 0), I, shear.mixed.transpose(), -1);
  add_product(block(1, 1), CC, bending.values);
  add_product(block(1, 1), I, bending.slopes, turn);
  add_product(block(1, 1), I, shear.values);
  add_product(block(2, 1), C.transpose(), bending.mixed, nu);
  add_product(block(2, 1), C, bending.mixed.transpose(), turn);
  add_product(block(2, 2), I, bending.slopes);
  add_product(block(2, 2), CC, bending.values, turn);
  add_product(block(2, 2), I, shear.values);

  const EdgeCompliance& edge = shape.edge;
  const double determinant = edge.force * edge.moment - edge.cross * edge.cross;
  const Eigen::VectorXd foot = up_.at(shape.heights.front()).value;
  const MatrixXd at_foot = foot * foot.transpose();
  add_product(block(0, 0), I, at_foot, edge.moment / determinant);
  add_product(block(2, 0), I, at_foot, -edge.cross / determinant);
  add_product(block(2, 2), I, at_foot, edge.force / determinant);

  for (Index parity = 0; parity < 2; ++parity) {
    Symmetry& symmetry = symmetries_[static_cast<std::size_t>(parity)];
    for (Index field = 0; field < 3; ++field) {
      for (Index i = (field == 1 ? 1 - parity : parity); i < along; i += 2) {
        for (Index k = 0; k < up; ++k) symmetry.unknowns.push_back(field * n + i * up + k);
      }
    }
    symmetry.factor.compute(A(symmetry.unknowns, symmetry.unknowns));
    assert(symmetry.factor.info() == Eigen::Success);
  }
}

Eigen::VectorXd TaperedPlate::functional(const PlateLoad& load) const {
  const double half_height = std::clamp(load.half_height, 0.0, std::min(load.height - up_.low(), up_.high() - load.height));
  const Eigen::VectorXd p = weighted_mean(along_, along_rule_, load.along, load.half_length);
  const Eigen::VectorXd q = weighted_mean(up_, up_rule_, load.height, half_height);
  Eigen::VectorXd phi(p.size() * q.size());
  for (Index i = 0; i < p.size(); ++i) phi.segment(i * q.size(), q.size()) = p[i] * q;
  return phi;
}

MatrixXd TaperedPlate::influence(std::span<const PlateLoad> loads) const {
  const auto count = static_cast<Index>(loads.size());
  const Index n = static_cast<Index>(along_.count()) * up_.count();
  MatrixXd phi = MatrixXd::Zero(3 * n, count);
  for (Index p = 0; p < count; ++p) phi.col(p).head(n) = functional(loads[static_cast<std::size_t>(p)]);
  MatrixXd K = MatrixXd::Zero(count, count);
  for (const Symmetry& symmetry : symmetries_) {
    MatrixXd of_symmetry = phi(symmetry.unknowns, Eigen::all);
    symmetry.factor.matrixL().solveInPlace(of_symmetry);
    K.selfadjointView<Eigen::Lower>().rankUpdate(of_symmetry.transpose());
  }
  K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
  return K;
}

}  // namespace flankwright
