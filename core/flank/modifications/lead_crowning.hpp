#pragma once

#include "core/flank/modifications/descriptor.hpp"

namespace flankwright::modifications {

/// C_beta (2z/b)^2: a parabola along the face [ISO 21771].
struct LeadCrowning {
  double lead_crowning{0.0};  ///< C_beta, removed at both face ends [mm]

  static constexpr ModificationClass flank_class = ModificationClass::Lead;
  static constexpr auto parameters() {
    return std::array{row<LeadCrowning, &LeadCrowning::lead_crowning>(
        {.key = "lead_crowning", .name = "lead crowning", .symbol = "C_β", .meaning = "C_beta, removed at both face ends, parabola over z"})};
  }
  void add_to(PolynomialAmounts& sum) const { sum.lead_crowning += lead_crowning; }
  bool operator==(const LeadCrowning&) const = default;
};

}  // namespace flankwright::modifications
