#pragma once

#include <optional>

#include "core/compliance/shaft/shaft_data.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

Json bearing_json(const ShaftBearing& bearing);

/// A gear's shaft as used; false where it has none.
Json shaft_json(const std::optional<ShaftData>& shaft);

}  // namespace flankwright::studies
