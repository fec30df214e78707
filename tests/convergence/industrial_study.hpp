#pragma once

#include <cstdint>
#include <string>

namespace flankwright::convergence {

/// A study of one load case of a pair as industry has them, drawn at random: modules 1 to 12 mm, 12 to 120 teeth, a helix of 0 to 35 deg, faces of 6
/// to 14 modules, racks 1.0/1.25 to 1.4/1.6, crowning and tip relief of usual size, up to 20 um of misalignment, a nominal contact stress of 300 to
/// 1,500 MPa. All that it leaves out is the program's default. The same text for the same numbers, on every machine.
std::string industrial_study(std::uint64_t seed, std::uint64_t index);

}  // namespace flankwright::convergence
