#pragma once

#include <vector>

#include "optimize/design/design_optimiser.hpp"
#include "studies/base/json_format.hpp"
#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Keys of [optimise.grinding]: what a machine can grind.
std::vector<SchemaKey> grinding_limit_keys();

/// Makes named constraints on modifications of them, which the search keeps like any other:
///
///     |amount| <= largest_amount               of every amount that is varied or tied to a variable
///     amount - steepest_relief extent <= 0     of every relief of which amount, height or length is varied or tied
///
/// After the variables and ties.
void read_grinding_limits(StudyReading& reading);

/// optimise.grinding_limits of results.json: every limit with its name, value, limit and whether the design meets it, is at it ("active") or exceeds it.
Json grinding_limits_json(const DesignTask& task, const DesignReport& report);

/// A limit counts as active where the design is this near to it, as a share of the range that the variables give it [-].
inline constexpr double near_limit = 1e-4;

}  // namespace flankwright::studies
