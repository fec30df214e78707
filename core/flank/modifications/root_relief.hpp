#pragma once

#include "core/flank/modifications/descriptor.hpp"
#include "core/flank/modifications/relief.hpp"

namespace flankwright::modifications {

/// C_alpha_f t or t^2, t = (r_Nf + h - r)/h where that is positive [ISO 21771].
struct RootRelief {
  ProfileRelief root_relief;

  static constexpr ModificationClass flank_class = ModificationClass::Profile;
  static constexpr auto parameters() {
    using M = RootRelief;
    return std::array{row<M, &M::root_relief, &ProfileRelief::amount>({.key = "root_relief.amount",
                                                                       .name = "root relief",
                                                                       .symbol = "C_αf",
                                                                       .meaning = "C_alpha_f, removed at the start of active profile",
                                                                       .extent = "root_relief.height"}),
                      row<M, &M::root_relief, &ProfileRelief::height>(
                          {.key = "root_relief.height",
                           .name = "root relief height",
                           .meaning = "radial, from the start of active profile up; above 0 where there is an amount",
                           .kind = ParameterKind::Extent},
                          [](const M& m, const FlankFrame& frame, double r, double) {
                            const ProfileRelief& relief = m.root_relief;
                            return slope_by_extent(relief.amount, relief.height, relief.shape, frame.active_root_radius + relief.height - r);
                          })};
  }
  static constexpr auto choices() {
    return std::array{ChoiceRow<RootRelief>{"root_relief.shape",
                                            "root relief shape",
                                            {"linear", "parabolic"},
                                            "between its start and the start of active profile",
                                            [](auto& m, std::size_t word) { m.root_relief.shape = static_cast<ReliefShape>(word); }}};
  }

  struct Term {
    ReliefRamp ramp;
    double start;  ///< radius [mm]

    Term(const RootRelief& m, const FlankFrame& frame)
        : ramp(m.root_relief.amount, m.root_relief.height, m.root_relief.shape), start(frame.active_root_radius + m.root_relief.height) {}
    void add(double r, double, Jet& d) const { ramp.add(start - r, -1.0, d.value, d.u, d.uu); }
  };
  /// Where the slope of the removal jumps.
  std::array<double, 1> beyond_starts(const FlankFrame& frame, double r, double) const {
    return {beyond_start(root_relief.amount, root_relief.shape, frame.active_root_radius + root_relief.height - r)};
  }
  bool operator==(const RootRelief&) const = default;
};

}  // namespace flankwright::modifications
