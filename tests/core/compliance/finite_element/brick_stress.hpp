#pragma once

#include <Eigen/LU>

#include "core/compliance/finite_element/brick.hpp"

namespace flankwright::test {

/// Stress tensor [MPa] at a local position of a brick by Hooke's law, from the displacements of its nodes [mm], 3 x 20.
inline Eigen::Matrix3d brick_stress(const BrickNodes& nodes, const BrickNodes& displacements, const Eigen::Vector3d& local,
                                    const Material& material) {
  const BrickShape shape = brick_shape(local);
  const Eigen::Matrix3d jacobian = nodes * shape.derivatives;
  const Eigen::Matrix3d gradient = displacements * shape.derivatives * jacobian.inverse();
  const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
  const double nu = material.poissons_ratio, two_mu = material.youngs_modulus / (1 + nu);
  return two_mu * (strain + nu / (1 - 2 * nu) * strain.trace() * Eigen::Matrix3d::Identity());
}

}  // namespace flankwright::test
