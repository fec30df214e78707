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

  bool operator==(const FlankCondition&) const = default;
};

}  // namespace flankwright
