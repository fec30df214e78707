#include "optimize/design/scene_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <stdexcept>

#include "core/load/cycle/cycle_gradient.hpp"

namespace flankwright {

namespace {

const LoadedPosition& at(const LoadedCycle& cycle, int position) { return cycle.positions[static_cast<std::size_t>(position)]; }

bool has_derivatives(const LoadedCycle& cycle) { return cycle.positions.front().transmission_error_derivative.size() > 0; }

/// The amplitude, or the phasor's projection onto a direction.
SmoothValue harmonic(const LoadedCycle& cycle, int order, int direction) {
  const TeHarmonic found = te_harmonic(cycle, order);
  if (direction < 0) return {found.amplitude, found.derivative.transpose()};
  const std::complex<double> turn = std::polar(1.0, -2.0 * units::pi * direction / harmonic_directions);
  return {(turn * found.phasor).real(), (turn * found.phasor_derivative).real().transpose()};
}

/// Mean over the positions of 1 / sum_k s_k^2 with the shares s_k of the tooth pairs, and its derivative.
SmoothValue effective_contact_ratio(const MeshModel& model, const LoadedCycle& cycle) {
  const auto n = static_cast<double>(cycle.positions.size());
  const Eigen::Index m = cycle.positions.front().line_load_derivative.cols();
  SmoothValue mean{0.0, Eigen::VectorXd::Zero(m)};
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const MeshPosition& place = model.positions[i];
    const LoadedPosition& position = cycle.positions[i];
    std::map<int, SmoothValue> shares;
    for (Eigen::Index j = 0; j < place.weight.size(); ++j) {
      SmoothValue& share = shares.try_emplace(place.points[static_cast<std::size_t>(j)].tooth, SmoothValue{0.0, Eigen::VectorXd::Zero(m)})
                               .first->second;
      share.value += place.weight[j] * position.load.line_load[j] / cycle.force;
      if (m > 0) share.gradient += place.weight[j] / cycle.force * position.line_load_derivative.row(j).transpose();
    }
    double squares = 0.0;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(m);
    for (const auto& [tooth, share] : shares) {
      squares += share.value * share.value;
      slope += 2.0 * share.value * share.gradient;
    }
    mean.value += 1.0 / (squares * n);
    mean.gradient -= slope / (squares * squares * n);
  }
  return mean;
}

SmoothValue smooth_output(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle, int direction) {
  return term.output == Output::TeHarmonic ? harmonic(cycle, term.harmonic, direction) : effective_contact_ratio(model, cycle);
}

bool is_smooth(Output output) { return output == Output::TeHarmonic || output == Output::EffectiveContactRatio; }

/// Whether a contact point lies within a share of the face's ends or of either gear's tip.
bool is_near_edge(const MeshModel& model, const ContactPoint& point, double margin) {
  const auto near_tip = [&](Member member, double radius) {
    const Gear& gear = model.pair[member];
    return radius > gear.tip_radius - margin * (gear.tip_radius - gear.active_root_radius);
  };
  const double inset = margin * model.face_width;
  return point.z < model.face_start() + inset || point.z > model.face_end() - inset ||
         near_tip(Member::Pinion, point.pinion_radius) || near_tip(Member::Wheel, point.wheel_radius);
}

/// Derivatives of point_values() at one point.
Eigen::RowVectorXd point_derivative(const ObjectiveTerm& term, const PeakCandidate& candidate, const MeshModel& model,
                                    const LoadedCycle& cycle) {
  const LoadedPosition& position = at(cycle, candidate.position);
  switch (term.output) {
    case Output::PeakContactStress: return position.contact_stress_derivative.row(candidate.other);
    case Output::PeakRootStress:
      return root_stress_derivative(model.positions[static_cast<std::size_t>(candidate.position)], position, candidate.other);
    case Output::LoadFactor: return load_factor_derivative(model, cycle, candidate.position, candidate.other);
    case Output::EdgeLoad: {
      const ContactPoint& point = model.positions[static_cast<std::size_t>(candidate.position)].points[static_cast<std::size_t>(candidate.other)];
      if (is_near_edge(model, point, term.edge_margin)) return position.line_load_derivative.row(candidate.other);
      return Eigen::RowVectorXd::Zero(position.line_load_derivative.cols());
    }
    default: return position.line_load_derivative.row(candidate.other);
  }
}

bool is_pointwise(Output output) {
  return output == Output::PeakContactStress || output == Output::LoadFactor || output == Output::PeakLineLoad ||
         output == Output::PeakRootStress || output == Output::EdgeLoad;
}

/// Value at every contact point, or place on the fillets, of a position for a pointwise output.
Eigen::VectorXd point_values(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle, int index) {
  const LoadedPosition& position = at(cycle, index);
  if (term.output == Output::PeakContactStress) return position.contact_stress;
  if (term.output == Output::PeakRootStress) {
    const bool is_there = position.root_stress.size() > 0;  // else of a goal that the analysis was not made for
    return is_there ? position.root_stress : root_stresses(model.positions[static_cast<std::size_t>(index)], position.load);
  }
  Eigen::VectorXd loads = position.load.line_load;
  if (term.output == Output::LoadFactor) loads /= model.mean_line_load(cycle.force);
  if (term.output == Output::EdgeLoad) {
    const std::vector<ContactPoint>& points = model.positions[static_cast<std::size_t>(index)].points;
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (!is_near_edge(model, points[j], term.edge_margin)) loads[static_cast<Eigen::Index>(j)] = 0.0;
    }
  }
  return loads;
}

