#include "core/load/peak_gradient.hpp"

#include <array>
#include <cmath>

#include "core/load/axial_offset.hpp"
#include "core/load/line_region.hpp"

namespace flankwright {

namespace {

/// A place of a line: a point of it, or a share of the way to the next.
struct LinePlace {
  Eigen::Index point{-1};  ///< -1: the line has no such place
  double share{0.0};
};

/// @param z  [mm]
LinePlace place_on_line(const MeshModel& model, const MeshPosition& at, int tooth, double z) {
  const std::vector<ContactPoint>& points = at.points;
  const double same = LineRegion::round_off * model.face_width;  // |z - z of a point| <= same: the point itself
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].tooth != tooth) continue;
    if (std::abs(points[i].z - z) <= same) return {static_cast<Eigen::Index>(i), 0.0};
    if (i + 1 == points.size() || points[i + 1].tooth != tooth) continue;
    const double z0 = points[i].z, z1 = points[i + 1].z;
    if (z0 < z && z < z1 - same) return {static_cast<Eigen::Index>(i), (z - z0) / (z1 - z0)};
  }
  return {};
}

/// One of the peaks of a load case.
struct PlacedPeak {
  const MeshAt& mesh_at;
  const FlankCondition& condition;
  double torque;
  const ContactPeaks& peaks;
  const LinePeak& peak;
  bool of_stress;

  /// Between points w and sigma^2 are linear.
  double value(const LoadedPosition& here, const LinePlace& place) const {
    const Eigen::VectorXd& values = of_stress ? here.contact_stress : here.load.line_load;
    const double first = values[place.point];
    if (place.share == 0.0) return first;
    const double next = values[place.point + 1], t = place.share;
    return of_stress ? std::sqrt((1.0 - t) * first * first + t * next * next) : (1.0 - t) * first + t * next;
  }
  Eigen::RowVectorXd slope(const LoadedPosition& here, const LinePlace& place) const {
    const Eigen::MatrixXd& slopes = of_stress ? here.contact_stress_derivative : here.line_load_derivative;
    if (place.share == 0.0) return slopes.row(place.point);
    // dsigma = sum t_i sigma_i dsigma_i / sigma
    const auto factor = [&](Eigen::Index i) { return of_stress ? here.contact_stress[i] / peak.value : 1.0; };
    return (1.0 - place.share) * factor(place.point) * slopes.row(place.point) +
           place.share * factor(place.point + 1) * slopes.row(place.point + 1);
  }
};

/// How a peak's phase moves with the axial offset [base pitches per mm]: as the event does that it lies at. Between events, where the
/// slope over the phase is zero, it may be held.
double phase_slope(const MeshModel& model, const PlacedPeak& at) {
  const double share = at.peaks.spikes.line_share;
  const std::vector<double> events = unsorted_line_events(model, share), further = unsorted_line_events(model.further.front(), share);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double distance = at.peak.phase - events[i];
    if (std::abs(distance - std::round(distance)) > 2.0 * at.peaks.phase_tolerance) continue;
    return (further[i] - events[i]) / (model.further.front().axial_offset - model.axial_offset);
  }
  return 0.0;
}

/// By the axial offset: loads solved anew where the peak is with the wheel further along, as lines begin and end elsewhere then.
/// @param model  at the peak
double offset_slope(const MeshModel& model, const PlacedPeak& at) {
  const double by_phase = phase_slope(model, at), step = model.further.front().axial_offset - model.axial_offset;
  const auto phase = [&](int steps) { return at.peak.phase + steps * step * by_phase; };
  const MeshModel mesh = at.mesh_at({phase(0), phase(1), phase(2)});
  const LinePlace place = place_on_line(mesh, mesh.positions.front(), at.peak.tooth, at.peak.z);
  if (place.point < 0) return not_given;
  std::array<double, 3> values{};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const MeshModel& moved = k == 0 ? mesh : mesh.further[k - 1];
    FlankCondition condition = at.condition;
    condition.misalignment.axial_offset = moved.axial_offset;
    const LoadedCycle cycle = analyse_cycle(moved, condition, at.torque);
    if (!cycle.usable()) return not_given;
    // A cut between points lies at a phase of its own, and moves along the line with that.
    const double cut = at.peak.z - (place.share == 0.0 ? 0.0 : (phase(static_cast<int>(k)) - phase(0)) / PathOfContact(mesh.pair).slope);
    const LinePlace there = place.share == 0.0 ? LinePlace{same_points(mesh.positions[0], moved.positions[k])[static_cast<std::size_t>(place.point)]}
                                               : place_on_line(moved, moved.positions[k], at.peak.tooth, cut);
    if (there.point < 0) return not_given;
    values[k] = at.value(cycle.positions[k], there);
  }
  return first_slope(values[0], values[1], values[2], step);
}

/// Derivative at the peak's place; empty where there is none.
Eigen::RowVectorXd gradient(const PlacedPeak& at, const std::vector<MeshParameter>& parameters) {
  if (std::isnan(at.peak.value)) return {};
  const MeshModel model = at.mesh_at({at.peak.phase});
  const LoadedCycle cycle = analyse_cycle(model, at.condition, at.torque, parameters);
  if (!cycle.usable()) return {};
  const LinePlace place = place_on_line(model, model.positions.front(), at.peak.tooth, at.peak.z);
  if (place.point < 0) return {};
  Eigen::RowVectorXd slopes = at.slope(cycle.positions.front(), place);
  for (const Eigen::Index p : axial_offsets_among(parameters)) slopes[p] = offset_slope(model, at);
  return slopes;
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
    return PeakGradients::Pair{gradient({mesh_at, condition, pinion_torque, peaks, of.contact_stress, true}, parameters),
                               gradient({mesh_at, condition, pinion_torque, peaks, of.line_load, false}, parameters)};
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
