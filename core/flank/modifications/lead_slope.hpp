#pragma once

#include "core/flank/modifications/descriptor.hpp"

namespace flankwright::modifications {

/// C_Hbeta z/b, linear along the face [ISO 21771].
struct LeadSlope {
  double lead_slope{0.0};  ///< C_Hbeta over the face width; + removes at z = +b/2, zero at mid face [mm]

  static constexpr ModificationClass flank_class = ModificationClass::Lead;
  static constexpr auto parameters() {
    return std::array{row<LeadSlope, &LeadSlope::lead_slope>({.key = "lead_slope",
                                                              .name = "lead slope",
                                                              .symbol = "C_Hβ",
                                                              .sense = "+ removes at z = +b/2",
                                                              .meaning = "C_Hbeta over the face width; + removes at z = +b/2, zero at mid face",
                                                              .odd_along_face = true})};
  }
  void add_to(PolynomialAmounts& sum) const { sum.lead_slope += lead_slope; }
  bool operator==(const LeadSlope&) const = default;
};

}  // namespace flankwright::modifications
