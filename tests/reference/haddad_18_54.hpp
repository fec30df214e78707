#pragma once

#include "core/gear/gear_data.hpp"
#include "tests/core/gear/pair_cases.hpp"

/// The 18:54 helical pair of Haddad's sample outputs and the figures published with it.
///
/// Source: C. D. Haddad, "The elastic analysis of load distribution in wide-faced helical gears", Ph.D. thesis,
/// University of Newcastle upon Tyne, 1991: chapter 2 (radii, path of contact counted in base pitches) and the sample
/// outputs.
namespace flankwright::reference::haddad_18_54 {

inline PairData pair_data() { return pair_cases::pair_data(18, 54, 30, 10.0, 120.0); }

inline constexpr double pinion_tip_radius = 113.923;      // mm
inline constexpr double wheel_tip_radius = 321.769;       // mm
inline constexpr double transverse_base_pitch = 33.4425;  // mm, 1e-4 mm
inline constexpr double tangent_to_tangent = 161.0596;    // mm, T1 T2
inline constexpr double roll_at_path_start = 16.3988;     // mm, rho_1 at A
inline constexpr double path_start = 0.35;                // base pitches from A0
inline constexpr double path_end = 1.70286;               // base pitches from A0
inline constexpr double region_length = 2.05286;          // base pitches, A0 B0
inline constexpr double half_digit_4 = 1e-4;              // mm: printed to four decimals, the last one unsure
inline constexpr double half_digit_3 = 1e-3;              // mm
inline constexpr double half_digit_5 = 1e-5;              // base pitches

}  // namespace flankwright::reference::haddad_18_54
