#include "core/flank/contact_shift.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/flank/form_grinding.hpp"

namespace flankwright {

ContactShift::ContactShift(const Gear& gear, double lowest, double highest)
    : base_radius_(gear.base_radius), middle_(0.5 * (lowest + highest)), half_(0.5 * (highest - lowest)) {}

void ContactShift::finish(double centre_roll, double share) {
  chebyshev_[0] -= sum((centre_roll - middle_) / half_);
  for (double& c : chebyshev_) c *= share;
  const auto end = [&](double x) {
    Jet value = sum(Jet::variable_u(x));
    value.u /= half_;
    return value;
  };
  lower_ = end(-1.0);
  upper_ = end(1.0);
}

std::optional<ContactShift> ContactShift::of(const GearPair& pair, Member member, const GrindingProcess& process) {
  const Gear& gear = pair[member];
  const double helix_rate = pair.flank_frame(member).helix_rate;
  if (!process.twists() || helix_rate == 0.0) return std::nullopt;
  constexpr double least = 0.01;  // of r_b: where contact takes a flank to start at least, see lowest_start
  const auto roll_at = [&](double radius) { return std::max(gear.roll_length_at(std::max(radius, gear.base_radius)), least * gear.base_radius); };
  ContactShift shift(gear, roll_at(gear.form_radius), roll_at(gear.tip_form_radius));
  if (process.kind == GrindingKind::GeneratingGrinding) {
    shift.chebyshev_[1] = -helix_rate * gear.base_radius * shift.half_;
  } else {
    const FormWheelContact contact(pair, member, process.wheel_diameter);
    shift.terms_ = most_terms;
    double z = 0.0;
    for (std::size_t i = 0; i < most_terms; ++i) {
      const double angle = units::pi * (static_cast<double>(i) + 0.5) / most_terms;
      z = contact.position(shift.middle_ + shift.half_ * std::cos(angle), z);
      for (std::size_t k = 0; k < most_terms; ++k) {
        shift.chebyshev_[k] += (k == 0 ? 1.0 : 2.0) / most_terms * z * std::cos(static_cast<double>(k) * angle);
      }
    }
  }
  shift.finish(0.5 * (roll_at(gear.active_root_radius) + roll_at(gear.tip_form_radius)), 1.0 - process.twist_compensation);
  return shift;
}

}  // namespace flankwright
