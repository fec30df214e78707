#include "core/gear/gear_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/findings.hpp"
#include "core/base/root.hpp"
#include "core/gear/edges.hpp"
#include "core/gear/generation_check.hpp"
#include "core/gear/involute.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright {

namespace {

void check_rack(const GearData& gear, const std::string& name, const PairData& pair, Findings& findings) {
  const RackProfile& rack = gear.rack;
  findings.require(rack.addendum > 0.0 && rack.addendum <= 2.0, name + ".rack.addendum", rack.addendum, "above 0, at most 2");
  findings.require(rack.dedendum > 0.0 && rack.dedendum <= 2.5, name + ".rack.dedendum", rack.dedendum, "above 0, at most 2.5");
  if (!(rack.dedendum > 0.0)) return;
  const double largest = full_tip_rounding(rack.dedendum, pair.pressure_angle);
  findings.require(largest > 0.0, name + ".rack.dedendum", rack.dedendum,
                   "small enough that the rack's tooth is not pointed: dedendum * tan(alpha_n) < pi/4");
  if (largest > 0.0) {
    findings.require(rack.root_radius >= 0.0 && rack.root_radius <= largest, name + ".rack.root_radius", rack.root_radius,
                     "0 .. " + in_words(largest) + " (full rounding of the tool's tip)");
  }
}

/// Geometry of one gear that needs no mate.
Gear single_gear(Member m, const PairData& pair) {
  Gear gear;
  gear.member = m;
  gear.data = pair[m];
  const bool is_right = (pair.pinion_hand == Hand::Right) == (m == Member::Pinion);
  gear.hand = is_right ? Hand::Right : Hand::Left;
  const double cos_beta = std::cos(pair.helix_angle);
  const double alpha_t = std::atan(std::tan(pair.pressure_angle) / cos_beta);
  gear.reference_radius = 0.5 * gear.data.teeth * pair.normal_module / cos_beta;
  gear.base_radius = gear.reference_radius * std::cos(alpha_t);
  gear.tip_radius = std::isnan(gear.data.tip_diameter)
                        ? gear.reference_radius + pair.normal_module * (gear.data.rack.addendum + gear.data.profile_shift)
                        : 0.5 * gear.data.tip_diameter;
  const double tan_base_helix = std::tan(pair.helix_angle) * std::cos(alpha_t);
  gear.helix_rate = tan_base_helix / gear.base_radius;
  // ISO 6336-1: z_n = z / (cos^2(beta_b) cos(beta)).
  gear.virtual_teeth = gear.data.teeth * (1.0 + tan_base_helix * tan_base_helix) / cos_beta;
  set_tip_edge(gear);
  gear.generating_profile_shift = generating_profile_shift(gear.data, pair.normal_module, pair.pressure_angle);
  gear.tooth_thickness = pair.normal_module * (0.5 * units::pi + 2.0 * gear.generating_profile_shift * std::tan(pair.pressure_angle)) / cos_beta;
  return gear;
}

void check_gear(Member m, const PairData& pair, Findings& findings) {
  const std::string name = name_of(m);
  const Gear gear = single_gear(m, pair);
  GeneratedProfile generated;
  try {
    generated = generated_profile(gear.data, pair.normal_module, pair.pressure_angle, pair.helix_angle);
  } catch (const InvalidInput& problem) {
    findings.add(InvalidInput(name + "." + problem.field(), problem.value(), problem.allowed()));
    return;
  }
  findings.require(generated.root_radius > 0.0, name + ".profile_shift", gear.data.profile_shift, "large enough to leave a root circle");
  const bool given_tip = !std::isnan(gear.data.tip_diameter);
  const std::string tip_field = name + (given_tip ? ".tip_diameter" : ".profile_shift");
  const double tip_value = given_tip ? gear.data.tip_diameter : gear.data.profile_shift;
  const double form = std::max(generated.form_radius, gear.base_radius);
  findings.require(gear.tip_radius > form, tip_field, tip_value, "a tip circle above the form circle, diameter " + in_words(2.0 * form) + " mm");
  if (gear.tip_radius > form) {
    findings.add(find_edge_problems(gear, form, name));
    findings.require(gear.tooth_thickness_at(gear.tip_radius) > 0.0, tip_field, tip_value,
                     "a tooth that is not pointed: its thickness at the tip is " + in_words(gear.tooth_thickness_at(gear.tip_radius)) +
                         " mm, and must be above 0");
  }
}

/// The transverse pressure angle at which teeth of these profile shifts have no backlash [ISO 21771]:
///
///     inv(alpha_wt) = inv(alpha_t) + 2 tan(alpha_n) (x1 + x2) / (z1 + z2).
double backlash_free_angle(const PairData& data, double shift_sum) {
  const double alpha_t = std::atan(std::tan(data.pressure_angle) / std::cos(data.helix_angle));
  if (shift_sum == 0.0) return alpha_t;
  return inverse_involute(involute(alpha_t) + 2.0 * std::tan(data.pressure_angle) * shift_sum / (data.pinion.teeth + data.wheel.teeth));
}

/// Fills what depends on both gears; pinion and wheel hold their own geometry already.
void mesh(GearPair& pair) {
  const PairData& data = pair.data;
  const double cos_beta = std::cos(data.helix_angle);
  Gear& g1 = pair.pinion;
  Gear& g2 = pair.wheel;
  pair.transverse_pressure_angle = std::atan(std::tan(data.pressure_angle) / cos_beta);
  pair.base_helix_angle = std::atan(std::tan(data.helix_angle) * std::cos(pair.transverse_pressure_angle));
  const double teeth = data.pinion.teeth + data.wheel.teeth;
  const double reference_distance = g1.reference_radius + g2.reference_radius;
  const auto distance_at = [&](double angle) {
    return angle == pair.transverse_pressure_angle ? reference_distance
                                                   : reference_distance * std::cos(pair.transverse_pressure_angle) / std::cos(angle);
  };
  // Nominal teeth have no backlash where the centre distance is not given; the allowances make it.
  const bool given = !std::isnan(data.centre_distance);
  const double nominal_angle = backlash_free_angle(data, data.pinion.profile_shift + data.wheel.profile_shift);
  pair.backlash_free_centre_distance = distance_at(backlash_free_angle(data, g1.generating_profile_shift + g2.generating_profile_shift));
  pair.centre_distance = given ? data.centre_distance : distance_at(nominal_angle);
  pair.working_transverse_pressure_angle = given ? std::acos((g1.base_radius + g2.base_radius) / pair.centre_distance) : nominal_angle;
  const double alpha_wt = pair.working_transverse_pressure_angle;
  for (Gear* gear : {&g1, &g2}) {
    gear->working_pitch_radius = pair.centre_distance * gear->data.teeth / teeth;
    const GeneratedProfile generated = generated_profile(gear->data, data.normal_module, data.pressure_angle, data.helix_angle);
    gear->root_radius = generated.root_radius;
    gear->form_radius = generated.form_radius;
    gear->undercut = generated.undercut;
    gear->tip_thickness = gear->tooth_thickness_at(gear->tip_radius);
  }
  pair.working_helix_angle = std::atan(std::tan(data.helix_angle) * g1.working_pitch_radius / g1.reference_radius);
  pair.transverse_base_pitch = 2.0 * units::pi * g1.base_radius / data.pinion.teeth;
  // Without a given centre distance the nominal teeth fill the pitch circle by construction, not just to round-off.
  const auto added = [&](const Gear& gear) {
    return gear.data.tooth_thickness_allowance / cos_beta * gear.working_pitch_radius / gear.reference_radius;
  };
  pair.backlash = given ? pair.backlash_at(pair.centre_distance) : 0.0 - added(g1) - added(g2);
  pair.face_width = std::min(data.pinion.face_width, data.wheel.face_width);

  pair.path_length = pair.centre_distance * std::sin(alpha_wt);
  pair.pitch_point = g1.base_radius * std::tan(alpha_wt);
  const double at_wheel_tip = pair.path_length - g2.roll_length_at(g2.tip_form_radius);
  const double at_pinion_tip = g1.roll_length_at(g1.tip_form_radius);
  const double at_pinion_form = g1.roll_length_at(std::max(g1.form_radius, g1.base_radius));
  const double at_wheel_form = pair.path_length - g2.roll_length_at(std::max(g2.form_radius, g2.base_radius));
  // A mate's tip that reaches below the form circle by round-off only is no interference.
  const double round_off = 1e-9 * pair.path_length;
  g1.fillet_interference = at_wheel_tip < at_pinion_form - round_off;
  g2.fillet_interference = at_pinion_tip > at_wheel_form + round_off;
  pair.path_start = std::max(at_wheel_tip, at_pinion_form);
  pair.path_end = std::min(at_pinion_tip, at_wheel_form);
  g1.active_root_radius = std::hypot(g1.base_radius, pair.path_start);
  g2.active_root_radius = std::hypot(g2.base_radius, pair.path_length - pair.path_end);
  pair.transverse_contact_ratio = (pair.path_end - pair.path_start) / pair.transverse_base_pitch;
  for (const Member m : {Member::Pinion, Member::Wheel}) (m == Member::Pinion ? g1 : g2).face = flank_range(pair[m], pair.acute_end(m));
  pair.overlap_ratio = pair.face_width * std::tan(pair.base_helix_angle) / pair.transverse_base_pitch;
}

GearPair build(const PairData& data) {
  GearPair pair;
  pair.data = data;
  pair.pinion = single_gear(Member::Pinion, data);
  pair.wheel = single_gear(Member::Wheel, data);
  mesh(pair);
  return pair;
}

void check_mesh(const PairData& data, Findings& findings) {
  const GearPair pair = build(data);
  for (Member m : {Member::Pinion, Member::Wheel}) {
    const Gear& gear = pair[m];
    const Gear& mate = pair[m == Member::Pinion ? Member::Wheel : Member::Pinion];
    const double largest_tip = pair.centre_distance - mate.root_radius;
    const bool given = !std::isnan(gear.data.tip_diameter);
    // A centre distance that leaves no room although teeth without backlash would have it is to blame itself.
    const bool too_close = !std::isnan(data.centre_distance) && gear.tip_radius < pair.backlash_free_centre_distance - mate.root_radius;
    if (too_close) {
      const double least = gear.tip_radius + mate.root_radius;
      findings.require(data.centre_distance > least, "pair.centre_distance", data.centre_distance,
                       "above " + in_words(least) + " mm, where the " + name_of(m) + "'s tip meets the mate's root circle; at " +
                           in_words(pair.backlash_free_centre_distance) + " mm the teeth have no backlash");
    } else {
      findings.require(gear.tip_radius < largest_tip, name_of(m) + std::string(given ? ".tip_diameter" : ".profile_shift"),
                       given ? gear.data.tip_diameter : gear.data.profile_shift,
                       "a tip diameter below " + in_words(2.0 * largest_tip) + " mm, where it meets the mate's root circle");
    }
    findings.add(find_generation_problems(gear, data));
  }
  findings.require(pair.transverse_contact_ratio > 0.0, "pair.centre_distance", pair.centre_distance,
                   "one at which the active flanks meet on the line of action, transverse contact ratio above 0 (it is " +
                       in_words(pair.transverse_contact_ratio) + ")");
  findings.require(pair.total_contact_ratio() >= 1.0, "pair.centre_distance", pair.centre_distance,
                   "one that leaves a total contact ratio of at least 1 (it is " + in_words(pair.total_contact_ratio()) + ")");
}

}  // namespace

