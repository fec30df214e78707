#pragma once

#include <optional>

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// The rounded edge of one flank in the section across the contact line.
///
/// s runs along the flank from the point where the undisturbed flanks would touch, positive towards the edge. With the rounding from e on
/// the gap before load is
///
///     h(s) = s^2/(2 R) + <s - e>^2/(2 rho),     <x> = max(x, 0).
///
/// Far inside (e >> L) this is the line contact of the flanks, far outside (e << -L) that of the mate with the rounding, of relative radius
/// rho R/(R + rho). In between the contact strip lies on both. rho = 0 is the sharp edge, where pressure has no bound. The arc is taken as
/// its parabola, which holds for a strip much narrower than rho.
struct RoundedEdge {
  double radius{not_given};    ///< rho, in the normal section [mm], >= 0; 0: sharp
  double distance{not_given};  ///< e, from the undisturbed contact to the start of the rounding [mm]; < 0 where contact is beyond it

  /// Least gap before load, that of the undisturbed flanks counted as 0 [mm]: 0 inside, e^2/(2 (R + rho)) outside. The sharp edge has e^2/(2 R).
  double clearance(double relative_radius) const { return distance >= 0.0 ? 0.0 : distance * distance / (2.0 * (relative_radius + radius)); }
};

/// The contact strip of two elastic half-planes below such a gap, for one line load.
///
/// Everything follows from one angle phi in closed form. With the strip s = m + l cos(theta), theta = 0 .. pi, its pressure falls to 0 at
/// both ends under a load w where [Johnson, Contact Mechanics, 1985, section 2.7(a)]
///
///     int h' dtheta = 0,     (E'/2) int s h' dtheta = w.
///
/// With the start of the rounding at theta = phi, k = R/(pi rho) and Hertz's half width of the flanks, L^2 = 4 w R/(pi E'),
///
///     m/l = -k (sin phi - phi cos phi),   (L/l)^2 = 1 + k (phi - sin phi cos phi),   e/L = (m/l + cos phi) l/L.
///
/// e/L falls from 1 to -sqrt(1 + k pi) as phi grows from 0 to pi. Beyond either the contact is Hertz's.
///
/// At a sharp edge phi is 0, and q = k phi^3/3 takes its place:
///
///     m/l = -q,   (L/l)^2 = 1 + 2 q,   e/L = (1 - q) l/L,   so that   L/l = sqrt((e/L)^2 + 3) - e/L.
///
/// The strip ends at the edge, where its pressure rises without bound as that of a punch. No peak is known there; load, width and approach are right.
class StripContact {
 public:
  /// @param relative_radius  R [mm], > 0
  /// @param contact_modulus  E' [MPa], > 0
  /// @param line_load        w [N/mm], > 0
  StripContact(const RoundedEdge& edge, double relative_radius, double contact_modulus, double line_load);

  double half_width() const { return half_width_; }  ///< l [mm]
  double growth() const { return growth_; }          ///< d(log l)/d(log w) [-]; 1/2 for Hertz's contact
  /// Mean of h over the strip, weighted as the pressure below a flat punch is, less the least h [mm]. By Betti's theorem the approach of both
  /// bodies from first touch is this and w u, where u is the approach of a flat punch of half width l under unit load.
  double rise() const { return rise_; }
  double half_width_by_edge() const { return half_width_by_edge_; }  ///< dl/de [-]
  double rise_by_edge() const { return rise_by_edge_; }              ///< d(rise)/de [-]

  /// A maximum of the pressure.
  struct Peak {
    double pressure{0.0};  ///< p [MPa]
    double slope{0.0};     ///< dp/dw [1/mm]
    double by_edge{0.0};   ///< dp/de [MPa/mm]
  };
  /// The part of the line load that the rounding carries.
  struct EdgeLoad {
    double load{0.0};     ///< w_e, the integral of the pressure over the rounding [N/mm], 0 .. w
    double slope{0.0};    ///< dw_e/dw [-]
    double by_edge{0.0};  ///< dw_e/de [MPa], <= 0
  };
  /// The largest pressure of the strip, the largest on the rounding and the load there: both 0 where the strip does not reach it, from there without a
  /// step. At a sharp edge the largest pressure is that of the flank under the same load if it went on, and nothing is on the rounding.
  struct Peaks {
    Peak highest, on_edge;
    EdgeLoad edge_load;
  };
  Peaks peaks() const;
  Peak crest() const;  ///< Peaks::on_edge alone

  /// Pressure at a point of the section [MPa]; 0 outside the strip.
  double pressure(double s) const;

 private:
  double shape(double psi) const;
  double shape_slope(double psi) const;
  double highest_on_edge() const;
  std::optional<double> highest_on_flank() const;
  Peak maximum(double psi) const;
  EdgeLoad edge_load() const;

  RoundedEdge edge_;
  double radius_, modulus_, load_;
  double middle_, half_width_, growth_, rise_, half_width_by_edge_, rise_by_edge_;
  double phi_;                           ///< 0: on the flank alone, pi: on the rounding alone
  double steepness_{1.0}, offset_{1.0};  ///< B = -sqrt(S) (de/L)/dphi / sin(phi), and N = e/l
  double punch_{0.0};                    ///< q, at a sharp edge
};

}  // namespace flankwright
