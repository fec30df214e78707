#pragma once

#include <array>
#include <cstddef>

namespace flankwright {

/// What finishes a flank. Which points it finishes together decides where a lead modification ends up, see ContactShift.
enum class GrindingKind {
  None,                ///< nothing is said: every point has the lead modification that was asked for at its own z
  Topological,         ///< every point is ground as asked for, point by point or by a machine that is told the twist
  GeneratingGrinding,  ///< a threaded wheel rolls with the gear and is fed along its axis
  FormGrinding         ///< a wheel of revolution with the profile of the tooth space is fed along the helix
};

/// Names in study files and results, in the order of GrindingKind.
inline constexpr std::array grinding_kind_names{"none", "topological", "generating_grinding", "form_grinding"};
constexpr const char* to_string(GrindingKind kind) { return grinding_kind_names[static_cast<std::size_t>(kind)]; }

/// The process that finishes the flanks of one gear, as far as it changes them.
struct GrindingProcess {
  GrindingKind kind{GrindingKind::None};
  /// Part of the natural twist that the machine takes out, by diagonal feed or a modified worm [-], 0 .. 1.
  double twist_compensation{0.0};
  /// Diameter of the wheel of FormGrinding [mm], > 0. The default is that of a new wheel on a machine for gears of middle size.
  double wheel_diameter{300.0};

  /// Whether the process has a natural twist, which twist_compensation may take out.
  constexpr bool has_natural_twist() const { return kind == GrindingKind::GeneratingGrinding || kind == GrindingKind::FormGrinding; }
  /// Whether it moves the lead modification of a helical gear.
  constexpr bool twists() const { return has_natural_twist() && twist_compensation != 1.0; }
  /// The same without compensation.
  constexpr GrindingProcess uncompensated() const { return {kind, 0.0, wheel_diameter}; }
  bool operator==(const GrindingProcess&) const = default;
};

}  // namespace flankwright