bool has_room_for_tip_chamfer(Member m, const PairData& pair) { return leaves_room_for_tip_chamfer(single_gear(m, pair)); }

double usual_edge_radius(Member m, const PairData& pair) {
  const bool whole = pair[m].teeth > 0 && pair.normal_module > 0.0 && pair.pressure_angle > 0.0;
  return whole ? usual_edge_radius(single_gear(m, pair), pair.normal_module) : 0.0;
}

std::optional<double> edge_radius_for(Member m, const PairData& pair, double tip_form_radius) {
  const bool is_chamfered = pair[m].tip_chamfer.amount > 0.0;
  const auto with_edge = [&](double radius) {
    PairData with = pair;
    (is_chamfered ? with[m].tip_chamfer.radius : with[m].tip_rounding) = radius;
    return single_gear(m, with);
  };
  // The square of the roll length at the flank's end falls in proportion to the radius, see set_tip_edge().
  const double probe = 0.01 * pair.normal_module;
  const Gear sharp = with_edge(0.0), rounded = with_edge(probe);
  if (!(tip_form_radius > sharp.base_radius && tip_form_radius < sharp.tip_form_radius)) return std::nullopt;
  const double roll = sharp.roll_length_at(sharp.tip_form_radius);
  const auto fall = [&](double end) { return (roll - sharp.roll_length_at(end)) * (roll + sharp.roll_length_at(end)); };
  const double radius = probe * fall(tip_form_radius) / fall(rounded.tip_form_radius);
  if (!is_chamfered && 2.0 * radius >= sharp.tooth_thickness_at(sharp.tip_radius)) return std::nullopt;
  return radius;
}

