#pragma once

#include <Eigen/Dense>
#include <optional>
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

/// A force and a moment on a beam's axis at z, or the motion of the section there that they do work on.
struct BeamLoad {
  double z{0.0};                                    ///< from the beam's first end [mm]
  Eigen::Vector3d force{Eigen::Vector3d::Zero()};   ///< [N]
  Eigen::Vector3d moment{Eigen::Vector3d::Zero()};  ///< about the axis in the section z [N mm]
  int beam{0};                                      ///< which of the beams, from 0

  /// The same load times a factor.
  BeamLoad times(double factor) const { return {z, factor * force, factor * moment, beam}; }
};

/// A support: a spring holds the motion that `direction` does work on, against the ground or against a section of another beam.
struct BeamSupport {
  BeamLoad direction;
  double compliance{0.0};             ///< of the spring [mm/N or rad/(N mm)], >= 0; 0: rigid
  std::optional<BeamLoad> against{};  ///< the other beam's section, with the same force or moment as `direction`; none: the ground
};

/// A motion of the beams as rigid bodies that no support holds.
struct LooseMotion {
  int beam{0};                        ///< the one that moves most
  Eigen::Vector3d translation, turn;  ///< of its first end; a turn counts by the beams' length, the largest part of both is 1 [-]
};

/// Straight Timoshenko beams of piecewise constant section, axes along z: bending in both planes, shear, torsion and
/// extension, uncoupled, on any supports that hold them, between each other as well.
///
/// Castigliano's theorem without elements, so nothing is discretised. Let each beam first be clamped at its first end.
/// There, with M a load's moment about the origin and g = e_z x f, the section at t carries f and M - t g as long as the
/// load acts beyond it, and two loads a and b of one beam have the flexibility
///
///     C(a, b) = integral 0 .. min(z_a, z_b) of  shear f.f + axial f_z f_z + torsion M_z M_z + bending (M - t g).(M - t g),
///
/// with the first and last product across the axis: six moments of the rates, piecewise polynomials of z. Then the clamps
/// are let go: the rigid motions a and the supports' forces s follow from
///
///     [ C_cc + S  G ] [ s ]   [ v ]   [ C_cb ]
///     [ G'        0 ] [ a ] = [ 0 ] - [ W_b  ],        K(a, b) = C(a, b) + C_ac s + W_a'a,
///
/// with c the supports' directions (of one against another beam: of both, with opposite signs), S the compliance of the supports, a
/// symmetric matrix, W a load's wrench about the origin, G those of the supports, and v a displacement that is forced on
/// the supports, 0 in K. K is symmetric [Maxwell] and positive semi-definite: it is the energy that the loads leave in
/// beams and supports.
class BeamSystem {
 public:
  /// @param further  compliance of the supports beyond their own, symmetric, positive semi-definite, as of a housing; empty: none
  /// @pre the supports hold the beams: find_loose_motion() finds none [asserted]
  BeamSystem(std::vector<std::vector<BeamPiece>> beams, std::vector<BeamSupport> supports, const Eigen::MatrixXd& further = {});
  /// One beam.
  BeamSystem(const std::vector<BeamPiece>& beam, std::vector<BeamSupport> supports)
      : BeamSystem(std::vector<std::vector<BeamPiece>>{beam}, std::move(supports)) {}

  /// K between combined loads: row i does work with rows[i * row_parts] .. rows[(i + 1) * row_parts - 1] together [mm/N where
  /// the loads are unit forces]. Exact but for round-off, of about 1e-15 of the clamped beams' values.
  /// @param row_parts, column_parts  loads that act together, >= 1, divisors of the sizes
  Eigen::MatrixXd flexibility(std::span<const BeamLoad> rows, std::span<const BeamLoad> columns, int row_parts, int column_parts) const;
  Eigen::MatrixXd flexibility(std::span<const BeamLoad> rows, std::span<const BeamLoad> columns, int parts = 1) const {
    return flexibility(rows, columns, parts, parts);
  }
  /// The same of loads with themselves, symmetric to the last bit.
  Eigen::MatrixXd flexibility(std::span<const BeamLoad> loads, int parts = 1) const;

