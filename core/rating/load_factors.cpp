#include "core/rating/load_factors.hpp"

#include <algorithm>
#include <vector>

namespace flankwright {

namespace {

using Field = std::shared_ptr<const DeviationField>;

/// What a measured field changes along the face, or along the profile; null as it has none.
Field traced(const Field& field, Field (DeviationField::*trace)() const) { return field == nullptr ? nullptr : ((*field).*trace)(); }

/// Of all teeth; empty where none has a trace.
std::vector<Field> traced(const std::vector<Field>& fields, Field (DeviationField::*trace)() const) {
  std::vector<Field> traces;
  for (const Field& field : fields) traces.push_back(traced(field, trace));
  const bool has_any = std::ranges::any_of(traces, [](const Field& field) { return field != nullptr; });
  return has_any ? traces : std::vector<Field>{};
}

ManufacturingError lead_of(const ManufacturingError& e) {
  ManufacturingError part;
  part.helix_slope = e.helix_slope;
  part.helix_slopes = e.helix_slopes;
  part.topographies = traced(e.topographies, &DeviationField::along_face);
  return part;
}

ManufacturingError profile_of(const ManufacturingError& e) {
  ManufacturingError part;
  part.profile_slope = e.profile_slope;
  part.profile_slopes = e.profile_slopes;
  part.pitch_step = e.pitch_step;
  part.cumulative_pitch = e.cumulative_pitch;
  part.topographies = traced(e.topographies, &DeviationField::along_profile);
  return part;
}

Modification part_of(const Modification& m, ModificationClass flank_class, Field (DeviationField::*trace)() const) {
  Modification part = only(m, flank_class);
  part.topography = traced(m.topography, trace);
  return part;
}

/// (peak / that of the perfect pair)^power.
double peak_ratio(const ContactPeaks& peaks, const ContactPeaks& perfect, ContactPeaks::Pair ContactPeaks::*which, LinePeak ContactPeaks::Pair::*of,
                  int power) {
  if (peaks.failures > 0 || perfect.failures > 0) return not_given;
  const double ratio = (peaks.*which.*of).value / (perfect.*which.*of).value;
  return power == 2 ? ratio * ratio : ratio;
}

}  // namespace

FlankCondition perfect_part(const FlankCondition& condition) {
  FlankCondition part;
  part.misalignment.axial_offset = condition.misalignment.axial_offset;
  part.other_flanks = condition.other_flanks;
  return part;
}

FlankCondition lead_part(const FlankCondition& condition) {
  FlankCondition part = perfect_part(condition);
  part.modification.pinion = part_of(condition.modification.pinion, ModificationClass::Lead, &DeviationField::along_face);
  part.modification.wheel = part_of(condition.modification.wheel, ModificationClass::Lead, &DeviationField::along_face);
  part.error.pinion = lead_of(condition.error.pinion);
  part.error.wheel = lead_of(condition.error.wheel);
  part.misalignment.crossing = condition.misalignment.crossing;
  part.misalignment.intersecting = condition.misalignment.intersecting;
  part.misalignment.pinion_lead_angle = condition.misalignment.pinion_lead_angle;
  part.misalignment.mesh_misalignment = condition.misalignment.mesh_misalignment;
  return part;
}

FlankCondition profile_part(const FlankCondition& condition) {
  FlankCondition part = perfect_part(condition);
  part.modification.pinion = part_of(condition.modification.pinion, ModificationClass::Profile, &DeviationField::along_profile);
  part.modification.wheel = part_of(condition.modification.wheel, ModificationClass::Profile, &DeviationField::along_profile);
  part.error.pinion = profile_of(condition.error.pinion);
  part.error.wheel = profile_of(condition.error.wheel);
  part.misalignment.pinion_pressure_angle = condition.misalignment.pinion_pressure_angle;
  return part;
}

FlankCondition whole_condition(const FlankCondition& condition) { return condition; }

bool shafts_deflect(ConditionPart part) { return part == &lead_part || part == &whole_condition; }

FlankCondition part_without_rims(const FlankCondition& condition, ConditionPart part, double rim_opening) {
  FlankCondition of_part = part(condition);
  if (!shafts_deflect(part)) of_part.misalignment.mesh_misalignment -= rim_opening;
  return of_part;
}

bool acts(const MeshParameter& parameter, ConditionPart part) {
  FlankCondition only;
  if (const auto* gear = std::get_if<GearParameter>(&parameter)) {
    set(only.modification[gear->member], gear->parameter, 1.0);
  } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&parameter)) {
    only.misalignment.*(*misalignment) = 1.0;
  } else {
    return true;
  }
  return !(part(only) == FlankCondition{});
}

LoadFactors load_factors(const ContactPeaks& perfect, const ContactPeaks& lead, const ContactPeaks& profile, const ContactPeaks& combined) {
  const auto triple = [&](ContactPeaks::Pair ContactPeaks::*which, LinePeak ContactPeaks::Pair::*of, int power) {
    const auto factor = [&](const ContactPeaks& peaks) { return peak_ratio(peaks, perfect, which, of, power); };
    return LoadFactors::Triple{factor(lead), factor(profile), factor(combined)};
  };
  constexpr auto stress = &ContactPeaks::Pair::contact_stress, load = &ContactPeaks::Pair::line_load;
  return {triple(&ContactPeaks::without_spikes, stress, 2), triple(&ContactPeaks::with_spikes, stress, 2),
          triple(&ContactPeaks::without_spikes, load, 1)};
}

}  // namespace flankwright
