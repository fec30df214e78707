#pragma once

#include <algorithm>
#include <vector>

#include "core/base/natural_spline.hpp"

namespace flankwright {

/// What one gear's tooth yields beyond the sum of its structure and of the half space that the contact law has around the contact, per unit line
/// load [w/E, dimensionless], as a function of the height on its flank. It is smooth, does not depend on the load, and rises towards the tip, where
/// the half space is least true; see half_space_correction().
class HalfSpaceCorrection {
 public:
  /// @param form_radius, tip_radius  of the flank [mm]
  /// @param heights  u = (r - r_form)/(r_a - r_form) in rising order, 0 .. 1
  /// @param values   there
  HalfSpaceCorrection(double form_radius, double tip_radius, const std::vector<double>& heights, const std::vector<double>& values)
      : form_radius_(form_radius), tip_radius_(tip_radius), lowest_(heights.front()), highest_(heights.back()), of_height_(heights, values) {}

  /// At a radius [mm]; beyond the first and last height the value there.
  double at(double radius) const { return of_height_(std::clamp((radius - form_radius_) / (tip_radius_ - form_radius_), lowest_, highest_)); }

 private:
  double form_radius_, tip_radius_, lowest_, highest_;
  NaturalSpline of_height_;
};

}  // namespace flankwright
