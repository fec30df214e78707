#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace flankwright {

/// A piece of beam by its compliance: rates per mm of length.
struct BeamPiece {
  double length{0.0};   ///< [mm], > 0
  double bending{0.0};  ///< 1/(E I) [1/(N mm^2)], >= 0
  double shear{0.0};    ///< 1/(kappa G A) [1/N], >= 0
  double torsion{0.0};  ///< 1/(G I_p) [1/(N mm^2)], >= 0
  double axial{0.0};    ///< 1/(E A) [1/N], >= 0
};

/// A force and a moment on the beam's axis at z, or the motion of the section there that they do work on.
struct BeamLoad {
  double z{0.0};                                    ///< from the beam's first end [mm]
  Eigen::Vector3d force{Eigen::Vector3d::Zero()};   ///< [N]
  Eigen::Vector3d moment{Eigen::Vector3d::Zero()};  ///< about the axis in the section z [N mm]
};

/// A support: the motion that `direction` does work on is held by a spring.
struct BeamSupport {
  BeamLoad direction;
  double compliance{0.0};  ///< of the spring [mm/N or rad/(N mm)], >= 0; 0: rigid
};

/// A straight Timoshenko beam of piecewise constant section, axis along z: bending in both planes, shear, torsion and
/// extension, uncoupled, on any supports that hold it.
///
/// Castigliano's theorem without elements, so nothing is discretised. Let the beam first be clamped at its first end.
/// There, with M a load's moment about the origin and g = e_z x f, the section at t carries f and M - t g as long as the
/// load acts beyond it, and two loads a and b have the flexibility
///
///     C(a, b) = integral 0 .. min(z_a, z_b) of  shear f.f + axial f_z f_z + torsion M_z M_z + bending (M - t g).(M - t g),
///
/// with the first and last product across the axis: six moments of the rates, piecewise polynomials of z. Then the clamp
/// is let go: its rigid motion a and the supports' forces s follow from
///
///     [ C_cc + springs  G ] [ s ]     [ C_cb ]
///     [ G'              0 ] [ a ] = - [ W_b  ],        K(a, b) = C(a, b) + C_ac s + W_a'a,
///
/// with c the supports' directions, W a load's wrench about the origin and G those of the supports. K is symmetric
/// [Maxwell] and positive semi-definite: it is the energy that the loads leave in beam and springs.
class ShaftBeam {
 public:
  /// @pre the supports hold the beam: G has full rank (six) [asserted]
  ShaftBeam(const std::vector<BeamPiece>& pieces, const std::vector<BeamSupport>& supports);

  /// K between combined loads: row i does work with rows[i * parts] .. rows[(i + 1) * parts - 1] together [mm/N where
  /// the loads are unit forces]. Exact but for round-off, of about 1e-15 of the clamped beam's values.
  /// @param parts  loads that act together, >= 1, a divisor of both sizes
  Eigen::MatrixXd flexibility(std::span<const BeamLoad> rows, std::span<const BeamLoad> columns, int parts = 1) const;

  /// The same of loads with themselves, symmetric to the last bit.
  Eigen::MatrixXd flexibility(std::span<const BeamLoad> loads, int parts = 1) const;

 private:
  /// Integrals from 0 to z of the rates; those of bending times 1, t and t^2.
  struct Moments {
    double shear{0.0}, axial{0.0}, torsion{0.0}, bending{0.0}, bending_1{0.0}, bending_2{0.0};
  };
  struct ReducedLoad;
  static ReducedLoad reduce(const BeamLoad& load);
  static double clamped(const ReducedLoad& a, const ReducedLoad& b, const Moments& lower);
  Moments moments_to(double z) const;
  double arm(const BeamSupport& support) const;
  Eigen::MatrixXd coupling(const std::vector<ReducedLoad>& loads, const std::vector<Moments>& moments) const;

  std::vector<double> ends_;    ///< of the pieces [mm]
  std::vector<Moments> until_;  ///< at the pieces' beginnings
  std::vector<BeamPiece> pieces_;
  std::vector<BeamSupport> supports_;
  double length_scale_{1.0}, compliance_scale_{1.0};
  Eigen::FullPivLU<Eigen::MatrixXd> released_;
};

}  // namespace flankwright
