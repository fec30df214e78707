#include "core/rating/peak_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/load/cycle/mesh_motion.hpp"
#include "core/rating/line_region.hpp"

namespace flankwright {

namespace {

/// A station on a line: a point of it, or a fraction of the way to the next.
struct LineStation {
  Eigen::Index point{-1};  ///< -1: the line has no such station
  double share{0.0};
};

/// @param z  [mm]
LineStation station_on_line(const MeshModel& model, const MeshPosition& at, int tooth, double z) {
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
};

/// Slope of a peak's phase with the axial offset [base pitches per mm] where a point at a fixed position along the face
/// reaches or leaves A0, A, E or B0 there; nothing where none does. Both sides are tried, as on one it may not exist.
std::optional<double> phase_slope_of_points(const PlacedPeak& at) {
  const double near = 2.0 * at.peaks.phase_tolerance;
  const MeshModel model = at.mesh_at({at.peak.phase - near, at.peak.phase + near});
  const PerturbedMeshes& perturbed = perturbed_meshes(model, &Misalignment::axial_offset);
  const LineRegion region(model);
  for (std::size_t p = 0; p < model.positions.size(); ++p) {
    const std::vector<ContactPoint>&points = model.positions[p].points, &moved = perturbed.meshes[0].positions[p].points;
    const std::vector<Eigen::Index> same = same_points(model.positions[p], perturbed.meshes[0].positions[p]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto passes = [&](double mark) { return std::abs(points[i].phase - mark) <= 2.0 * near; };
      if (same[i] < 0 || !(passes(0.0) || passes(region.first) || passes(region.last) || passes(region.path.region_length))) continue;
      return (points[i].phase - moved[static_cast<std::size_t>(same[i])].phase) / perturbed.step;
    }
  }
  return std::nullopt;
}

/// Slope of a peak's phase with the axial offset [base pitches per mm]: that of its event. Between events, where the
/// slope over the phase is zero, it may be held.
double phase_slope(const MeshModel& model, const PerturbedMeshes& perturbed, const PlacedPeak& at) {
  const double share = at.peaks.spikes.line_share;
  const std::vector<double> events = unsorted_line_events(model, share), moved = unsorted_line_events(perturbed.meshes[0], share);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double distance = at.peak.phase - events[i];
    if (std::abs(distance - std::round(distance)) > 2.0 * at.peaks.phase_tolerance) continue;
    return (moved[i] - events[i]) / perturbed.step;
  }
  return phase_slope_of_points(at).value_or(0.0);
}

/// The mesh at the peak. With a perturbed axial offset it has the phase that the peak then has. No other parameter
/// moves the ends of a line.
MeshModel mesh_along(const PlacedPeak& at, const std::vector<MeshParameter>& parameters) {
  MeshModel held = at.mesh_at({at.peak.phase});
  constexpr MisalignmentParameter offset = &Misalignment::axial_offset;
  const auto is_offset = [](const MeshParameter& p) {
    return std::holds_alternative<MisalignmentParameter>(p) && std::get<MisalignmentParameter>(p) == offset;
  };
  const auto of_offset = std::ranges::find(held.perturbed, offset, &PerturbedMeshes::parameter);
  if (std::ranges::none_of(parameters, is_offset) || of_offset == held.perturbed.end()) return held;
  const double by_phase = phase_slope(held, *of_offset, at), step = of_offset->step;
  if (by_phase == 0.0) return held;
  const MeshModel along = at.mesh_at({at.peak.phase + step * by_phase, at.peak.phase + 2.0 * step * by_phase});
  const PerturbedMeshes& moved = perturbed_meshes(along, &Misalignment::axial_offset);
  for (std::size_t k = 0; k < moved.meshes.size(); ++k) of_offset->meshes[k].positions = {moved.meshes[k].positions[k]};
  return held;
}

/// Slope of a station's fraction with a parameter [1 per unit]: a cut between points lies at a phase of its own, and
/// moves along the line with that. NaN where it passes a point.
double share_slope(const MeshModel& model, const PerturbedMeshes& perturbed, std::size_t position, int tooth, const LineStation& station) {
  if (station.share == 0.0) return 0.0;
  const MeshPosition& at = model.positions[position];
  const auto first = static_cast<std::size_t>(station.point);
  const double cut = (1.0 - station.share) * at.points[first].z + station.share * at.points[first + 1].z;
  std::array<double, 2> shares{};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const MeshPosition& there = perturbed.meshes[k].positions[position];
    const double moved = cut - (there.phase - at.phase) / PathOfContact(model.pair).slope;
    const LineStation moved_station = station_on_line(perturbed.meshes[k], there, tooth, moved);
    if (moved_station.point != same_points(at, there)[first]) return not_given;
    shares[k] = moved_station.share;
  }
  return forward_difference(station.share, shares[0], shares[1], perturbed.step);
}

