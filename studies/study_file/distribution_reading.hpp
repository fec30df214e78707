#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "core/gear/gear_pair.hpp"
#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/drawn_pitch.hpp"
#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// A distribution as a study writes it, and in words for the results.
struct NamedDistribution {
  Distribution distribution;              ///< of the value in the unit of a bare number
  std::string in_words;                   ///< "normal, mean 0, deviation 6"
  std::optional<PitchTolerance> pitch{};  ///< of a class for the pitch: values are numbers of draws of a gear, see drawn_pitch()
};

/// What a table of distributions may hold.
inline constexpr const char* distributions_in_words =
    "a table of keys below misalignment, load, modification or error, each with { normal = [mean, deviation] }, "
    "{ truncated_normal = [mean, deviation, low, high] }, { uniform = [low, high] }, { grid = [low, high, levels] }, "
    "{ values = [...] } or { iso_1328_class = 1 .. 11 }";

/// Reads { normal = [mean, deviation] }, { truncated_normal = [mean, deviation, low, high] }, { uniform = [low, high] },
/// { grid = [low, high, levels] }, { values = [...] } or { iso_1328_class = 6 }, numbers bare or with their units. The class is for
/// helix_slope and profile_slope of an error, Distribution::within_tolerance() of that gear's tolerance (flank_tolerances.hpp), and for
/// the pitch, which is drawn tooth by tooth.
///
/// @param key   that scatters
/// @param pair  whose tolerances a class means; none: the pair cannot be built, a class is taken for granted and gives no distribution
/// @throws InvalidInput with an empty field and value; its allowed() is what would have been accepted
std::optional<NamedDistribution> read_distribution(const SchemaKey& key, const toml::node& node, const GearPair* pair);

}  // namespace flankwright::studies
