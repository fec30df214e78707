#pragma once

#include "studies/gear_structures.hpp"
#include "studies/json_format.hpp"

namespace flankwright::studies {

/// The section `compliance` of results.json: what the finite elements of both gears are and took.
Json compliance_json(const GearStructures& structures, const Study& study);

/// The motion of the shaft that is taken out of influence values, in words.
const char* name_of(RemovedMotion removed);

/// A gear's body as used, of `used` in results.json.
Json body_json(const GearBody& body);

}  // namespace flankwright::studies
