#pragma once

#include <vector>

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Start and end of the profile cut by a rack.
struct GeneratedProfile {
  double form_radius{not_given};  ///< r_Ff: start of the involute [mm]; with undercut, where fillet and involute cross
  double root_radius{not_given};  ///< r_f: lowest point of the fillet [mm]
  bool undercut{false};           ///< the fillet cuts into the involute
};

/// Largest tip radius a rack tool can carry, in normal modules: both corners meet on its centre line,
///
///     rho_max = (pi/4 - h tan alpha_n) cos alpha_n / (1 - sin alpha_n).
///
/// Negative where the tool flanks already meet above its tip.
///
/// @param dedendum        h, tool addendum = gear dedendum in normal modules, > 0
/// @param pressure_angle  alpha_n [rad], 0 < alpha_n < pi/2
double full_tip_rounding(double dedendum, double pressure_angle);

/// Profile shift of the rack that leaves a gear its tooth thickness allowance, x_E = x + E_sn / (2 m_n tan(alpha_n)) [-, ISO 21771].
double generating_profile_shift(const GearData& gear, double normal_module, double pressure_angle);

/// The same teeth stated by their generating profile shift, without an allowance: the rack's addendum makes up for what the tip does not follow.
GearData as_generated(GearData gear, double normal_module, double pressure_angle);

/// Form radius, root radius and undercut of a gear cut by its rack.
///
/// @param gear            teeth, profile shift, tooth thickness allowance and rack are used
/// @param normal_module   m_n [mm], > 0
/// @param pressure_angle  alpha_n, normal section [rad], 0 < alpha_n < 45 deg
/// @param helix_angle     |beta| at the reference cylinder [rad], 0 <= beta < 60 deg
/// @throws InvalidInput   the rack cannot exist ("rack.dedendum", "rack.root_radius"), the undercut severs the tooth
///                        ("profile_shift"), or an argument is out of range
GeneratedProfile generated_profile(const GearData& gear, double normal_module, double pressure_angle, double helix_angle);

/// A point of the right-hand profile of a tooth, transverse section. The origin is the gear's centre and y runs up the
/// tooth's centre line.
struct ProfilePoint {
  double x{not_given};              ///< half the chordal tooth thickness [mm]
  double y{not_given};              ///< height above the gear's centre [mm]
  double tangent_angle{not_given};  ///< tangent against the centre line [rad], > 0 where the tooth widens downwards
};

/// Exact transverse profile of a tooth cut by a rack with rounded tips: involute above the form radius, and below it
/// the trochoid that the elliptical (in this section) tip rounding envelops [Haddad 1991, eqs 1A.1-1A.14, after
/// Vedmar].
///
/// The fillet's parameter lambda is the angle of the tool's normal against the rolling line: alpha_t where the tip
/// rounding joins the tool's flank, pi/2 at its tip. In the paper's eqs 1A.10-1A.13, with d the depth of the tool's
/// point below the rolling line, r the reference radius, x the generating profile shift and theta = phi_1 + phi,
///
///     d = (h - x - rho (1 - sin lambda_n)) m_n,       tan lambda_n = tan lambda cos beta,
///     theta r = e + d / tan lambda - rho m_n cos lambda_n / cos beta,
///     (x, y) = r (sin theta, cos theta) - d / sin lambda (cos(theta - lambda), -sin(theta - lambda)),
///
/// e = (pi/4 + h tan alpha_n + rho (1 - sin alpha_n) / cos alpha_n) m_n / cos beta being the distance along the rolling
/// line from the tooth's centre line to the centre of the rounding. The tangent there makes the angle lambda - theta
/// with the centre line. Protuberance, grinding stock and tip chamfer are not modelled.
class ToothForm {
 public:
  /// Arguments as for generated_profile(); the tip radius is gear.tip_diameter / 2 or, where that is not given,
  /// r + (h_a + x) m_n.
  /// @throws InvalidInput as generated_profile(), and "tip_diameter" where the tip lies below the form radius
  ToothForm(const GearData& gear, double normal_module, double pressure_angle, double helix_angle);

