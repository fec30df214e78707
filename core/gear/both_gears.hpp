#pragma once

#include <array>

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// For what is done with either gear in turn.
inline constexpr std::array both_gears{Member::Pinion, Member::Wheel};

}  // namespace flankwright
