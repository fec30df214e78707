#pragma once

#include <array>

/// What the thesis says in numbers of a gear's structural compliance,
///
///     C. D. Haddad, The elastic analysis of load distribution in wide-faced helical gears, Ph.D. thesis, University of
///     Newcastle upon Tyne, 1991,
///
/// as E m_n u / F [-] unless said otherwise. Gears of 18, 40 and 100 teeth, beta = 0 and 30 deg, m_n = 10 mm,
/// b = 12 m_n, rack of BS 436; loads of about 0.5 x 0.5 m_n on the flank, deflection of the tooth's centre surface
/// along the same normal, shaft motion taken off section by section. The curves themselves (figs 2.11 to 2.33, 3.1
/// to 3.11) cannot be read off the copy at hand; these are the figures that the text gives.
namespace flankwright::reference::haddad_1991 {

struct GearBodyPart {
  int teeth;
  double helix_deg;
  double value;  ///< nearly constant over the face, load at mid face and reference diameter (3.2.2, figs 3.8 to 3.10)
};
inline constexpr std::array<GearBodyPart, 6> gear_body_part{
    {{18, 0, 0.1}, {18, 30, 0.1}, {40, 0, 0.2}, {40, 30, 0.2}, {100, 0, 0.8}, {100, 30, 1.3}}};

/// Vertical shift of the 100-tooth gear's curves against those of 18 and 40 teeth, beta = 30 deg (2.5).
inline constexpr double shift_of_100_teeth = 1.3;

/// One side of the face tips against the other by this, 2 m_n < z < 10 m_n, load at mid face and reference diameter,
/// 100 teeth, beta = 30 deg (3.5.3, on fig. 3.10).
inline constexpr double tipping_of_100_teeth = 0.34;

/// Peak deflection of the next tooth over that of the loaded one, load at the reference diameter, over all axial
/// positions of the load (2.5, figs 2.32 and 2.33; for beta = 0 after Steward).
struct AdjacentRange {
  double helix_deg, least, most;
};
inline constexpr std::array<AdjacentRange, 2> adjacent_of_100_teeth{{{0, 0.29, 0.47}, {30, 0.25, 0.72}}};

/// Table 2B.1: 40 teeth, beta = 30 deg, load at the tip 0.25 m_n from the acute end; deflection of the flank and of the
/// centre surface below along the line of contact through the load [1e-6 mm/N]. Beyond 0.5 m_n the printed z do not fit
/// the deflections, by a factor of two at 2.5 m_n; z_fitting does. E = 209000 MPa is not printed but follows from
/// stresses elsewhere. The loaded tip of this model is at 242.487 mm (title of fig. 2.20), where the reference radius
/// and m_n make 240.940 mm.
struct SurfaceAndCentre {
  double z;          ///< from the acute end, as printed [m_n]
  double z_fitting;  ///< [m_n]
  double flank, centre;
};
inline constexpr double table_2b_1_tip_radius = 24.2487;           // m_n
inline constexpr double table_2b_1_unit = 209000.0 * 10.0 * 1e-6;  // E m_n u / F of 1e-6 mm/N
inline constexpr std::array<SurfaceAndCentre, 7> table_2b_1{{{0.25, 0.25, 9.031, 6.898},
                                                             {0.50, 0.50, 5.408, 4.991},
                                                             {0.75, 1.00, 3.000, 2.914},
                                                             {2.50, 2.00, 1.323, 1.281},
                                                             {4.00, 3.50, 0.521, 0.498},
                                                             {6.50, 5.50, 0.276, 0.270},
                                                             {9.50, 7.50, 0.234, 0.232}}};

/// Sum of the centre's deflection and the contact law, too small against the flank's [%], Steward's 2-D tooth (table
/// 1.1).
inline constexpr std::array<double, 3> table_1_1_error{-2.60, -1.90, -1.90};

}  // namespace flankwright::reference::haddad_1991