namespace {

/// find_problems(), whatever is to blame.
std::vector<InvalidInput> problems_of(const PairData& data) {
  Findings findings;
  findings.require(data.normal_module > 0.0 && std::isfinite(data.normal_module), "pair.normal_module", data.normal_module, "above 0 mm");
  findings.require(data.pressure_angle >= 10 * units::deg && data.pressure_angle <= 35 * units::deg, "pair.pressure_angle",
                   data.pressure_angle / units::deg, "10 .. 35 deg");
  findings.require(data.helix_angle >= 0.0 && data.helix_angle <= 45 * units::deg, "pair.helix_angle", data.helix_angle / units::deg, "0 .. 45 deg");
  for (Member m : {Member::Pinion, Member::Wheel}) {
    const std::string name = name_of(m);
    const GearData& gear = data[m];
    findings.require(gear.teeth >= 5, name + ".teeth", gear.teeth, "an integer of at least 5");
    findings.require(gear.face_width > 0.0 && std::isfinite(gear.face_width), name + ".face_width", gear.face_width, "above 0 mm");
    findings.require(std::abs(gear.profile_shift) <= 2.0, name + ".profile_shift", gear.profile_shift, "-2 .. 2");
    findings.require(std::isnan(gear.tip_diameter) || (gear.tip_diameter > 0.0 && std::isfinite(gear.tip_diameter)), name + ".tip_diameter",
                     gear.tip_diameter, "above 0 mm");
    findings.require(gear.tooth_thickness_allowance <= 0.0 && std::isfinite(gear.tooth_thickness_allowance), name + ".tooth_thickness_allowance",
                     gear.tooth_thickness_allowance / units::um, "0 um or less: a thicker tooth is one of larger profile shift");
    check_rack(gear, name, data, findings);
    findings.add(find_tool_problems(data, m));
  }
  if (!findings.empty()) return findings.take();

  for (Member m : {Member::Pinion, Member::Wheel}) check_gear(m, data, findings);
  const double base_radii = single_gear(Member::Pinion, data).base_radius + single_gear(Member::Wheel, data).base_radius;
  if (!std::isnan(data.centre_distance)) {
    findings.require(data.centre_distance > base_radii && std::isfinite(data.centre_distance), "pair.centre_distance", data.centre_distance,
                     "above the sum of the base radii, " + in_words(base_radii) + " mm");
  }
  const double alpha_t = std::atan(std::tan(data.pressure_angle) / std::cos(data.helix_angle));
  const auto shift = [&](Member m) { return generating_profile_shift(data[m], data.normal_module, data.pressure_angle); };
  const double shift_sum = shift(Member::Pinion) + shift(Member::Wheel);
  const double working_involute = involute(alpha_t) + 2.0 * std::tan(data.pressure_angle) * shift_sum / (data.pinion.teeth + data.wheel.teeth);
  findings.require(working_involute > 0.0, "pinion.profile_shift", data.pinion.profile_shift,
                   "a sum of profile shifts that leaves a positive working pressure angle");
  if (findings.empty()) check_mesh(data, findings);
  return findings.take();
}

}  // namespace

