#include "core/flank/natural_twist.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

class NaturalTwistField final : public DeviationField {
 public:
  NaturalTwistField(const Modifications& lead, const FlankFrame& frame, const ContactShift& shift)
      : lead_(lead, {}, frame), radius_(frame.pitch_radius), shift_(shift) {}

  Jet at(double rho, double z) const override {
    const Jet face = Jet::variable_v(z);
    return along(face - shift_.at(Jet::variable_u(rho))) - along(face);
  }

 private:
  /// f at a position along the face; the radius is of no influence.
  Jet along(const Jet& z) const {
    const Jet f = lead_.at(radius_, z.value);
    return chain(z, f.value, f.v, f.vv);
  }

  DeviationFormula lead_;
  double radius_;
  ContactShift shift_;
};

/// Roll lengths at the start of the active profile and at the tip.
struct ActiveRolls {
  double start, tip;

  explicit ActiveRolls(const Gear& gear) : start(gear.roll_length_at(gear.active_root_radius)), tip(gear.roll_length_at(gear.tip_form_radius)) {}
};

}  // namespace

std::shared_ptr<const DeviationField> make_natural_twist_field(const GearPair& pair, Member member, const Modification& modification) {
  if (!modification.process.twists() || !has_lead_modification(modification)) return nullptr;
  const auto shift = ContactShift::of(pair, member, modification.process);
  if (!shift) return nullptr;
  return std::make_shared<NaturalTwistField>(only(static_cast<const Modifications&>(modification), ModificationClass::Lead), pair.flank_frame(member),
                                             *shift);
}

CompensationDerivative::CompensationDerivative(const GearPair& pair, Member member, const Modification& modification)
    : lead_(only(modification, ModificationClass::Lead), {}, pair.flank_frame(member)),
      base_radius_(pair[member].base_radius),
      pitch_radius_(pair.flank_frame(member).pitch_radius),
      left_(1.0 - modification.process.twist_compensation) {
  if (has_lead_modification(modification)) shift_ = ContactShift::of(pair, member, modification.process.uncompensated());
}

RemovalDerivative::WithSlope CompensationDerivative::with_slope(double r, double z) const {
  if (!shift_) return {0.0, 0.0};
  const double rho = std::sqrt(std::max(0.0, (r - base_radius_) * (r + base_radius_)));
  const Jet h = shift_->at(Jet::variable_u(rho)), f = lead_.at(pitch_radius_, z - left_ * h.value);
  const double by_roll = (f.v - f.vv * left_ * h.value) * h.u;
  return {f.v * h.value, rho > 0.0 ? by_roll * r / rho : 0.0};
}

double natural_twist(const GearPair& pair, Member member, const Modification& modification) {
  const auto field = make_natural_twist_field(pair, member, modification);
  if (!field) return 0.0;
  const ActiveRolls rolls(pair[member]);
  const auto slope = [&](double z) { return field->at(rolls.tip, z).value - field->at(rolls.start, z).value; };
  const double end = 0.5 * pair[member].data.face_width;
  return slope(end) - slope(-end);
}

double contact_shift_over_profile(const GearPair& pair, Member member, const GrindingProcess& process) {
  const auto shift = ContactShift::of(pair, member, process);
  if (!shift) return 0.0;
  const ActiveRolls rolls(pair[member]);
  return shift->at(rolls.tip) - shift->at(rolls.start);
}

}  // namespace flankwright
