#include "core/load/peak_gradient.hpp"

#include <cmath>

#include "core/load/line_region.hpp"

namespace flankwright {

namespace {

/// Derivative at a place of a line, between two points the sum of theirs times `share`; empty where the line has no such place.
template <class Slope, class Share>
Eigen::RowVectorXd at_place(const MeshModel& model, const LinePeak& peak, const Slope& slope, const Share& share) {
  const std::vector<ContactPoint>& points = model.positions.front().points;
  const double same = LineRegion::round_off * model.face_width;  // |z - z of the peak| <= same: the peak's own point
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].tooth != peak.tooth) continue;
    if (std::abs(points[i].z - peak.z) <= same) return slope(i);
    if (i + 1 == points.size() || points[i + 1].tooth != peak.tooth) continue;
    const double z0 = points[i].z, z1 = points[i + 1].z;
    if (!(z0 < peak.z && peak.z < z1 - same)) continue;
    const double t = (peak.z - z0) / (z1 - z0);
    return (1.0 - t) * share(i) * slope(i) + t * share(i + 1) * slope(i + 1);
  }
  return {};
}

Eigen::RowVectorXd gradient(const MeshAt& mesh_at, const FlankCondition& condition, double torque, const LinePeak& peak, bool of_stress,
                            const std::vector<MeshParameter>& parameters) {
  if (std::isnan(peak.value)) return {};
  const MeshModel model = mesh_at({peak.phase});
  const LoadedCycle cycle = analyse_cycle(model, condition, torque, parameters);
  if (!cycle.usable()) return {};
  const LoadedPosition& here = cycle.positions.front();
  const auto row = [&](std::size_t i) -> Eigen::RowVectorXd {
    return (of_stress ? here.contact_stress_derivative : here.line_load_derivative).row(static_cast<Eigen::Index>(i));
  };
  // Between points w and sigma^2 are linear: dsigma = sum t_i sigma_i dsigma_i / sigma.
  const auto share = [&](std::size_t i) { return of_stress ? here.contact_stress[static_cast<Eigen::Index>(i)] / peak.value : 1.0; };
  return at_place(model, peak, row, share);
}

/// Whether a parameter belongs to a part of a condition: something of it alone is left there.
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

}  // namespace

PeakGradients peak_gradients(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, const ContactPeaks& peaks,
                             const std::vector<MeshParameter>& parameters) {
  const auto pair = [&](const ContactPeaks::Pair& of) {
    return PeakGradients::Pair{gradient(mesh_at, condition, pinion_torque, of.contact_stress, true, parameters),
                               gradient(mesh_at, condition, pinion_torque, of.line_load, false, parameters)};
  };
  return {pair(peaks.with_spikes), pair(peaks.without_spikes)};
}

FlankCondition whole_condition(const FlankCondition& condition) { return condition; }

PeakGradients peak_gradients_of_part(const MeshAt& mesh_at, const FlankCondition& condition, ConditionPart part, double pinion_torque,
                                     const ContactPeaks& peaks, const std::vector<MeshParameter>& parameters) {
  std::vector<MeshParameter> acting;
  std::vector<Eigen::Index> column;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (!acts(parameters[p], part)) continue;
    acting.push_back(parameters[p]);
    column.push_back(static_cast<Eigen::Index>(p));
  }
  PeakGradients gradients = peak_gradients(mesh_at, part(condition), pinion_torque, peaks, acting);
  for (PeakGradients::Pair* pair : {&gradients.with_spikes, &gradients.without_spikes}) {
    for (Eigen::RowVectorXd* row : {&pair->contact_stress, &pair->line_load}) {
      if (row->size() != std::ssize(acting)) continue;  // no peak
      Eigen::RowVectorXd all = Eigen::RowVectorXd::Zero(std::ssize(parameters));
      all(column) = *row;
      *row = all;
    }
  }
  return gradients;
}

LoadFactorGradients load_factor_gradients(const RatedPeaks& perfect, const RatedPeaks& lead, const RatedPeaks& profile,
                                          const RatedPeaks& combined) {
  const LoadFactors factors = load_factors(perfect.peaks, lead.peaks, profile.peaks, combined.peaks);
  const auto triple = [&](const LoadFactors::Triple& value, auto gradient, auto peak) {
    const auto relative = [&](const RatedPeaks& rated) -> Eigen::RowVectorXd {
      return (rated.gradients.*gradient).contact_stress / (rated.peaks.*peak).contact_stress.value;
    };
    const Eigen::RowVectorXd base = relative(perfect);
    const auto of = [&](double factor, const RatedPeaks& rated) -> Eigen::RowVectorXd {
      const Eigen::RowVectorXd slope = relative(rated);
      if (std::isnan(factor) || slope.size() == 0 || slope.size() != base.size()) return {};
      return 2.0 * factor * (slope - base);
    };
    return LoadFactorGradients::Triple{of(value.lead, lead), of(value.profile, profile), of(value.combined, combined)};
  };
  return {triple(factors.without_spikes, &PeakGradients::without_spikes, &ContactPeaks::without_spikes),
          triple(factors.with_spikes, &PeakGradients::with_spikes, &ContactPeaks::with_spikes)};
}

}  // namespace flankwright
