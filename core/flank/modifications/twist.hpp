#pragma once

#include "core/flank/modifications/descriptor.hpp"

namespace flankwright::modifications {

/// S (r - r_w)/(r_a - r_Nf) z/b: a profile slope that changes along the face.
struct Twist {
  double twist{0.0};  ///< S, difference of the profile slopes at the two face ends; + removes at the tip at z = +b/2 [mm]

  static constexpr ModificationClass flank_class = ModificationClass::Topography;
  static constexpr auto parameters() {
    return std::array{row<Twist, &Twist::twist>({.key = "twist",
                                                 .name = "twist",
                                                 .symbol = "S_α",
                                                 .sense = "+ removes at the tip at z = +b/2",
                                                 .meaning = "removed twist * (y / h_active) * (z / b); + removes at the tip at z = +b/2",
                                                 .odd_along_face = true})};
  }
  void add_to(PolynomialAmounts& sum) const { sum.twist += twist; }
  bool operator==(const Twist&) const = default;
};

}  // namespace flankwright::modifications
