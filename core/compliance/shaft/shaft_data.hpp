#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/compliance/shaft/bearing_law.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// A length of shaft of constant section, a hollow or solid cylinder.
struct ShaftSection {
  double length{not_given};          ///< [mm], > 0
  double outer_diameter{not_given};  ///< [mm], > 0
  double inner_diameter{0.0};        ///< [mm], 0 .. below outer_diameter
};

/// The stiffness of a bearing at one position of the axis. Infinite is rigid. Its radial stiffness is constant or, with a law, that of its load.
struct ShaftBearing {
  double position{not_given};                                        ///< from the shaft's first end [mm]
  double radial_stiffness{std::numeric_limits<double>::infinity()};  ///< in every direction across the axis [N/mm], > 0
  double axial_stiffness{0.0};                                       ///< [N/mm], >= 0; 0: slides
  double tilting_stiffness{0.0};                                     ///< [N mm/rad], >= 0; 0: swivels
  double radial_clearance{0.0};  ///< of the diameters: how far the shaft can be moved across, all the way [mm], >= 0
  std::string name{};            ///< for results; empty: its shaft and number
  BearingLawData law{};          ///< beside it radial_stiffness is infinite
  /// Forces x, y, z and moments about x and y on the shaft per its displacements x, y, z and turns about x and y in the bearing, 5 x 5
  /// [N, mm, rad], symmetric, a row and column of zeros where it does not hold, positive definite without these; instead of all other
  /// stiffnesses. Empty: none.
  Eigen::MatrixXd stiffness_matrix{};

  /// Its force is not in proportion to the shaft's displacement in it.
  bool depends_on_load() const { return radial_clearance > 0.0 || law.given(); }
  bool has_matrix() const { return stiffness_matrix.size() > 0; }
  /// Which of the motions x, y, z, turns about x and y it holds.
  std::array<bool, 5> holds() const;
};

/// What cannot be in how a bearing yields: its law and a radial_stiffness beside it, its matrix and any other stiffness beside that.
std::vector<InvalidInput> find_yielding_problems(const ShaftBearing& bearing);

/// A shaft, one that carries a gear of the pair or another one of its gear unit. Positions run along the pair's z from the
/// shaft's first end, the one of lowest z.
struct ShaftData {
  std::vector<ShaftSection> sections{};  ///< from the first end on
  std::vector<ShaftBearing> bearings{};
  double gear_position{not_given};  ///< of the mid face of the pair's gear [mm]; of a shaft that carries none of them not given
  /// Where a coupling is, and the torque enters or leaves that gears and other loads leave over, outside the gear's face [mm]; not given: there is
  /// no coupling, which only a shaft of a gear unit can do without.
  double torque_position{not_given};
  /// The gear is one with its shaft: over its face the section is that of the gear, see GearSeat; false: it is the
  /// shaft's own.
  bool gear_stiffens{true};
  Material material{};
  std::string name{};  ///< of a unit's further shaft
  /// Where a shaft of a unit is held against turning, see settle_turning_holds() [mm]; not given: at its coupling.
  double held_position{not_given};

  double length() const;
  /// -1 where the torque enters at the side of lower z than the gear, +1 at the other.
  int torque_side() const { return (std::isnan(held_position) ? torque_position : held_position) < gear_position ? -1 : 1; }
};

/// Everything in the data that cannot be: no section, a gear that is not all on the shaft, a torque that enters within its
/// face, supports that leave the shaft loose ... Fields are members' names ("sections.0.length", "bearings").
/// @param face_width  of the gear [mm]
std::vector<InvalidInput> find_problems(const ShaftData& shaft, double face_width);

/// The same of one shaft of several in a unit: whether these are held, and where their torques go, is asked of all together.
/// @param face_width  of the pair's gear [mm]; 0: the shaft carries none
std::vector<InvalidInput> find_problems_in_unit(const ShaftData& shaft, double face_width);

}  // namespace flankwright
