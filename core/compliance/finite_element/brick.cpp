#include "core/compliance/finite_element/brick.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "core/base/error.hpp"
#include "core/base/wide_sum.hpp"

namespace flankwright {
namespace {

constexpr int kBrickLocal[20][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
                                    {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
                                    {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0}};
constexpr int kFaceLocal[8][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}};

/// Factor of a node's function along one direction, and its derivative: 1 - x^2 at a mid-side, 1 + x x_i elsewhere.
struct Factor {
  double value, slope;
};
Factor factor(double x, int node) {
  if (node == 0) return {1 - x * x, -2 * x};
  return {1 + x * node, static_cast<double>(node)};
}

struct Lame {
  double lambda, mu;
  explicit Lame(const Material& material)
      : lambda(material.youngs_modulus * material.poissons_ratio / ((1 + material.poissons_ratio) * (1 - 2 * material.poissons_ratio))),
        mu(material.youngs_modulus / (2 * (1 + material.poissons_ratio))) {}
};

}  // namespace

BrickShape brick_shape(const Eigen::Vector3d& local) {
  BrickShape shape;
  for (int i = 0; i < 20; ++i) {
    const int* node = kBrickLocal[i];
    Factor f[3];
    for (int a = 0; a < 3; ++a) f[a] = factor(local[a], node[a]);
    const double product = f[0].value * f[1].value * f[2].value;
    const bool corner = i < 8;
    const double level = corner ? local[0] * node[0] + local[1] * node[1] + local[2] * node[2] - 2 : 1;
    const double scale = corner ? 0.125 : 0.25;
    shape.values[i] = scale * product * level;
    for (int a = 0; a < 3; ++a) {
      const double others = f[(a + 1) % 3].value * f[(a + 2) % 3].value;
      shape.derivatives(i, a) = scale * (others * f[a].slope * level + (corner ? product * node[a] : 0));
    }
  }
  return shape;
}

FaceShape face_shape(double xi, double eta) {
  FaceShape shape;
  for (int i = 0; i < 8; ++i) {
    const int* node = kFaceLocal[i];
    const Factor f = factor(xi, node[0]), g = factor(eta, node[1]);
    const bool corner = i < 4;
    const double level = corner ? xi * node[0] + eta * node[1] - 1 : 1;
    const double scale = corner ? 0.25 : 0.5;
    shape.values[i] = scale * f.value * g.value * level;
    shape.derivatives(i, 0) = scale * (f.slope * g.value * level + (corner ? f.value * g.value * node[0] : 0));
    shape.derivatives(i, 1) = scale * (f.value * g.slope * level + (corner ? f.value * g.value * node[1] : 0));
  }
  return shape;
}

namespace {

struct IntegrationPoint {
  BrickShape shape;
  double weight;
};

/// 3 x 3 x 3 of Gauss.
const std::array<IntegrationPoint, 27>& integration_points() {
  static const auto points = [] {
    std::array<IntegrationPoint, 27> all;
    for (std::size_t p = 0; p < 27; ++p) {
      const std::size_t i = p / 9, j = p / 3 % 3, k = p % 3;
      all[p] = {brick_shape({gauss3_abscissae[i], gauss3_abscissae[j], gauss3_abscissae[k]}),
                gauss3_weights[i] * gauss3_weights[j] * gauss3_weights[k]};
    }
    return all;
  }();
  return points;
}

/// At the corners.
const std::array<BrickShape, 8>& corner_shapes() {
  static const auto shapes = [] {
    std::array<BrickShape, 8> all;
    for (std::size_t i = 0; i < 8; ++i) all[i] = brick_shape({1.0 * kBrickLocal[i][0], 1.0 * kBrickLocal[i][1], 1.0 * kBrickLocal[i][2]});
    return all;
  }();
  return shapes;
}

}  // namespace

void check_elastic(const Material& material) {
  if (!(material.youngs_modulus > 0)) {
    throw InvalidInput("material.youngs_modulus", std::to_string(material.youngs_modulus), "more than 0 MPa");
  }
  if (!(material.poissons_ratio >= 0 && material.poissons_ratio < 0.5)) {
    throw InvalidInput("material.poissons_ratio", std::to_string(material.poissons_ratio), "0 <= nu < 0.5");
  }
}

Eigen::Matrix<double, 60, 60> brick_stiffness(const BrickNodes& nodes, const Material& material) {
  // Columns: all derivatives g_ia = dN_i/dx_a at one integration point, times the root of its weight. The last column is 0: wide_product() takes four at once.
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(60, 28);
  int point = 0;
  for (const IntegrationPoint& at : integration_points()) {
    const Eigen::Matrix3d jacobian = nodes * at.shape.derivatives;
    const double weight = at.weight * jacobian.determinant();
    const Eigen::Matrix<double, 3, 20> gradient = (at.shape.derivatives * jacobian.inverse()).transpose();
    gradients.col(point++) = std::sqrt(std::max(0.0, weight)) * Eigen::Map<const Eigen::Matrix<double, 60, 1>>(gradient.data());
  }
  const Eigen::MatrixXd products = wide_product(gradients, gradients.transpose());

  // K_ia,jb = integral of lambda g_ia g_jb + mu g_ib g_ja + mu delta_ab g_i . g_j
  const Lame lame(material);
  Eigen::Matrix<double, 60, 60> stiffness;
  for (int j = 0; j < 20; ++j) {
    for (int i = j; i < 20; ++i) {
      const Eigen::Matrix3d m = products.block<3, 3>(3 * i, 3 * j);
      Eigen::Matrix3d k = lame.lambda * m + lame.mu * m.transpose();
      k.diagonal().array() += lame.mu * m.trace();
      if (i == j) k = (0.5 * (k + k.transpose())).eval();
      stiffness.block<3, 3>(3 * i, 3 * j) = k;
      stiffness.block<3, 3>(3 * j, 3 * i) = k.transpose();
    }
  }
  return stiffness;
}

double brick_quality(const BrickNodes& nodes) {
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
  const auto look = [&](const BrickShape& shape) {
    const Eigen::Matrix3d jacobian = nodes * shape.derivatives;
    smallest = std::min(smallest, jacobian.determinant());
    largest = std::max(largest, jacobian.determinant());
  };
  for (const IntegrationPoint& at : integration_points()) look(at.shape);
  for (const BrickShape& shape : corner_shapes()) look(shape);
  return largest > 0 ? smallest / largest : -1;
}

}  // namespace flankwright
