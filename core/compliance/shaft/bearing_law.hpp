#pragma once

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Rolling bearings whose deflection the usual formulas give.
enum class BearingType { NotGiven, DeepGrooveBall, AngularContactBall, CylindricalRoller, TaperedRoller };

/// "deep_groove_ball", "angular_contact_ball", "cylindrical_roller", "tapered_roller"; empty for NotGiven.
std::string name_of(BearingType type);

/// What makes a bearing's radial stiffness depend on its load: a table, or its type and rolling elements. Neither: it is constant.
struct BearingLawData {
  std::vector<double> table_force;       ///< radial force on the bearing, from point to point [N], >= 0
  std::vector<double> table_deflection;  ///< of the shaft in the bearing, beyond its clearance [mm], >= 0, as many
  BearingType type{BearingType::NotGiven};
  int elements{0};                     ///< Z, balls or rollers of all rows, >= 3
  double element_diameter{not_given};  ///< D, of balls [mm], > 0
  double element_length{not_given};    ///< l, of rollers, effective [mm], > 0
  double contact_angle{not_given};     ///< alpha [rad], 0 .. 60 deg; not given: 0 of those types whose angle is 0

  bool given() const { return has_table() || type != BearingType::NotGiven; }
  bool has_table() const { return !table_force.empty() || !table_deflection.empty(); }
};

/// Everything in the data that cannot be. Fields are the keys of a bearing: "force_table", "elements".
std::vector<InvalidInput> find_problems(const BearingLawData& data);

/// Radial force F over radial deflection delta of a bearing, both >= 0 and strictly increasing with each other, the same in every direction.
///
/// A table is linear between its points, from the origin on, and goes on along its last piece. By type [Palmgren, Ball and Roller Bearing Engineering,
/// 3rd ed., 1959; Harris & Kotzalas, Essential Concepts of Bearing Technology, 5th ed., 2006, ch. 7 and 8], in N and mm and of steel,
///
///     ball, point contact       delta = 4.36e-4 Q^(2/3) / (D^(1/3) cos alpha)
///     roller, line contact      delta = 7.68e-5 Q^0.9 / (l^0.8 cos alpha)
///     Q = 5 F / (Z cos alpha)
///
/// with Q the load of the rolling element that carries most. The factor 5 is that of a bearing with its usual clearance. Without any clearance Stribeck's
/// 4.37 (balls) and 4.08 (rollers) hold [Harris & Kotzalas, ch. 7], with which deflections are 9 and 17 % less. Rings count as rigid but for the contacts, and
/// the axial force has no influence.
class RadialLaw {
 public:
  /// @throws InvalidInput  the first of find_problems()
  explicit RadialLaw(const BearingLawData& data);

  /// @param force  F [N], >= 0
  double deflection(double force) const;  ///< delta [mm]
  /// d delta/dF [mm/N], where the table bends that of the piece beyond; infinite at 0 by type
  double compliance(double force) const;
  /// @param deflection  delta [mm], >= 0
  double force(double deflection) const;      ///< F [N]
  double stiffness(double deflection) const;  ///< dF/d delta [N/mm]

  /// The table ends below this force.
  bool is_beyond_table(double force) const { return !forces_.empty() && force > forces_.back(); }

 private:
  /// Index of the point where the piece of a table begins that holds a value.
  static std::size_t piece_of(const std::vector<double>& values, double value);

  std::vector<double> forces_, deflections_;        ///< of a table, the origin first
  double factor_{not_given}, exponent_{not_given};  ///< by type: delta = factor F^exponent
};

}  // namespace flankwright
