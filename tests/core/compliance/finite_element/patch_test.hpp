#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <algorithm>
#include <set>
#include <vector>

#include "core/compliance/finite_element/solid_model.hpp"
#include "tests/core/compliance/finite_element/block_mesh.hpp"

namespace flankwright::test {

/// Patch test: a solid under surface forces that balance an even stress has that stress's even strain everywhere, whatever its elements, as long as they fit.
/// @param reach  the solid is held against rigid motion alone, at free nodes near (-reach, 0, 0), (reach, 0, 0) and (0, reach, 0) [mm]
/// @return       largest error of the strain, relative to it [-]
inline double even_strain_error(const SolidMesh& mesh, double reach) {
  const Eigen::Matrix3d stress{{100, 20, -30}, {20, -50, 10}, {-30, 10, 70}};
  const Material steel{206000, 0.3};
  // Loads that keep the even stress in balance, on all surfaces: of every brick the integral of stress times gradient.
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(mesh.nodes.size(), 1);
  integrate(mesh, [&](Eigen::Index brick, const BrickShape&, const Eigen::Vector3d&, const auto& gradient, double weight) {
    const Eigen::Matrix<double, 3, 20> forces = weight * stress * gradient.transpose();
    for (int k = 0; k < 20; ++k) load.middleRows<3>(3 * mesh.bricks(k, brick)) += forces.col(k);
  });
  std::set<int> tied;
  for (const TiedNode& tie : mesh.tied) tied.insert(tie.node);
  const auto nearest = [&](const Eigen::Vector3d& wanted) {
    int best = -1;
    for (int i = 0; i < mesh.nodes.cols(); ++i) {
      if (!tied.contains(i) && (best < 0 || (mesh.nodes.col(i) - wanted).norm() < (mesh.nodes.col(best) - wanted).norm())) best = i;
    }
    return best;
  };
  const std::vector<NodeSupport> supports{
      {nearest({-reach, 0, 0})}, {nearest({reach, 0, 0}), {false, true, true}}, {nearest({0, reach, 0}), {false, false, true}}};
  const Eigen::SparseMatrix<double> column = load.sparseView();
  const Eigen::VectorXd u = SolidModel(mesh, steel, supports).solve(column);

  const double E = steel.youngs_modulus, nu = steel.poissons_ratio;
  const Eigen::Matrix3d strain = ((1 + nu) * stress - nu * stress.trace() * Eigen::Matrix3d::Identity()) / E;
  double worst = 0;
  integrate(mesh, [&](Eigen::Index brick, const BrickShape&, const Eigen::Vector3d&, const auto& gradient, double) {
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 20; ++k) slope += u.segment<3>(3 * mesh.bricks(k, brick)) * gradient.row(k);
    worst = std::max(worst, (0.5 * (slope + slope.transpose()) - strain).norm());
  });
  return worst / strain.norm();
}

}  // namespace flankwright::test
