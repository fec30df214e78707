#pragma once

#include <array>
#include <limits>
#include <optional>

#include "core/compliance/local/free_end.hpp"
#include "core/compliance/local/strip_contact.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Factor M on the contact deflection near a free tooth tip [Haddad 1991, eq. 1.54, after Steward], and its slope.
///
/// y is the distance from the tip in Hertzian half widths. The parabola 1.627 - 0.282 y + 0.03338 y^2 is used up to y =
/// 3.6; from there a quintic of continuous value, slope and curvature falls to M = 1 at y = 5, beyond which the tip has
/// no influence. (The published form jumps from 1.031 to 1 at its minimum, y = 4.2.) M is monotone and 1 <= M <= 1.627.
struct TipFactor {
  double value;  ///< M [-]
  double slope;  ///< dM/dy [-], <= 0
};

/// @param tip_distance  y in half widths, >= 0; infinity gives M = 1
TipFactor tip_factor(double tip_distance);

/// One gear's side of a contact point.
struct ContactSide {
  double coefficient{not_given};    ///< A = 2 (1 - nu^2) / (pi E) [mm^2/N], > 0
  double lateral_ratio{not_given};  ///< nu / (1 - nu) [-], 0 .. 1
  double depth{not_given};          ///< h [mm], > 0: depth along the normal that the deflection is referred to
  /// (r_a - r) / cos(alpha_yt) [mm], distance from the tip; < 0 counts as 0, infinity switches the tip factor off.
  double tip_distance{std::numeric_limits<double>::infinity()};
  /// Distances of the contact from the gear's own end faces, along the contact line [mm]; as tip_distance below 0 and at infinity.
  std::array<double, 2> end_distances{no_ends};
  double end_lean{0};  ///< of the first end face, > 0 where it is the acute one; the second leans the other way, see FreeEnd [rad]
  /// What the tooth yields beyond its half space, in proportion to the line load, see HalfSpaceCorrection [mm^2/N]; the sum of both gears stays small
  /// beside the rest.
  double correction{0};

  static constexpr std::array<double, 2> no_ends{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

  /// The side of a gear of this material.
  /// @throws InvalidInput where the material is out of range or the depth is not positive
  static ContactSide of(const Material& material, double depth, double tip_distance = std::numeric_limits<double>::infinity(),
                        const std::array<double, 2>& end_distances = no_ends, double end_lean = 0);
};

/// Local (Hertzian) deflection of one contact point under a line load: how far the contact line approaches the points
/// at the depths h of both gears [Vedmar; Haddad 1991, eqs 1.30 and 1.54],
///
///     c(w) = sum over both gears of  M(y) A w [asinh(h') - nu/(1 - nu) h' (sqrt(1 + h'^2) - h')],
///     h' = h/L,  y = tip distance/L,  L = sqrt(4 w R / (pi E')),
///
/// a correction in proportion to w, and what each end face at a finite distance adds, (2/pi)(w/E) f(s, h, L), see FreeEnd; where the mate's end comes first, see load_end_support(). Tip and
/// ends do not know of each other: in a corner both are added.
///
/// It is the exact integral of the strain under the middle of the Hertzian pressure in plane strain. (Eq. 1.30 as
/// printed lacks the square of the h' before the root, which 1.32 has.) The logarithm of eq. 1.34 is its limit for h
/// much larger than L and turns back beyond that; this law increases at every load, c(0) = 0, and c ~ sqrt(w) where L
/// exceeds h. The first slope is infinite, as -log(w). y is held fixed at 0 at the tip itself.
///
/// Where the strip reaches an edge, L in h' is the strip's half width l, w follows StripContact, and the approach is counted from first
/// touch on the flank or its rounding:
///
///     c(w) = [the same sum with l] - w/(pi E') + rise,
///
/// as the sum is w u + w/(pi E') for Hertz's strip, u the approach of a flat punch. y keeps the L of the flank: the tip factor is about the tooth.
///
/// A small value, cheap to copy: an evaluation is two asinh, a square root and, with ends, two logarithms, with leaning ones six.
class ContactLaw {
 public:
  /// @param relative_radius  R in the normal section [mm], > 0
  /// @param contact_modulus  E' [MPa], > 0, see contact_modulus()
  /// @param edge             the edge that is nearest; nothing: none
  /// @throws InvalidInput    naming the argument outside its range
  ContactLaw(const ContactSide& pinion, const ContactSide& wheel, double relative_radius, double contact_modulus,
             const std::optional<RoundedEdge>& edge = {});

  struct Response {
    double deflection;  ///< c(w) [mm]
    double slope;       ///< dc/dw [mm per (N/mm)]; infinite at w = 0
  };
  /// @param line_load  w [N per mm of contact line], >= 0
  Response evaluate(double line_load) const;
  double deflection(double line_load) const { return evaluate(line_load).deflection; }  ///< c(w) [mm]
  double slope(double line_load) const { return evaluate(line_load).slope; }            ///< dc/dw [mm^2/N]
  /// The line load that deflects the contact by c(w) = deflection [N/mm], to round-off; 0 for a deflection of 0 or less.
  double line_load(double deflection) const;

  /// dc/de, by the distance of the edge, at held load [-]; 0 without an edge or load.
  double edge_slope(double line_load) const;
  /// The largest contact pressure, that on the edge and the load there. All 0 without load.
  StripContact::Peaks peak_pressure(double line_load) const;

  const std::optional<RoundedEdge>& edge() const { return edge_; }
  /// Whether the strip under this load reaches the edge.
  bool reaches_edge(double line_load) const { return edge_ && line_load > 0.0 && edge_->distance < half_width(line_load); }
  /// The same law with the edge further off [mm]; without an edge unchanged.
  ContactLaw with_edge_moved(double further) const;

  /// Hertzian half width L of the flank [mm].
  double half_width(double line_load) const;

 private:
  struct Side {
    ContactSide data;
    FreeEnd end;
    double end_coefficient;  ///< A / (1 - nu^2) [mm^2/N]; 0 where no end is near
  };
  std::optional<StripContact> strip(double line_load) const;

  std::array<Side, 2> sides_;
  double half_width_at_unit_load_;  ///< L / sqrt(w)
  double correction_{0};            ///< of both sides [mm^2/N]
  double relative_radius_, contact_modulus_;
  std::optional<RoundedEdge> edge_;
};

}  // namespace flankwright
