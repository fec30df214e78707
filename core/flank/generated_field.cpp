#include "core/flank/generated_field.hpp"

#include <algorithm>

#include "core/gear/rack_envelope.hpp"

namespace flankwright {

namespace {

Jet nowhere() {
  constexpr double nan = not_given;
  return {nan, nan, nan, nan, nan, nan};
}

template <class Section>
class GeneratedField final : public DeviationField {
 public:
  GeneratedField(const Section& section, const Gear& gear) : section_(section), circle_(gear) {
    const GeneratedRange range(gear, GeneratedRange::exact_margin);
    lowest_ = generates(section, gear, FlankStart::Form) ? range.lowest : range.active;
    highest_ = range.highest;
  }

  Jet at(double rho, double z) const override {
    const double end = std::clamp(rho, lowest_, highest_);
    const std::optional<double> parameter = tool_parameter(section_, circle_, end, z);
    if (!parameter) return nowhere();
    return rho == end ? on_flank(*parameter, rho, z) : beyond_end(*parameter, rho, end, z);
  }

 private:
  /// D from the tool's point, second derivatives by differentiating the exact first ones: with rho(t, z) the mark of the
  /// parameter t, dt/drho = 1/rho_t and dt/dz = -rho_z/rho_t.
  Jet on_flank(double parameter, double rho, double z) const {
    using Number = Dual<2>;
    const auto mark = generated_point(section_, circle_, Number::variable(parameter, 0), Number::variable(z, 1));
    const double t_rho = 1.0 / mark.roll.gradient[0], t_z = -mark.roll.gradient[1] * t_rho;
    const double missing = rho - mark.roll.value;  // what tool_parameter() left
    const double rho_rho = mark.d_roll.gradient[0] * t_rho;
    const double rho_z = mark.d_roll.gradient[0] * t_z + mark.d_roll.gradient[1];
    const double z_z = mark.d_z.gradient[0] * t_z + mark.d_z.gradient[1];
    return {mark.deviation.value + missing * mark.d_roll.value,
            mark.d_roll.value + missing * rho_rho,
            mark.d_z.value + missing * rho_z,
            rho_rho,
            rho_z,
            z_z};
  }

  /// D(end, z) + (rho - end) dD/drho(end, z). The parameter that stays at `end` while z changes is a Jet, found by Newton steps
  /// with the rate at z: each makes one more order of its derivatives exact.
  Jet beyond_end(double parameter, double rho, double end, double z) const {
    const double rate = generated_point(section_, circle_, Dual<1>::variable(parameter, 0), Dual<1>(z)).roll.gradient[0];
    const Jet along = Jet::variable_v(z);
    Jet t = parameter;
    for (int order = 1; order <= 2; ++order) {
      t -= (generated_point(section_, circle_, t, along).roll - end) / rate;
    }
    const auto mark = generated_point(section_, circle_, t, along);
    return mark.deviation + (Jet::variable_u(rho) - end) * mark.d_roll;
  }

  Section section_;
  RollingCircle circle_;
  double lowest_, highest_;  ///< roll lengths between which the field is exact [mm]
};

}  // namespace

std::shared_ptr<const DeviationField> make_generated_field(const GearPair& pair, Member member) {
  const Gear& gear = pair[member];
  if (const auto* rack = std::get_if<ParabolicRack>(&gear.data.generation)) {
    return std::make_shared<GeneratedField<ParabolicSection>>(ParabolicSection(*rack, pair.data), gear);
  }
  if (const auto* tool = std::get_if<RevolutionTool>(&gear.data.generation)) {
    return std::make_shared<GeneratedField<RevolutionSection>>(RevolutionSection(*tool, pair.data, gear.data), gear);
  }
  return nullptr;
}

}  // namespace flankwright
