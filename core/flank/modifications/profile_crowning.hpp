#pragma once

#include "core/flank/modifications/descriptor.hpp"

namespace flankwright::modifications {

/// C_a ((r - r_w)/(r_a - r_w))^2 above, C_f ((r_w - r)/(r_w - r_Nf))^2 below the pitch circle r_w. No crowning above where r_a <= r_w and none
/// below where r_Nf >= r_w: there all contact is on one side of the pitch point.
struct ProfileCrowning {
  double addendum_crowning{0.0};  ///< C_a, removed at the tip [mm]
  double dedendum_crowning{0.0};  ///< C_f, removed at the start of active profile [mm]

  static constexpr ModificationClass flank_class = ModificationClass::Profile;
  static constexpr auto parameters() {
    using M = ProfileCrowning;
    return std::array{
        ParameterRow<M>{{.key = "profile_crowning",
                         .name = "profile crowning",
                         .symbol = "C_α",
                         .meaning = "C_alpha: addendum and dedendum crowning at once",
                         .half = "addendum_crowning",
                         .other_half = "dedendum_crowning"},
                        [](const M& m) { return 0.5 * (m.addendum_crowning + m.dedendum_crowning); },
                        [](M& m, double value) { m.addendum_crowning = m.dedendum_crowning = value; }},
        row<M, &M::addendum_crowning>(
            {.key = "addendum_crowning", .name = "addendum crowning", .meaning = "removed at the tip, parabola from the pitch point up"}),
        row<M, &M::dedendum_crowning>({.key = "dedendum_crowning",
                                       .name = "dedendum crowning",
                                       .meaning = "removed at the start of active profile, parabola from the pitch point down"})};
  }
  void add_to(PolynomialAmounts& sum) const {
    sum.addendum_crowning += addendum_crowning;
    sum.dedendum_crowning += dedendum_crowning;
  }
  bool operator==(const ProfileCrowning&) const = default;
};

}  // namespace flankwright::modifications
