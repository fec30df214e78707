#pragma once

#include <optional>
#include <vector>

#include "core/contact/assembly/flank_condition.hpp"
#include "core/contact/assembly/wheel_displacement.hpp"
#include "core/contact/gap/flank_touch.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/flank/flank.hpp"

namespace flankwright {

/// Finds the touch in the transverse section of a point, with R the relative radius, h(x) the deviations of both flanks, straight on beyond the edge x_e
/// that ends the flanks, and rho the radius of that edge:
///
///     g = x_v^2/(2 R) + h(x_v) + (x_v - x_e)^2/(2 (R + rho)),   x_v where x^2/(2 R) + h is least,
///
/// the last term only where x_v lies beyond x_e. Relief makes flanks touch where less of it has been taken off: with a slope h' they touch at x = -R h',
/// nearer than at x = 0 by R h'^2/2. Outside A .. E the involutes would touch beyond the edge, and h = 0 leaves the clearance of app. 2A of
/// Haddad 1991. The parabola holds to second order in x/R, R being kept.
///
/// A predesigned parabola of transmission error is given as the lag L(x) that it makes where the involutes would touch. The flank that has this lag deviates
/// by L + R L'^2/2, which is its part of h.
///
/// A wheel that is displaced by s along the profile and by a along the line of action, WheelDisplacement, moves the point where the involutes touch:
/// forward on the pinion, back on the wheel, each in proportion to its radius of curvature. In the section their parabolas are x_1^2/(2 rho_1) and
/// (x_1 - s)^2/(2 rho_2). The wheel's base circle goes along by a, which makes the wheel's roll length longer:
///
///     x_1 = x + s rho_1/(rho_1 + rho_2),   x_2 = x - s rho_2/(rho_1 + rho_2) + a rho_2/r_b2,   g += cos(beta_b) s^2/(2 (rho_1 + rho_2)).
///
/// Deviations and edges are those at x_1 and x_2. This is how another centre distance or intersecting axes move the path of contact along the flanks.
class FlankTouchSearch {
 public:
  /// @param pair    must outlive this
  /// @param placed  the misalignment that the points were made for: only what the condition has beyond it displaces the wheel along the profile
  FlankTouchSearch(const GearPair& pair, const FlankCondition& condition, const Misalignment& placed = {});
  /// A point without a relative radius is compared as it is.
  std::vector<FlankTouch> at(const std::vector<ContactPoint>& points) const;
  FlankTouch at(const ContactPoint& point) const { return at(std::vector{point}).front(); }

  /// The search on one tooth pair, for many points: the deviations of its flanks are prepared once.
  class OnTooth {
   public:
    /// @param search  must outlive this
    OnTooth(const FlankTouchSearch& search, int tooth);
    FlankTouch at(const ContactPoint& point) const;

   private:
    struct Teeth {
      ToothDeviation pinion, wheel;
    };
    const FlankTouchSearch& search_;
    Teeth deviations_;
    std::optional<Teeth> lags_;
  };

 private:
  const GearPair& pair_;
  PathOfContact path_;
  Misalignment misalignment_;
  WheelDisplacement displaced_;  ///< beyond what the points were made for
  PerGear<Flank> flanks_;        ///< without predesigned parabolas
  PerGear<Flank> lags_;          ///< nothing but these
  bool has_lag_;
};

/// Derivatives of a touch by one modification parameter of one gear [by mm; parabolic_te mm rad], exact but for slopes of what a process moves and of
/// extents, which are central differences.
class TouchDerivative {
 public:
  /// @param pair  must outlive this
  TouchDerivative(const GearPair& pair, const FlankCondition& condition, Member member, ModificationParameter parameter);
  /// dg/dp
  double of_gap(const ContactPoint& point, const FlankTouch& touch) const;
  /// The part of it that the rounding of an edge makes, -d(rounded_off)/dp.
  double of_rounding(const ContactPoint& point, const FlankTouch& touch) const;
  /// d(edge_moved_by())/dp
  double of_edge(const ContactPoint& point, const FlankTouch& touch) const;

 private:
  struct Slopes {
    double value, slope;
  };
  Slopes slopes(const ContactPoint& point, const FlankTouch::Side& side) const;

  const GearPair& pair_;
  Misalignment misalignment_;
  Member member_;
  bool of_lag_;
  GroundDerivative removed_;
};

}  // namespace flankwright
