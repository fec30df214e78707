#pragma once

#include <array>

#include "tests/reference/haddad_1991.hpp"

/// What the sample outputs of the thesis give as answers: transmission error and the loads at the Gauss points, beside
/// haddad_1991.hpp, whose remarks on loads and restored digits hold here as well.
namespace flankwright::reference::haddad_1991 {

inline constexpr double transmission_error_b = 8.77575952;  // um, output null-b

/// An output with errors, at phase_a.
struct OutputWithErrors {
  double transmission_error;     // um, along the flank normal
  std::array<double, 24> loads;  // N per mm of face width, at the points of null_a
};

/// Output 1: helix slope of 8 um, entered as -8.
inline constexpr OutputWithErrors helix_slope_output{
    8.20131182, {{0.000,  0.000,  0.000,  0.000,   75.694, 89.654, 120.716, 112.152, 0.000,  24.548, 39.713, 61.535,
                  73.347, 88.015, 94.294, 116.076, 0.000,  0.000,  13.564,  36.846,  54.056, 0.000,  0.000,  0.000}}};

/// Output 2: c_c = 8 um on one gear.
inline constexpr OutputWithErrors lead_crowning_output{
    10.33958213, {{0.000,   0.000,   0.000,   0.000,  100.695, 75.364, 53.638, 0.000,  0.000,  31.588, 70.940, 109.714,
                   119.602, 119.013, 101.798, 73.290, 0.000,   0.000,  0.000,  52.099, 92.363, 0.000,  0.000,  0.000}}};

/// Output 6: profile crowning of 8 um on both addenda.
inline constexpr OutputWithErrors addendum_crowning_output{
    10.59727324, {{0.000,   0.000,   0.000,  0.000, 0.000, 67.279, 114.478, 104.979, 0.000, 11.586, 70.463, 119.416,
                   130.016, 122.888, 86.952, 0.994, 0.000, 0.000,  103.324, 68.004,  0.000, 0.000,  0.000,  0.000}}};

/// Output 8: cumulative pitch errors of 6, 12, 18 and 24 um on teeth 3 to 6.
inline constexpr OutputWithErrors pitch_error_output{
    -6.98857234, {{0.000,  0.000,  0.000,  0.000,  0.000, 0.000, 0.000,   0.000,   0.000,   57.319, 66.027, 79.152,
                   80.800, 83.056, 80.734, 88.748, 0.000, 0.000, 138.174, 160.402, 165.839, 0.000,  0.000,  0.000}}};

/// Pitch errors of output 8 as they enter, F_p cos(beta_b), of his teeth 3 to 6 [um], metal added positive.
inline constexpr std::array<double, 4> pitch_errors{5.296, 10.592, 15.889, 21.185};

}  // namespace flankwright::reference::haddad_1991
