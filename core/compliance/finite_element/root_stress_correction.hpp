#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/natural_spline.hpp"
#include "core/compliance/finite_element/loaded_section.hpp"
#include "core/compliance/finite_element/root_stress_table.hpp"

namespace flankwright {

/// What a RootStressTable lacks, because its loads enter over the tooth's centre surface instead of on the flank, and because its elements along the
/// fillet are few. Both are solved for in plane strain, on the tooth in its section across the contact line. Let s_f be the stress in the fillet across the
/// tooth under a unit line load on the flank, by fine elements. Let s_c be the same by loads over the centre line, and s_t by these loads and by elements as
/// the table has. Then
///
///     s_f = f s_t + D,   f = sum s_c s_t / sum s_t^2 over all heights of the load.
///
/// The factor f belongs to a place along the fillet, whatever loads it: the table is multiplied by it. D belongs to the place and to the height of a load
/// on its own tooth: it is added. In the section the sum is exact. Along the tooth, a load adds most to the places nearest to it,
///
///     D w/m_n [F(z_2) - F(z_1)],   F(z) = t/(2 sqrt(d^2 + t^2)),   t = z - z_place,
///
/// for each piece z_1 .. z_2 of the line that a contact point stands for, and for its mirror image in either end face. d is the distance of the place from
/// the load in the section. F' is the share of a load that a half space has at the depth d [Poisson's kernel, integrated across z]. An even load adds D w/m_n all along the face.
///
/// Beside spur teeth of 18 and 54 teeth in three dimensions, loaded on the flank, the sum is within 1.5 % of the largest stress (root mean square) for lines
/// over the whole and over half the face and for 0.4 modules in the middle of it, and within 2 % for 0.4 modules at its end. Boussinesq's narrower kernel
/// [(d^2 + t^2)^(-5/2)] has 2.7 and 2.5 % there.
///
/// s_f, s_c and s_t lie across the tooth; with plane strain nu times as much lies along it. In a helical tooth's fillet both are turned against t and a of FilletStress.
/// Departure: there a place is paired with the load of the same z, not with that straight across the tooth (0.2 modules further for each module of height, 30 deg).
class RootStressCorrection {
 public:
  /// A place along the fillet, as FilletGrid::along.
  struct Place {
    double factor{not_given};    ///< f [-]
    NaturalSpline added;         ///< D against the height on the flank, 0 .. 1 [-]
    NaturalSpline distance;      ///< d against that height [m_n]
    Eigen::Vector3d components;  ///< (s_tt, s_aa, s_ta) of a unit stress across the tooth [-]
  };

  /// @param fine, as_table  the gear's section by fine_section() and by the elements of the table's mesh
  /// @param gear, pair      its reference radius, the pair's module and helix angle
  RootStressCorrection(const LoadedSection& fine, const LoadedSection& as_table, const Gear& gear, const GearPair& pair, const FilletGrid& fillet);

  const std::vector<Place>& places() const { return places_; }

  /// What unit forces add on their own tooth, as one component of stress across it: P x n, rows as FilletGrid [m_n^2 MPa/N].
  /// @param forces   on one tooth, u and zeta as in the table
  /// @param lengths  of the contact line that belongs to each [m_n]
  /// @param slant    cos(beta_b): axial length of a unit of contact line
  Eigen::MatrixXd added(const FilletGrid& fillet, const std::vector<FlankStation>& forces, const std::vector<double>& lengths, double slant) const;

  /// The table times the factors.
  RootStressTable scaled(RootStressTable table) const;

 private:
  std::vector<Place> places_;
};

}  // namespace flankwright
