#include "optimize/design/outputs/scene_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <stdexcept>

#include "core/fidelity/cycle_quantities.hpp"

namespace flankwright {

namespace {

const LoadedPosition& position_at(const LoadedCycle& cycle, int position) { return cycle.positions[static_cast<std::size_t>(position)]; }

bool has_derivatives(const LoadedCycle& cycle) { return cycle.positions.front().transmission_error_derivative.size() > 0; }

struct Ranked {
  double value;
  PeakCandidate candidate;
};

void check_usable(const ObjectiveTerm& term, const LoadedScene& scene) {
  const bool all_cases = design_output(term.output).over_spectrum;
  const bool usable =
      scene.cycle.usable() && (!all_cases || std::ranges::all_of(scene.spectrum, [](const SpectrumCase& c) { return c.cycle->usable(); }));
  if (!usable) throw std::runtime_error("the load distribution did not converge at every mesh position");
}

/// Of the output itself, where a term means its reciprocal.
double own_value(const ObjectiveTerm& term, const LoadedScene& scene) {
  check_usable(term, scene);
  const DesignOutput& row = design_output(term.output);
  if (row.smooth != nullptr) return row.smooth(term, scene.model, scene.cycle, -1).value;
  if (row.candidates != nullptr) {
    const auto values = row.candidates(term, scene) | std::views::values;
    return row.is_least ? std::ranges::min(values) : std::ranges::max(values);
  }
  if (row.at_points == nullptr) {
    const Eigen::VectorXd te = scene.cycle.transmission_error();
    return te.maxCoeff() - te.minCoeff();
  }
  double value = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::ssize(scene.cycle.positions); ++i) value = std::max(value, row.at_points(term, scene.model, scene.cycle, i).maxCoeff());
  return value;
}

/// Candidates within a relative margin of an output's value, the leading one first.
std::vector<Ranked> rank(const ObjectiveTerm& term, const LoadedScene& scene, double margin) {
  const double value = own_value(term, scene);
  const MeshModel& model = scene.model;
  const LoadedCycle& cycle = scene.cycle;
  const DesignOutput& row = design_output(term.output);
  if (row.smooth != nullptr) return {{value, whole_output}};
  const int positions = static_cast<int>(cycle.positions.size());
  const double sign = row.is_least ? -1.0 : 1.0, least = sign * (1.0 - std::copysign(margin, sign * value)) * value;
  std::vector<Ranked> ranked;
  const auto add = [&](double candidate_value, const PeakCandidate& candidate) {
    if (!(sign * candidate_value < least)) ranked.push_back({candidate_value, candidate});
  };
  if (row.candidates != nullptr) {
    for (const auto& [candidate, candidate_value] : row.candidates(term, scene)) add(candidate_value, candidate);
  } else if (row.at_points != nullptr) {
    for (int i = 0; i < positions; ++i) {
      const Eigen::VectorXd values = row.at_points(term, model, cycle, i);
      for (int j = 0; j < values.size(); ++j) add(values[j], {i, j});
    }
  } else {
    // Differences between positions near the top and near the bottom.
    const Eigen::VectorXd te = cycle.transmission_error();
    for (int i = 0; i < positions; ++i) {
      for (int j = 0; j < positions; ++j) {
        if (i != j || positions == 1) add(te[i] - te[j], {i, j});
      }
    }
  }
  std::sort(ranked.begin(), ranked.end(),
            [sign](const Ranked& a, const Ranked& b) { return a.value != b.value ? sign * a.value > sign * b.value : a.candidate < b.candidate; });
  return ranked;
}

}  // namespace

double output_value(const ObjectiveTerm& term, const LoadedScene& scene) {
  const double value = own_value(term, scene);
  return term.reciprocal ? 1.0 / value : value;
}

std::optional<LoadedScene> between_positions(const ObjectiveTerm& term, const LoadedScene& scene, const ResolvedCycle& resolved) {
  const DesignOutput& row = design_output(term.output);
  if (!row.needs_oil || !resolved.extreme_mesh || !resolved.extreme_cycle.usable()) return std::nullopt;
  const LoadedScene between{*resolved.extreme_mesh, resolved.extreme_cycle, scene.operation, scene.life};
  const double there = own_value(term, between), at_positions = own_value(term, scene);
  if (row.is_least ? !(there < at_positions) : !(there > at_positions)) return std::nullopt;
  return between;
}

