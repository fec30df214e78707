#pragma once

#include <string>

/// Study texts of real pairs, coarse enough to run in a fraction of a second.
namespace flankwright::studies::small {

/// Haddad's helical pair 18:54 with modifications and errors: torques 0 and 1014.868 N·m, scenes "aligned" and "bent".
std::string analysis();

/// The same pair optimised over three scenes, te_peak_to_peak bounded.
std::string optimisation();

}  // namespace flankwright::studies::small
