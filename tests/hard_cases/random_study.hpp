#pragma once

#include <cstdint>
#include <string>

namespace flankwright::hard_cases {

/// A study of thin slices, random over the range of valid input: 8 to 500 teeth, modules 0.001 to 1000 mm, helix 0 to 45 deg, faces of 0.5
/// to 60 modules, profile shifts, modifications, errors and misalignments of nothing to far too much, Poisson's ratio 0 to 0.499, torques
/// over twelve decades around 300 N per mm of face, either gap, any quadrature. Some cannot be built, and are refused as a user's would.
/// The same text for the same numbers, on every machine.
std::string random_study(std::uint64_t seed, std::uint64_t index);

}  // namespace flankwright::hard_cases
