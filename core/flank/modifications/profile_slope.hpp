#pragma once

#include "core/flank/modifications/descriptor.hpp"

namespace flankwright::modifications {

/// C_Halpha (r - r_w)/(r_a - r_Nf), linear in the radius [ISO 21771].
struct ProfileSlope {
  double profile_slope{0.0};  ///< C_Halpha over the active profile height; + removes at the tip, zero at the pitch point [mm]

  static constexpr ModificationClass flank_class = ModificationClass::Profile;
  static constexpr auto parameters() {
    return std::array{row<ProfileSlope, &ProfileSlope::profile_slope>(
        {.key = "profile_slope",
         .name = "profile slope",
         .symbol = "C_Hα",
         .sense = "+ removes at the tip",
         .meaning = "C_Halpha over the active profile height; + removes at the tip, zero at the pitch point"})};
  }
  void add_to(PolynomialAmounts& sum) const { sum.profile_slope += profile_slope; }
  bool operator==(const ProfileSlope&) const = default;
};

}  // namespace flankwright::modifications
