#pragma once

#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// A length of shaft of constant section, a hollow or solid cylinder.
struct ShaftSection {
  double length{not_given};          ///< [mm], > 0
  double outer_diameter{not_given};  ///< [mm], > 0
  double inner_diameter{0.0};        ///< [mm], 0 .. below outer_diameter
};

/// The stiffness of a bearing at one position of the axis. Infinite is rigid.
struct ShaftBearing {
  double position{not_given};                                        ///< from the shaft's first end [mm]
  double radial_stiffness{std::numeric_limits<double>::infinity()};  ///< in every direction across the axis [N/mm], > 0
  double axial_stiffness{0.0};                                       ///< [N/mm], >= 0; 0: slides
  double tilting_stiffness{0.0};                                     ///< [N mm/rad], >= 0; 0: swivels
};

/// The shaft that carries one gear. Positions run along the pair's z from the shaft's first end, the one of lowest z.
struct ShaftData {
  std::vector<ShaftSection> sections{};  ///< from the first end on
  std::vector<ShaftBearing> bearings{};
  double gear_position{not_given};    ///< of the gear's mid face [mm]
  double torque_position{not_given};  ///< where the torque enters or leaves, outside the gear's face [mm]
  /// The gear is one with its shaft: over its face the section is that of the gear, see gear_seat(); false: it is the
  /// shaft's own.
  bool gear_stiffens{true};
  Material material{};

  double length() const;
  /// -1 where the torque enters at the side of lower z than the gear, +1 at the other.
  int torque_side() const { return torque_position < gear_position ? -1 : 1; }
};

/// Everything in the data that cannot be: no section, a gear that is not all on the shaft, a torque that enters within its
/// face, supports that leave the shaft loose ... Fields are members' names ("sections.0.length", "bearings").
/// @param face_width  of the gear [mm]
std::vector<InvalidInput> find_problems(const ShaftData& shaft, double face_width);

}  // namespace flankwright
