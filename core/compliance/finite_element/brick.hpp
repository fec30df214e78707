#pragma once

#include <Eigen/Core>

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Coordinates of the nodes of a 20-node brick [mm], 3 x 20. Order of CalculiX' C3D20: corners of the lower face
/// counter-clockwise seen from the upper one, corners of the upper face, mid-sides of the lower face (between its
/// corners 1-2, 2-3, 3-4, 4-1), of the upper face, of the vertical edges.
using BrickNodes = Eigen::Matrix<double, 3, 20>;

/// Nodes of an 8-node face [mm], 3 x 8: four corners, then the mid-sides 1-2, 2-3, 3-4, 4-1.
using FaceNodes = Eigen::Matrix<double, 3, 8>;

/// Serendipity functions of the 20-node brick at local coordinates in [-1, 1]^3 and their local derivatives.
struct BrickShape {
  Eigen::Matrix<double, 20, 1> values;
  Eigen::Matrix<double, 20, 3> derivatives;
};
BrickShape brick_shape(const Eigen::Vector3d& local);

/// Serendipity functions of the 8-node face at local coordinates in [-1, 1]^2 and their local derivatives.
struct FaceShape {
  Eigen::Matrix<double, 8, 1> values;
  Eigen::Matrix<double, 8, 2> derivatives;
};
FaceShape face_shape(double xi, double eta);

/// @throws InvalidInput  "material.youngs_modulus" not above 0, or "material.poissons_ratio" not 0 <= nu < 0.5
void check_elastic(const Material& material);

/// Stiffness of a curved isoparametric brick, 60 x 60 [N/mm], unknowns node by node (x, y, z), full 3 x 3 x 3 Gauss
/// integration: exact for a parallelepiped, and without spurious zero-energy modes. Exactly symmetric.
///
/// @param material  youngs_modulus > 0 and 0 <= poissons_ratio < 0.5; near 0.5 the element locks
Eigen::Matrix<double, 60, 60> brick_stiffness(const BrickNodes& nodes, const Material& material);

/// Smallest over largest Jacobian determinant of the brick's map, over its corners and integration points: 1 for a
/// parallelepiped, not positive where the element is folded or turned inside out.
double brick_quality(const BrickNodes& nodes);

/// Abscissae of the two-point Gauss rule on [-1, 1]; the weights are 1.
inline constexpr double gauss2_abscissae[2] = {-0.577350269189625765, 0.577350269189625765};

/// Abscissae and weights of the three-point Gauss rule on [-1, 1].
inline constexpr double gauss3_abscissae[3] = {-0.774596669241483377, 0.0, 0.774596669241483377};
inline constexpr double gauss3_weights[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

}  // namespace flankwright
