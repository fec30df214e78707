#pragma once

#include <cmath>

#include "core/base/jet.hpp"
#include "core/flank/modifications/descriptor.hpp"

namespace flankwright::modifications {

/// r_b2 a phi1^2 with phi1 = i ((rho - rho_w)/r_b - s z/p) and i = 1 (pinion) or -N2/N1 (wheel): the pinion angle at which the undisturbed flanks
/// touch along the line through (rho, z), the same along that whole line. It is how far the mesh lags there; the flank that makes it do
/// so is make_conjugate_field().
struct ParabolicTe {
  double parabolic_te{0.0};  ///< a of the predesigned transmission error delta_phi2 = -a phi1^2 [1/rad]

  static constexpr ModificationClass flank_class = ModificationClass::Topography;
  static constexpr auto parameters() {
    return std::array{row<ParabolicTe, &ParabolicTe::parabolic_te>(
        {.key = "parabolic_te",
         .name = "parabolic transmission error",
         .meaning = "a of the predesigned transmission error -a phi1^2: removed along the contact line of pinion angle phi1",
         .kind = ParameterKind::TeParabola})};
  }

  struct Term {
    double amount;  ///< r_b2 a i^2 [mm]
    double base_radius, pitch_roll, helix_rate;

    Term(const ParabolicTe& m, const FlankFrame& frame)
        : amount(m.parabolic_te == 0.0 ? 0.0 : frame.wheel_base_radius * m.parabolic_te * frame.pinion_turn * frame.pinion_turn),
          base_radius(frame.base_radius),
          pitch_roll(frame.pitch_roll),
          helix_rate(frame.helix_rate) {}
    void add(double r, double z, Jet& d) const {
      if (amount == 0.0) return;
      const double rho = std::sqrt((r - base_radius) * (r + base_radius)), k = amount;
      const double turn = (rho - pitch_roll) / base_radius - helix_rate * z;  // of the gear itself
      const double turn_r = r / (rho * base_radius), turn_rr = -base_radius / (rho * rho * rho);
      d.value += k * turn * turn;
      d.u += 2.0 * k * turn * turn_r;
      d.v -= 2.0 * k * turn * helix_rate;
      d.uu += 2.0 * k * (turn_r * turn_r + turn * turn_rr);
      d.uv -= 2.0 * k * turn_r * helix_rate;
      d.vv += 2.0 * k * helix_rate * helix_rate;
    }
  };
  bool operator==(const ParabolicTe&) const = default;
};

}  // namespace flankwright::modifications
