#pragma once

#include <cmath>

#include "core/flank/modifications/descriptor.hpp"
#include "core/flank/modifications/relief.hpp"

namespace flankwright::modifications {

/// C (|z| - (b/2 - l))/l where that is positive: the same at both face ends [ISO 21771, C_beta_I and C_beta_II].
struct EndReliefs {
  EndRelief end_relief;

  static constexpr ModificationClass flank_class = ModificationClass::Lead;
  static constexpr auto parameters() {
    using M = EndReliefs;
    return std::array{row<M, &M::end_relief, &EndRelief::amount>({.key = "end_relief.amount",
                                                                  .name = "end relief",
                                                                  .symbol = "C_βI, C_βII",
                                                                  .meaning = "removed at both face ends, linear",
                                                                  .extent = "end_relief.length"}),
                      row<M, &M::end_relief, &EndRelief::length>({.key = "end_relief.length",
                                                                  .name = "end relief length",
                                                                  .symbol = "L_CβI, L_CβII",
                                                                  .meaning = "axial, from each face end; above 0 where there is an amount",
                                                                  .kind = ParameterKind::Extent},
                                                                 [](const M& m, const FlankFrame& frame, double, double z) {
                                                                   const double start = 0.5 * frame.face_width - m.end_relief.length;
                                                                   return slope_by_extent(m.end_relief.amount, m.end_relief.length,
                                                                                          ReliefShape::Linear, std::abs(z) - start);
                                                                 })};
  }

  struct Term {
    ReliefRamp ramp;
    double start;  ///< |z| [mm]

    Term(const EndReliefs& m, const FlankFrame& frame)
        : ramp(m.end_relief.amount, m.end_relief.length, ReliefShape::Linear), start(0.5 * frame.face_width - m.end_relief.length) {}
    void add(double, double z, Jet& d) const { ramp.add(std::abs(z) - start, z < 0.0 ? -1.0 : 1.0, d.value, d.v, d.vv); }
  };
  /// Where the slope of the removal jumps.
  std::array<double, 2> beyond_starts(const FlankFrame& frame, double, double z) const {
    const double start = 0.5 * frame.face_width - end_relief.length;
    return {beyond_start(end_relief.amount, ReliefShape::Linear, z - start), beyond_start(end_relief.amount, ReliefShape::Linear, -z - start)};
  }
  bool operator==(const EndReliefs&) const = default;
};

}  // namespace flankwright::modifications
