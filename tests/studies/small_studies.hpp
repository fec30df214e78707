#pragma once

#include <string>

/// Study texts of real pairs, coarse enough to run in a fraction of a second.
namespace flankwright::studies::small {

/// Haddad's helical pair 18:54 with modifications and errors: torques 0 and 1014.868 N·m, scenes "aligned" and "bent".
std::string analysis();

/// The same pair optimised over three scenes, te_peak_to_peak bounded.
std::string optimisation();

/// A helical pair 21:40 by thin slices at four positions; the text ends in [fidelity].
/// @param of_pair, of_pinion  further lines of [pair] and [pinion]
/// @param torque  [N m], a number or a list
std::string helical_pair(const std::string& of_pair = "", const std::string& of_pinion = "", const std::string& torque = "300");

/// The same of left hand, that works on its left flanks, its pinion on a shaft without a coupling: it needs unit().
std::string unit_pair();

/// The unit around it: an input shaft, and a first stage on the pinion's shaft.
std::string unit();

/// The tables [pair], [pinion] and [wheel] of a helical pair 20:40, m_n 4, beta 15 deg, b 20, with a lead crowning of 6 um.
std::string crowned_pair();

/// The tables [pair], [pinion] and [wheel] of a spur pair 25:50, m_n 3, b 20.
std::string spur_pair();

/// A spur pair that meets tilted, by thin slices: points of its lines reach and leave contact one after the other.
std::string tilted_spur_pair();

}  // namespace flankwright::studies::small