ResolvedValue resolved_value(const ObjectiveTerm& term, const LoadedScene& scene, const ResolvedCycle& resolved) {
  if (term.reciprocal) {
    ObjectiveTerm own = term;
    own.reciprocal = false;
    const ResolvedValue of_own = resolved_value(own, scene, resolved);
    return {1.0 / of_own.value, of_own.error / (of_own.value * of_own.value)};
  }
  if (const std::optional<Output>& other = design_output(term.output).rises_with) {
    const ObjectiveTerm peak{.output = *other, .name = {}};
    const double at_positions = output_value(peak, scene), value = output_value(term, scene);
    const ResolvedValue resolved_peak = resolved_value(peak, scene, resolved);
    return {value * resolved_peak.value / at_positions, value * resolved_peak.error / at_positions};
  }
  const CycleEntry entry = find_cycle_entry(term.own_name());
  ResolvedValue found;
  if (entry.quantity != nullptr) {
    found.value = entry.of(entry.quantity->values(resolved.summary));
    if (entry.quantity->errors != nullptr) found.error = entry.of(entry.quantity->errors(resolved.errors, resolved.summary));
  }
  if (!std::isnan(found.value)) return found;
  const std::optional<LoadedScene> between = between_positions(term, scene, resolved);
  found.value = output_value(term, between ? *between : scene);
  return found;
}

std::vector<PeakCandidate> leading_candidates(const ObjectiveTerm& term, const LoadedScene& scene, double margin, std::size_t most) {
  std::vector<PeakCandidate> leading;
  if (design_output(term.output).has_orders && margin > 0.0) {
    for (int direction = 0; direction < harmonic_directions; ++direction) leading.push_back({-1, direction});
    return leading;
  }
  // 1/u_j >= (1 - margin) / u where u_j <= (1 + margin / (1 - margin)) u.
  for (const Ranked& r : rank(term, scene, term.reciprocal ? margin / (1.0 - margin) : margin)) {
    if (leading.size() == most) break;
    leading.push_back(r.candidate);
  }
  return leading;
}

PeakCandidate counterpart(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const DesignOutput& row = design_output(term.output);
  if (row.at_points == nullptr && row.candidates == nullptr) return candidate;
  constexpr double near = 0.2;
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  const std::vector<PeakCandidate> leading = leading_candidates(term, scene, near, all);
  const auto same = std::ranges::find(leading, candidate.position, &PeakCandidate::position);
  return same == leading.end() ? leading.front() : *same;
}

SmoothValue candidate_value(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  check_usable(term, scene);
  if (term.reciprocal) {
    ObjectiveTerm own = term;
    own.reciprocal = false;
    SmoothValue value = candidate_value(own, candidate, scene);
    value.gradient /= -value.value * value.value;
    value.value = 1.0 / value.value;
    return value;
  }
  const MeshModel& model = scene.model;
  const LoadedCycle& cycle = scene.cycle;
  const DesignOutput& row = design_output(term.output);
  if (row.candidate != nullptr) return row.candidate(term, candidate, scene);
  if (row.smooth != nullptr) return row.smooth(term, model, cycle, candidate.other);
  const LoadedPosition& position = position_at(cycle, candidate.position);
  SmoothValue result;
  if (row.at_points != nullptr) {
    result.value = row.at_points(term, model, cycle, candidate.position)[candidate.other];
    if (has_derivatives(cycle)) result.gradient = row.point_derivative(term, candidate, model, cycle).transpose();
    return result;
  }
  const LoadedPosition& other = position_at(cycle, candidate.other);
  result.value = position.load.transmission_error - other.load.transmission_error;
  if (has_derivatives(cycle)) {
    result.gradient = (position.transmission_error_derivative - other.transmission_error_derivative).transpose();
  }
  return result;
}

}  // namespace flankwright
