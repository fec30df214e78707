#include "core/rating/load_factors.hpp"

namespace flankwright {

namespace {

ManufacturingError lead_of(const ManufacturingError& e) {
  ManufacturingError part;
  part.helix_slope = e.helix_slope;
  part.helix_slopes = e.helix_slopes;
  return part;
}

ManufacturingError profile_of(const ManufacturingError& e) {
  ManufacturingError part;
  part.profile_slope = e.profile_slope;
  part.profile_slopes = e.profile_slopes;
  part.pitch_step = e.pitch_step;
  part.cumulative_pitch = e.cumulative_pitch;
  return part;
}

double squared_ratio(const ContactPeaks& peaks, const ContactPeaks& perfect, ContactPeaks::Pair ContactPeaks::* which) {
  if (peaks.failures > 0 || perfect.failures > 0) return not_given;
  const double ratio = (peaks.*which).contact_stress.value / (perfect.*which).contact_stress.value;
  return ratio * ratio;
}

}  // namespace

FlankCondition perfect_part(const FlankCondition& condition) {
  FlankCondition part;
  part.misalignment.axial_offset = condition.misalignment.axial_offset;
  return part;
}

FlankCondition lead_part(const FlankCondition& condition) {
  FlankCondition part = perfect_part(condition);
  part.pinion_modification = only(condition.pinion_modification, ModificationClass::Lead);
  part.wheel_modification = only(condition.wheel_modification, ModificationClass::Lead);
  part.pinion_error = lead_of(condition.pinion_error);
  part.wheel_error = lead_of(condition.wheel_error);
  part.misalignment.crossing = condition.misalignment.crossing;
  part.misalignment.intersecting = condition.misalignment.intersecting;
  part.misalignment.pinion_lead_angle = condition.misalignment.pinion_lead_angle;
  part.misalignment.mesh_misalignment = condition.misalignment.mesh_misalignment;
  return part;
}

FlankCondition profile_part(const FlankCondition& condition) {
  FlankCondition part = perfect_part(condition);
  part.pinion_modification = only(condition.pinion_modification, ModificationClass::Profile);
  part.wheel_modification = only(condition.wheel_modification, ModificationClass::Profile);
  part.pinion_error = profile_of(condition.pinion_error);
  part.wheel_error = profile_of(condition.wheel_error);
  part.misalignment.pinion_pressure_angle = condition.misalignment.pinion_pressure_angle;
  return part;
}

FlankCondition whole_condition(const FlankCondition& condition) { return condition; }

bool acts(const MeshParameter& parameter, ConditionPart part) {
  FlankCondition only;
  if (const auto* gear = std::get_if<GearParameter>(&parameter)) {
    set(gear->member == Member::Pinion ? only.pinion_modification : only.wheel_modification, gear->parameter, 1.0);
  } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&parameter)) {
    only.misalignment.*(*misalignment) = 1.0;
  } else {
    return true;
  }
  return !(part(only) == FlankCondition{});
}

bool has_other_part(const FlankCondition& condition) {
  const auto shaped = [](const Modification& m) { return m.topography != nullptr || only(m, ModificationClass::Topography) != Modification{}; };
  const auto twisted = [](const ManufacturingError& e) { return e.twist != 0.0 || !e.twists.empty(); };
  return shaped(condition.pinion_modification) || shaped(condition.wheel_modification) || twisted(condition.pinion_error) ||
         twisted(condition.wheel_error) || condition.misalignment.centre_distance != 0.0;
}

LoadFactors load_factors(const ContactPeaks& perfect, const ContactPeaks& lead, const ContactPeaks& profile,
                         const ContactPeaks& combined) {
  const auto triple = [&](ContactPeaks::Pair ContactPeaks::* which) {
    return LoadFactors::Triple{squared_ratio(lead, perfect, which), squared_ratio(profile, perfect, which),
                               squared_ratio(combined, perfect, which)};
  };
  return {triple(&ContactPeaks::without_spikes), triple(&ContactPeaks::with_spikes)};
}

}  // namespace flankwright
