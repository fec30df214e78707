#include "core/contact/unloaded/contact_ellipse.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <string>

namespace flankwright {

namespace {

constexpr double curvature_round_off = 1e-12;  // of kappa_2, see ContactEllipse::semi_major

using Tangents = Eigen::Matrix<double, 3, 2>;

/// Tangents of a flank along its two parameters and its second fundamental form against a given normal [1/mm].
struct LocalShape {
  Tangents tangents;
  Eigen::Matrix2d bending;

  LocalShape(const SurfacePoint& point, const Eigen::Matrix3d& axes, const Eigen::Vector3d& normal) {
    tangents << axes * point.d_rho, axes * point.d_z;
    const double mixed = normal.dot(axes * point.d_rho_z);
    bending << normal.dot(axes * point.d_rho_rho), mixed, mixed, normal.dot(axes * point.d_z_z);
  }

  /// d(s_1, s_2)/d(rho, z) in the tangent plane spanned by orthonormal `plane`.
  Eigen::Matrix2d to_plane(const Tangents& plane) const { return plane.transpose() * tangents; }
  Eigen::Matrix2d curvature_in(const Tangents& plane) const {
    const Eigen::Matrix2d from_plane = to_plane(plane).inverse();
    return from_plane.transpose() * bending * from_plane;
  }
};

/// Roll length of the flank's point that lies at `radius`: rho - D(rho, z) = sqrt(radius^2 - r_b^2). The iteration
/// contracts by dD/drho, a few thousandths.
double roll_of_point(const Flank& flank, double radius, double z, int tooth) {
  const double along = flank.roll_at(radius);
  double rho = along;
  for (int i = 0; i < 6; ++i) rho = along + flank.deviation(rho, z, tooth);
  return rho;
}

}  // namespace

ContactEllipse contact_ellipse(const FlankAssembly& assembly, const ToothContact& contact, double marking_thickness) {
  if (!(marking_thickness > 0.0 && std::isfinite(marking_thickness))) {
    throw InvalidInput("marking_thickness", std::to_string(marking_thickness), "above 0 mm");
  }
  ContactEllipse ellipse;
  if (contact.kind != ContactKind::Line && contact.kind != ContactKind::Surface) return ellipse;

  const double pinion_rotation = contact.phi1 + contact.tooth * 2.0 * units::pi / assembly.pinion_teeth;
  const double wheel_rotation = -contact.phi2 - contact.tooth * 2.0 * units::pi / assembly.wheel_teeth;
  const double wheel_roll = roll_of_point(assembly.wheel, contact.wheel_radius, contact.wheel_z, contact.tooth);
  const SurfacePoint on_pinion =
      surface_point(assembly.pinion, assembly.pinion.roll_at(contact.pinion_radius), contact.pinion_z, contact.tooth, pinion_rotation);
  const SurfacePoint on_wheel = surface_point(assembly.wheel, wheel_roll, contact.wheel_z, contact.tooth, wheel_rotation);

  const Eigen::Vector3d& normal = on_pinion.normal;
  Tangents plane;
  plane.col(0) = on_pinion.d_z.normalized();
  plane.col(1) = normal.cross(plane.col(0));
  const LocalShape pinion(on_pinion, Eigen::Matrix3d::Identity(), normal), wheel(on_wheel, assembly.wheel_axes, normal);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal;
  principal.computeDirect(wheel.curvature_in(plane) - pinion.curvature_in(plane));

  const double least = principal.eigenvalues()[0], greatest = principal.eigenvalues()[1];
  ellipse.least_curvature = least;
  ellipse.greatest_curvature = greatest;
  const bool closed = least > curvature_round_off * greatest;
  ellipse.semi_major = closed ? std::sqrt(2.0 * marking_thickness / least) : std::numeric_limits<double>::infinity();
  ellipse.semi_minor = std::sqrt(2.0 * marking_thickness / greatest);
  const Eigen::Matrix2d axes = pinion.to_plane(plane).inverse() * principal.eigenvectors();  // columns d(rho), d(z)
  const Eigen::Vector2d major = std::copysign(1.0, axes(1, 0)) * axes.col(0);
  const Eigen::Vector2d minor = std::copysign(1.0, axes(0, 1)) * axes.col(1);
  ellipse.major_d_rho = major[0];
  ellipse.major_d_z = major[1];
  ellipse.minor_d_rho = minor[0];
  ellipse.minor_d_z = minor[1];
  return ellipse;
}

}  // namespace flankwright