  double reference_radius() const { return reference_radius_; }  ///< r [mm]
  double base_radius() const { return base_radius_; }            ///< r_b [mm]
  double tip_radius() const { return tip_radius_; }              ///< r_a [mm]
  double form_radius() const { return form_radius_; }            ///< r_Ff [mm]
  double root_radius() const { return root_radius_; }            ///< r_f [mm]
  double helix_angle() const { return helix_angle_; }            ///< |beta| [rad]
  bool undercut() const { return undercut_; }

  /// Half the angle that the tooth subtends at a radius [rad], root_radius() <= radius <= tip_radius(); negative above
  /// the radius where the flanks meet.
  double half_angle(double radius) const;
  /// Half the angle of the tooth tip [rad]; at most 0 for a pointed tooth.
  double tip_half_angle() const { return half_angle(tip_radius_); }
  /// Transverse arc thickness of the tip [mm]; at most 0 for a pointed tooth.
  double tip_thickness() const { return 2 * tip_radius_ * tip_half_angle(); }

  /// The profile at a radius, root_radius() <= radius <= tip_radius().
  ProfilePoint at_radius(double radius) const;
  /// The profile at a height y above the gear's centre, between the lowest point of the fillet and the tip's corner.
  ProfilePoint at_height(double y) const;

  /// Fillet parameter at the form radius: alpha_t, or more with undercut [rad].
  double fillet_start() const { return fillet_start_; }
  /// The fillet at parameter lambda, fillet_start() <= lambda <= pi/2.
  ProfilePoint fillet_point(double lambda) const;
  /// dy/dlambda there, at most 0 [mm/rad]: of the class comment's formula, along the tangent.
  double fillet_rise(double lambda) const;
  /// The fillet's parameter at the height y [rad]; the nearer end where it has not.
  double fillet_at_height(double y) const;

  /// Roll length of the form circle, where the involute starts [mm].
  double involute_start() const { return roll_length(form_radius_); }
  /// The involute at a roll length, from involute_start() to the tip's.
  ProfilePoint involute_point(double roll_length) const;
  /// dy/d(roll length) there [-].
  double involute_rise(double roll_length) const;
  /// Roll length where the involute has a height y [mm]; the nearer end where it has not.
  double involute_at_height(double y) const;
  /// Where the tangent to the fillet makes a given angle with the centre line in the *normal* section, tan(angle_t) =
  /// tan(angle_n) / cos(beta) [Haddad 1991, fig. 1A.5]; 30 deg is the critical section of ISO 6336-3. The start of the
  /// fillet where its tangent is already steeper, its lowest point where none is as steep.
  ProfilePoint root_tangent_point(double normal_tangent_angle) const;

  /// Polyline of the right-hand profile from the lowest point of the fillet to the tip, for drawing; points >= 4, half
  /// of them (rounded down) on the fillet.
  std::vector<ProfilePoint> profile(int points) const;

 private:
  friend GeneratedProfile generated_profile(const GearData&, double, double, double);
  struct NoTip {};
  ToothForm(NoTip, const GearData& gear, double normal_module, double pressure_angle, double helix_angle);

  struct Trochoid {
    double depth, theta;  ///< d [mm] and theta [rad] of the class comment
  };
  Trochoid trochoid(double lambda) const;
  double fillet_radius(double lambda) const;
  double involute_half_angle(double roll_length) const;
  double roll_length(double radius) const;
  void locate_form_radius();
  double waist() const;  ///< half the smallest thickness of the fillet [mm]

  double helix_angle_, transverse_pressure_angle_;
  double reference_radius_, base_radius_, root_radius_;
  double tip_radius_{not_given}, form_radius_{not_given}, fillet_start_{not_given};
  double base_half_angle_;        ///< half angle of the tooth at the base circle [rad]
  double rounding_, tool_depth_;  ///< rho and h - x [mm]
  double rounding_centre_;        ///< e [mm]
  bool undercut_{false};
};

}  // namespace flankwright
