#pragma once

#include "core/contact/assembly/misalignment.hpp"
#include "core/flank/removal.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// The part of a working condition that shapes the gap between the flanks.
struct FlankCondition {
  PerGear<Modification> modification{};
  PerGear<ManufacturingError> error{};
  Misalignment misalignment{};
  /// Whether the flanks behind those of PairData::working_flank touch, as on the coast side of a pair that is given for its drive side. Modification and
  /// error are of the flanks that touch.
  bool other_flanks{false};

  /// Gives both gears the modifications of a design, which is that of the pair's own flanks: the others as on_opposite_flank() has them.
  void set_design(const PerGear<Modification>& design) {
    modification = other_flanks ? PerGear<Modification>{on_opposite_flank(design.pinion), on_opposite_flank(design.wheel)} : design;
  }

  bool operator==(const FlankCondition&) const = default;
};

}  // namespace flankwright
