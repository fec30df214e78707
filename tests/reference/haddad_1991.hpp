#pragma once

#include <array>

/// Loaded contact of the 18:54 pair of haddad_18_54.hpp as printed in the sample outputs of
///
///     C. D. Haddad, The elastic analysis of load distribution in wide-faced helical gears, Ph.D. thesis, University of
///     Newcastle upon Tyne, 1991, appendix 4A,
///
/// at its quadrature points (five intervals of 24 mm, two Gauss points each). E = 209 000 MPa and nu = 0.3 are not
/// printed but follow from the stresses. Loads are N per mm of *face width* (they balance 12 000 N over 12 mm a point),
/// but the thesis puts them into Hertz's formulas as if they were N per mm of contact line: stress and contact
/// deflection below are those of the printed figure. Digits that the scan has lost were restored from the relations
/// between the columns.
namespace flankwright::reference::haddad_1991 {

inline constexpr double youngs_modulus = 209000.0;  // MPa
inline constexpr double poissons_ratio = 0.3;
inline constexpr double torque = 1014.86791992e3;           // N mm, on the pinion
inline constexpr double normal_force = 12000.0;             // N
inline constexpr double transmission_error_a = 8.33224863;  // um, along the flank normal
inline constexpr int reference_tooth = 4;                   // his number of the tooth whose phase is given
inline constexpr double phase_a = 1.0998;                   // base pitches, of outputs null-a, 1, 2 and 6
inline constexpr double phase_b = 0.4079;                   // of output null-b
inline constexpr double phase_digit = 1e-5;                 // last digit printed
inline constexpr double last_digit = 1e-3;                  // of errors and deflections [um] and of loads and stresses

/// A row of an output; z from one end of the face. Errors are delta_e of eq. 6.1, metal added positive.
struct Point {
  int tooth;
  double z;                   // mm, 0 .. 120
  double phase;               // base pitches from A0
  double contact_deflection;  // um
  double load;                // N per mm of face width
  double stress;              // MPa
};

/// Outputs without errors.
inline constexpr std::array<Point, 24> null_a{{
    {3, 101.072, -0.20145, 0.000, 0.000, 0.000},   {3, 114.928, 0.01908, 0.000, 0.000, 0.000},    {4, 53.072, 0.03460, 0.000, 0.000, 0.000},
    {4, 66.928, 0.25514, 0.000, 0.000, 0.000},     {4, 77.072, 0.41658, 1.721, 68.381, 365.999},  {4, 90.928, 0.63711, 1.674, 66.599, 313.946},
    {4, 101.072, 0.79855, 1.943, 79.067, 317.693}, {4, 114.928, 1.01908, 1.559, 62.202, 261.106}, {5, 5.072, 0.27066, 0.000, 0.000, 0.000},
    {5, 18.928, 0.49119, 1.535, 60.254, 325.493},  {5, 29.072, 0.65263, 1.671, 66.500, 311.225},  {5, 42.928, 0.87316, 1.912, 77.793, 306.327},
    {5, 53.072, 1.03460, 1.914, 78.408, 291.830},  {5, 66.928, 1.25514, 1.904, 79.000, 277.318},  {5, 77.072, 1.41658, 1.789, 74.828, 261.772},
    {5, 90.928, 1.63711, 1.813, 79.025, 260.749},  {5, 101.072, 1.79855, 0.000, 0.000, 0.000},    {5, 114.928, 2.01908, 0.000, 0.000, 0.000},
    {6, 5.072, 1.27066, 1.507, 60.759, 242.411},   {6, 18.928, 1.49119, 1.711, 71.876, 253.541},  {6, 29.072, 1.65263, 1.735, 75.466, 254.355},
    {6, 42.928, 1.87316, 0.000, 0.000, 0.000},     {6, 53.072, 2.03460, 0.000, 0.000, 0.000},     {6, 66.928, 2.25514, 0.000, 0.000, 0.000},
}};
inline constexpr std::array<Point, 26> null_b{{
    {4, 77.072, -0.27532, 0.000, 0.000, 0.000},   {4, 90.928, -0.05479, 0.000, 0.000, 0.000},    {4, 101.072, 0.10665, 0.000, 0.000, 0.000},
    {4, 114.928, 0.32718, 0.000, 0.000, 0.000},   {5, 29.072, -0.03927, 0.000, 0.000, 0.000},    {5, 42.928, 0.18126, 0.000, 0.000, 0.000},
    {5, 53.072, 0.34270, 1.742, 52.182, 333.854}, {5, 66.928, 0.56324, 1.683, 66.890, 327.751},  {5, 77.072, 0.72468, 1.942, 78.877, 327.481},
    {5, 90.928, 0.94521, 2.135, 88.363, 318.420}, {5, 101.072, 1.10665, 2.114, 88.052, 303.205}, {5, 114.928, 1.32718, 1.477, 59.684, 237.567},
    {6, 5.072, 0.57876, 0.958, 35.637, 237.079},  {6, 18.928, 0.79929, 2.012, 82.251, 323.947},  {6, 29.072, 0.96073, 2.083, 85.977, 312.521},
    {6, 42.928, 1.18126, 2.079, 86.784, 295.501}, {6, 53.072, 1.34270, 2.062, 87.159, 286.274},  {6, 66.928, 1.56324, 2.038, 88.756, 278.895},
    {6, 77.072, 1.72468, 0.629, 18.409, 124.789}, {6, 90.928, 1.94521, 0.000, 0.000, 0.000},     {6, 101.072, 2.10665, 0.000, 0.000, 0.000},
    {6, 114.928, 2.32718, 0.000, 0.000, 0.000},   {7, 5.072, 1.57876, 1.875, 81.047, 265.969},   {7, 18.928, 1.79929, 0.000, 0.000, 0.000},
    {7, 29.072, 1.96073, 0.000, 0.000, 0.000},    {7, 42.928, 2.18126, 0.000, 0.000, 0.000},
}};

/// Errors of the outputs with one deviation of 8 um each, at the points of null_a [um].
struct Errors {
  double helix_slope;        // output 1: helix slope, entered as -8 um
  double lead_crowning;      // output 2: c_c of one gear
  double addendum_crowning;  // output 6: profile crowning of both addenda
};
inline constexpr std::array<Errors, 24> errors{{
    {2.417, -3.309, -7.073},  {3.232, -5.918, -7.062},  {-0.408, -0.094, -7.062}, {0.408, -0.094, -7.062},  {1.005, -0.572, -5.727},
    {1.820, -1.876, -2.375},  {2.417, -3.309, -0.885},  {3.232, -5.918, -0.024},  {-3.232, -5.918, -7.062}, {-2.417, -3.309, -4.413},
    {-1.820, -1.876, -2.198}, {-1.005, -0.572, -0.450}, {-0.408, -0.094, -0.010}, {0.408, -0.094, -0.494},  {1.005, -0.572, -1.849},
    {1.820, -1.876, -5.500},  {2.417, -3.309, -7.062},  {3.232, -5.919, -7.062},  {-3.232, -5.918, -0.583}, {-2.417, -3.309, -2.830},
    {-1.820, -1.876, -5.848}, {-1.005, -0.572, -7.062}, {-0.408, -0.094, -7.062}, {0.408, -0.094, -7.062},
}};

}  // namespace flankwright::reference::haddad_1991