/// The peaked quantity at a station of a position, and its derivatives there.
struct Reading {
  double value;
  Eigen::RowVectorXd slopes;
};
/// @param station  known
Reading read(const PlacedPeak& at, const MeshModel& model, const LoadedCycle& cycle, std::size_t position, const LineStation& station,
             const std::vector<MeshParameter>& parameters) {
  const LoadedPosition& here = cycle.positions[position];
  const Eigen::VectorXd& values = at.of_stress ? here.contact_stress : here.peak_load;
  const Eigen::MatrixXd& slopes = at.of_stress ? here.contact_stress_derivative : here.peak_load_derivative;
  const double first = values[station.point];
  if (station.share == 0.0) return {first, slopes.row(station.point)};
  // Between points w and sigma^2 are linear: sigma^n = (1 - t) sigma_0^n + t sigma_1^n.
  const double next = values[station.point + 1], t = station.share, n = at.of_stress ? 2.0 : 1.0;
  const double value = std::pow((1.0 - t) * std::pow(first, n) + t * std::pow(next, n), 1.0 / n), mean = std::pow(value, n - 1.0);
  Reading reading{
      value, ((1.0 - t) * std::pow(first, n - 1.0) * slopes.row(station.point) + t * std::pow(next, n - 1.0) * slopes.row(station.point + 1)) / mean};
  for (const Eigen::Index p : moving_among(model.placement.gap, parameters)) {
    const PerturbedMeshes& perturbed = perturbed_meshes(model, std::get<MisalignmentParameter>(parameters[static_cast<std::size_t>(p)]));
    reading.slopes[p] += share_slope(model, perturbed, position, at.peak.tooth, station) * (std::pow(next, n) - std::pow(first, n)) / (n * mean);
  }
  return reading;
}

/// At the peak itself, which moves with its event under an axial offset; empty where the mesh has no such station.
Eigen::RowVectorXd held_gradient(const PlacedPeak& at, const std::vector<MeshParameter>& parameters) {
  const MeshModel model = mesh_along(at, parameters);
  const LineStation station = station_on_line(model, model.positions.front(), at.peak.tooth, at.peak.z);
  const LoadedCycle cycle = analyse_cycle(model, at.condition, at.torque, parameters);
  if (!cycle.usable() || station.point < 0) return {};
  return read(at, model, cycle, 0, station, parameters).slopes;
}

/// For a peak that is continuous over the phase: the mean of both its sides in which the slope over the phase vanishes.
/// Nothing where it is not continuous: the station is missing on one side, or the quantity jumps.
std::optional<Eigen::RowVectorXd> gradient_of_sides(const PlacedPeak& at, const std::vector<MeshParameter>& parameters) {
  const double d = 2.0 * at.peaks.phase_tolerance;  // the maximum lies nearer
  const std::array<double, 4> away{-2.0 * d, -d, d, 2.0 * d};
  std::vector<double> phases{at.peak.phase};
  for (const double by : away) phases.push_back(at.peak.phase + by);
  const MeshModel model = at.mesh_at(phases);
  const LoadedCycle cycle = analyse_cycle(model, at.condition, at.torque, parameters);
  const LineStation station = station_on_line(model, model.positions.front(), at.peak.tooth, at.peak.z);
  if (!cycle.usable() || station.point < 0) return std::nullopt;
  std::vector<Reading> sides;
  for (std::size_t k = 0; k < away.size(); ++k) {
    const MeshPosition& there = model.positions[k + 1];
    const LineStation same = station.share == 0.0
                                 ? LineStation{same_points(model.positions.front(), there)[static_cast<std::size_t>(station.point)]}
                                 : station_on_line(model, there, at.peak.tooth, at.peak.z - away[k] / PathOfContact(model.pair).slope);
    if (same.point < 0) return std::nullopt;
    sides.push_back(read(at, model, cycle, k + 1, same, parameters));
  }
  const double rise = (sides[1].value - sides[0].value) / d, fall = (sides[2].value - sides[3].value) / d;
  const double jump = std::abs((sides[1].value + rise * d) - (sides[2].value + fall * d));
  if (!(rise > 0.0 && fall > 0.0) || jump > 2.0 * d * (rise + fall)) return std::nullopt;
  const Eigen::RowVectorXd before = 2.0 * sides[1].slopes - sides[0].slopes, after = 2.0 * sides[2].slopes - sides[3].slopes;  // at the peak
  return (fall * before + rise * after) / (rise + fall);
}