struct Ranked {
  double value;
  PeakCandidate candidate;
};

std::vector<Ranked> rank(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle, double margin) {
  if (!cycle.usable()) throw std::runtime_error("the load distribution did not converge at every mesh position");
  const int positions = static_cast<int>(cycle.positions.size());
  std::vector<Ranked> ranked;
  if (is_smooth(term.output)) {
    ranked.push_back({smooth_output(term, model, cycle, -1).value, whole_output});
    return ranked;
  }
  if (is_pointwise(term.output)) {
    for (int i = 0; i < positions; ++i) {
      const Eigen::VectorXd values = point_values(term, model, cycle, i);
      for (int j = 0; j < values.size(); ++j) ranked.push_back({values[j], {i, j}});
    }
  } else {
    // Differences between positions near the top and near the bottom.
    const Eigen::VectorXd te = cycle.transmission_error();
    const double span = te.maxCoeff() - te.minCoeff();
    for (int i = 0; i < positions; ++i) {
      if (te[i] < te.maxCoeff() - margin * span) continue;
      for (int j = 0; j < positions; ++j) {
        if (i != j || positions == 1) ranked.push_back({te[i] - te[j], {i, j}});
      }
    }
  }
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.value != b.value ? a.value > b.value : a.candidate < b.candidate;
  });
  return ranked;
}

}  // namespace

double output_value(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle) {
  return rank(term, model, cycle, 0.0).front().value;
}

ResolvedValue resolved_value(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle, const ResolvedCycle& resolved) {
  const CycleSummary& summary = resolved.summary;
  const CycleErrors& errors = resolved.errors;
  const auto order = static_cast<std::size_t>(std::max(term.harmonic, 1) - 1);
  switch (term.output) {
    case Output::PeakContactStress: return {summary.peak_contact_stress, errors.peak_contact_stress};
    case Output::TePeakToPeak: return {summary.te_peak_to_peak, errors.te_peak_to_peak};
    case Output::LoadFactor: return {summary.load_factor, errors.load_factor};
    case Output::PeakLineLoad: return {summary.peak_line_load, errors.peak_line_load};
    case Output::TeHarmonic:
      if (order < summary.te_harmonics.size()) {
        return {summary.te_harmonics[order], order < errors.te_harmonics.size() ? errors.te_harmonics[order] : not_given};
      }
      break;
    case Output::PeakRootStress: return {output_value(term, model, cycle), errors.peak_root_stress};
    case Output::EffectiveContactRatio:
    case Output::EdgeLoad: break;
  }
  return {output_value(term, model, cycle), not_given};
}

std::vector<PeakCandidate> leading_candidates(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle,
                                              double margin, std::size_t most) {
  std::vector<PeakCandidate> leading;
  if (term.output == Output::TeHarmonic && margin > 0.0) {
    for (int direction = 0; direction < harmonic_directions; ++direction) leading.push_back({-1, direction});
    return leading;
  }
  const std::vector<Ranked> ranked = rank(term, model, cycle, margin);
  for (const Ranked& r : ranked) {
    if (leading.size() == most || r.value < (1.0 - margin) * ranked.front().value) break;
    leading.push_back(r.candidate);
  }
  return leading;
}

SmoothValue candidate_value(const ObjectiveTerm& term, const PeakCandidate& candidate, const MeshModel& model,
                            const LoadedCycle& cycle) {
  if (!cycle.usable()) throw std::runtime_error("the load distribution did not converge at every mesh position");
  if (is_smooth(term.output)) return smooth_output(term, model, cycle, candidate.other);
  const LoadedPosition& position = at(cycle, candidate.position);
  SmoothValue result;
  if (is_pointwise(term.output)) {
    result.value = point_values(term, model, cycle, candidate.position)[candidate.other];
    if (has_derivatives(cycle)) result.gradient = point_derivative(term, candidate, model, cycle).transpose();
    return result;
  }
  const LoadedPosition& other = at(cycle, candidate.other);
  result.value = position.load.transmission_error - other.load.transmission_error;
  if (has_derivatives(cycle)) {
    result.gradient = (position.transmission_error_derivative - other.transmission_error_derivative).transpose();
  }
  return result;
}

}  // namespace flankwright