  /// Forces s of the supports on the beams along their directions, a column per combined load [N or N mm per unit load]. A
  /// displacement v forced on the supports moves the sections that a unit load does work on by -s'v.
  Eigen::MatrixXd reactions(std::span<const BeamLoad> loads, int parts = 1) const;

  /// Forces of the supports per displacement that is forced on them, s = N v: symmetric, positive semi-definite.
  Eigen::MatrixXd prestrain_stiffness() const;

  const std::vector<BeamSupport>& supports() const { return supports_; }
  /// Where the last piece of a beam ends [mm].
  double length(int beam) const { return beams_[static_cast<std::size_t>(beam)].ends.back(); }

 private:
  /// Integrals from 0 to z of the rates; those of bending times 1, t and t^2.
  struct Moments {
    double shear{0.0}, axial{0.0}, torsion{0.0}, bending{0.0}, bending_1{0.0}, bending_2{0.0};
  };
  struct Beam {
    std::vector<BeamPiece> pieces;
    std::vector<double> ends;    ///< of the pieces [mm]
    std::vector<Moments> until;  ///< at the pieces' beginnings
    Moments to(double z) const;
  };
  /// f, M_z, and across the axis M and g: what C(a, b) is bilinear in, with M the moment about the origin and g = e_z x f.
  using Wrench = Eigen::Matrix<double, 8, 1>;
  /// `strained` is the wrench times the integrals up to the load, so that C(a, b) = a.strained . b.wrench where z_a <= z_b.
  struct ReducedLoad {
    double z;
    int beam;
    Wrench wrench, strained;

    auto force() const { return wrench.head<3>(); }
    Eigen::Vector3d moment() const { return {wrench[4], wrench[5], wrench[3]}; }
  };
  static Wrench strained(const Wrench& wrench, const Moments& lower);
  ReducedLoad reduce(const BeamLoad& load) const;
  std::vector<ReducedLoad> reduce(std::span<const BeamLoad> loads) const;
  static double clamped(const ReducedLoad& a, const ReducedLoad& b) { return a.z < b.z ? a.strained.dot(b.wrench) : b.strained.dot(a.wrench); }
  /// Which parts of combined loads act at the same section of all of them.
  static std::vector<bool> at_one_section(const std::vector<ReducedLoad>& loads, int parts);
  /// The strained wrenches at one section, of combined loads by those of their parts that count, a column each: C(a, section) = column . wrench there.
  Eigen::MatrixXd clamped_at(const ReducedLoad& section, const std::vector<ReducedLoad>& loads, int parts, const std::vector<bool>& counts) const;
  static Eigen::MatrixXd wrenches_of(const std::vector<ReducedLoad>& loads, std::size_t part, int parts);
  /// Adds C between combined loads. Parts that act at one section of all loads are products of matrices.
  void add_clamped(const std::vector<ReducedLoad>& rows, const std::vector<ReducedLoad>& columns, int row_parts, int column_parts,
                   Eigen::MatrixXd& result) const;
  double arm(const BeamSupport& support) const;
  Eigen::MatrixXd coupling(const std::vector<ReducedLoad>& loads) const;
  Eigen::MatrixXd combined_coupling(std::span<const BeamLoad> loads, int parts) const;

  std::vector<Beam> beams_;
  std::vector<BeamSupport> supports_;
  std::vector<std::vector<ReducedLoad>> directions_;  ///< of each support: its own, and with the opposite sign that of the other beam
  double length_scale_{1.0}, compliance_scale_{1.0};
  Eigen::FullPivLU<Eigen::MatrixXd> released_;
};

/// A motion that leaves all supports unstrained; nothing where they hold the beams.
/// @param lengths  of the beams [mm]
std::optional<LooseMotion> find_loose_motion(const std::vector<double>& lengths, const std::vector<BeamSupport>& supports);

}  // namespace flankwright
