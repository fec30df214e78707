#pragma once

#include "core/flank/modifications/descriptor.hpp"
#include "core/flank/modifications/relief.hpp"

namespace flankwright::modifications {

/// C_alpha_a t or t^2, t = (r - (r_a - h))/h where that is positive [ISO 21771].
struct TipRelief {
  ProfileRelief tip_relief;

  static constexpr ModificationClass flank_class = ModificationClass::Profile;
  static constexpr auto parameters() {
    using M = TipRelief;
    return std::array{row<M, &M::tip_relief, &ProfileRelief::amount>({.key = "tip_relief.amount",
                                                                      .name = "tip relief",
                                                                      .symbol = "C_αa",
                                                                      .meaning = "C_alpha_a, removed at the tip",
                                                                      .extent = "tip_relief.height"}),
                      row<M, &M::tip_relief, &ProfileRelief::height>({.key = "tip_relief.height",
                                                                      .name = "tip relief height",
                                                                      .meaning = "radial, from the tip down; above 0 where there is an amount",
                                                                      .kind = ParameterKind::Extent},
                                                                     [](const M& m, const FlankFrame& frame, double r, double) {
                                                                       const ProfileRelief& relief = m.tip_relief;
                                                                       return slope_by_extent(relief.amount, relief.height, relief.shape,
                                                                                              r - (frame.tip_radius - relief.height));
                                                                     })};
  }
  static constexpr auto choices() {
    return std::array{ChoiceRow<TipRelief>{
        "tip_relief.shape", "tip relief shape", {"linear", "parabolic"}, "between its start and the tip", [](auto& m, std::size_t word) {
          m.tip_relief.shape = static_cast<ReliefShape>(word);
        }}};
  }

  struct Term {
    ReliefRamp ramp;
    double start;  ///< radius [mm]

    Term(const TipRelief& m, const FlankFrame& frame)
        : ramp(m.tip_relief.amount, m.tip_relief.height, m.tip_relief.shape), start(frame.tip_radius - m.tip_relief.height) {}
    void add(double r, double, Jet& d) const { ramp.add(r - start, 1.0, d.value, d.u, d.uu); }
  };
  /// Where the slope of the removal jumps.
  std::array<double, 1> beyond_starts(const FlankFrame& frame, double r, double) const {
    return {beyond_start(tip_relief.amount, tip_relief.shape, r - (frame.tip_radius - tip_relief.height))};
  }
  bool operator==(const TipRelief&) const = default;
};

}  // namespace flankwright::modifications
