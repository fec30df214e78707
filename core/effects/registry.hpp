#pragma once

#include <string_view>
#include <vector>

#include "core/effects/effect.hpp"

namespace flankwright {

using EffectList = std::vector<const Effect*>;

/// All effects there are, in the order of the flow: an effect exists by its line in registry.cpp, and nowhere else.
const EffectList& registered_effects();

/// By stage, within one by name.
EffectList in_order_of_flow(EffectList effects);

}  // namespace flankwright