/// Empty where there is none.
Eigen::RowVectorXd gradient(const PlacedPeak& at, const std::vector<MeshParameter>& parameters) {
  if (std::isnan(at.peak.value)) return {};
  const std::optional<Eigen::RowVectorXd> of_sides = gradient_of_sides(at, parameters);
  return of_sides ? *of_sides : held_gradient(at, parameters);
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

PeakGradients peak_gradients_of_part(const MeshAt& mesh_at, const FlankCondition& condition, ConditionPart part, double pinion_torque,
                                     const ContactPeaks& peaks, const std::vector<MeshParameter>& parameters, double opening_per_torque) {
  std::vector<MeshParameter> acting;
  std::vector<Eigen::Index> column;
  Eigen::Index torque = -1;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (!acts(parameters[p], part)) continue;
    if (std::holds_alternative<PinionTorque>(parameters[p])) torque = static_cast<Eigen::Index>(p);
    acting.push_back(parameters[p]);
    column.push_back(static_cast<Eigen::Index>(p));
  }
  // With the torque the misalignment grows that a part without the tilt of its rims is set against.
  const bool is_set_against_rims = opening_per_torque != 0.0 && !shafts_deflect(part) && torque >= 0;
  if (is_set_against_rims) acting.push_back(&Misalignment::mesh_misalignment);
  const FlankCondition of_part = part_without_rims(condition, part, opening_per_torque * pinion_torque);
  PeakGradients gradients = peak_gradients(mesh_at, of_part, pinion_torque, peaks, acting);
  for (PeakGradients::Pair* pair : {&gradients.with_spikes, &gradients.without_spikes}) {
    for (Eigen::RowVectorXd* row : {&pair->contact_stress, &pair->line_load}) {
      if (row->size() != std::ssize(acting)) continue;  // no peak
      Eigen::RowVectorXd all = Eigen::RowVectorXd::Zero(std::ssize(parameters));
      for (std::size_t k = 0; k < column.size(); ++k) all[column[k]] = (*row)[static_cast<Eigen::Index>(k)];
      if (is_set_against_rims) all[torque] -= opening_per_torque * row->tail<1>()[0];
      *row = all;
    }
  }
  return gradients;
}

LoadFactorGradients load_factor_gradients(const RatedPeaks& perfect, const RatedPeaks& lead, const RatedPeaks& profile, const RatedPeaks& combined) {
  const LoadFactors factors = load_factors(perfect.peaks, lead.peaks, profile.peaks, combined.peaks);
  const auto triple = [&](const LoadFactors::Triple& value, auto pair, auto slopes, auto of, auto slope_of, double power) {
    const auto relative = [&](const RatedPeaks& rated) -> Eigen::RowVectorXd {
      return rated.gradients.*slopes.*slope_of / (rated.peaks.*pair.*of).value;
    };
    const Eigen::RowVectorXd base = relative(perfect);
    const auto change = [&](double factor, const RatedPeaks& rated) -> Eigen::RowVectorXd {
      const Eigen::RowVectorXd slope = relative(rated);
      if (std::isnan(factor) || slope.size() == 0 || slope.size() != base.size()) return {};
      return power * factor * (slope - base);
    };
    const Eigen::RowVectorXd by_lead = change(value.lead, lead), by_profile = change(value.profile, profile);
    const bool has_both = by_lead.size() > 0 && by_profile.size() > 0;
    return LoadFactorGradients::Triple{by_lead, by_profile, change(value.combined, combined),
                                       has_both ? Eigen::RowVectorXd(by_lead * value.profile + value.lead * by_profile) : Eigen::RowVectorXd()};
  };
  const auto by_stress = [&](const LoadFactors::Triple& value, auto pair, auto slopes) {
    return triple(value, pair, slopes, &ContactPeaks::Pair::contact_stress, &PeakGradients::Pair::contact_stress, 2.0);
  };
  return {by_stress(factors.without_spikes, &ContactPeaks::without_spikes, &PeakGradients::without_spikes),
          by_stress(factors.with_spikes, &ContactPeaks::with_spikes, &PeakGradients::with_spikes),
          triple(factors.line_load, &ContactPeaks::without_spikes, &PeakGradients::without_spikes, &ContactPeaks::Pair::line_load,
                 &PeakGradients::Pair::line_load, 1.0)};
}

}  // namespace flankwright
