#pragma once

#include <string>
#include <string_view>

#include "studies/study/study.hpp"

namespace flankwright::studies {

/// The unit that a value of a study file has by its key alone: "mm" of pair.normal_module = 3, of scenes.0.load.torque, of the bounds
/// of an optimisation's variable or a sweep's distribution that of their key. Empty where the value is a text, which carries its own,
/// and where the key has none.
std::string_view unit_of_given(const GivenValue& given);

}  // namespace flankwright::studies