std::vector<InvalidInput> find_problems(const PairData& data) {
  std::vector<InvalidInput> problems = problems_of(data);
  PairData sound = data;  // the allowances that are not to blame are left in it
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (std::isless(data[m].tooth_thickness_allowance, 0.0)) sound[m].tooth_thickness_allowance = 0.0;
  }
  if (problems.empty() || !problems_of(sound).empty()) return problems;
  std::vector<InvalidInput> of_allowances;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const auto problems_with = [&](double allowance) {
      PairData with = sound;
      with[m].tooth_thickness_allowance = allowance;
      return problems_of(with);
    };
    const double allowance = data[m].tooth_thickness_allowance;
    if (const std::vector<InvalidInput> caused = problems_with(allowance); caused.empty()) {
      sound[m].tooth_thickness_allowance = allowance;
    } else {
      const double least = limit_between(0.0, allowance, [&](double tried) { return problems_with(tried).empty(); });
      of_allowances.emplace_back(
          name_of(m) + std::string(".tooth_thickness_allowance"), in_words(allowance / units::um),
          in_words(least / units::um) + " .. 0 um (else " + caused.front().field() + ": allowed is " + caused.front().allowed() + ")");
    }
  }
  return of_allowances;
}

GearPair make_gear_pair(const PairData& data) {
  const std::vector<InvalidInput> problems = find_problems(data);
  if (!problems.empty()) throw problems.front();
  return build(data);
}

}  // namespace flankwright
