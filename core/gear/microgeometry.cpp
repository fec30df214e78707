#include "core/gear/microgeometry.hpp"

namespace flankwright {

namespace {

/// The one place that knows which field a parameter is. ProfileCrowning is not a field; see get() and set().
double& field(Modification& m, ModificationParameter parameter) {
  switch (parameter) {
    case ModificationParameter::LeadCrowning: return m.lead_crowning;
    case ModificationParameter::LeadSlope: return m.lead_slope;
    case ModificationParameter::ProfileCrowning:
    case ModificationParameter::AddendumCrowning: return m.addendum_crowning;
    case ModificationParameter::DedendumCrowning: return m.dedendum_crowning;
    case ModificationParameter::ProfileSlope: return m.profile_slope;
    case ModificationParameter::TipReliefAmount: return m.tip_relief.amount;
    case ModificationParameter::TipReliefHeight: return m.tip_relief.height;
    case ModificationParameter::RootReliefAmount: return m.root_relief.amount;
    case ModificationParameter::RootReliefHeight: return m.root_relief.height;
    case ModificationParameter::EndReliefAmount: return m.end_relief.amount;
    case ModificationParameter::EndReliefLength: return m.end_relief.length;
    case ModificationParameter::Twist: return m.twist;
    case ModificationParameter::ParabolicTe: return m.parabolic_te;
    default: return m.shapes[static_cast<std::size_t>(parameter) - static_cast<std::size_t>(ModificationParameter::TopographyFace2)];
  }
}

/// Entry k mod size; 0 of an empty list.
template <class Value>
Value of_tooth(const std::vector<Value>& list, int tooth) {
  if (list.empty()) return {};
  const int size = static_cast<int>(list.size());
  return list[static_cast<std::size_t>(((tooth % size) + size) % size)];
}

}  // namespace

double get(const Modification& modification, ModificationParameter parameter) {
  if (parameter == ModificationParameter::ProfileCrowning) {
    return 0.5 * (modification.addendum_crowning + modification.dedendum_crowning);
  }
  Modification copy = modification;
  return field(copy, parameter);
}

void set(Modification& modification, ModificationParameter parameter, double value) {
  field(modification, parameter) = value;
  if (parameter == ModificationParameter::ProfileCrowning) modification.dedendum_crowning = value;
}

ToothError tooth_error(const ManufacturingError& error, int tooth) {
  return {error.helix_slope + of_tooth(error.helix_slopes, tooth), error.profile_slope + of_tooth(error.profile_slopes, tooth),
          error.twist + of_tooth(error.twists, tooth)};
}

const DeviationField* tooth_topography(const ManufacturingError& error, int tooth) { return of_tooth(error.topographies, tooth).get(); }

double pitch_deviation(const ManufacturingError& error, int tooth) {
  return error.cumulative_pitch.empty() ? error.pitch_step * tooth : of_tooth(error.cumulative_pitch, tooth);
}

}  // namespace flankwright
