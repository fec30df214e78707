#include "optimize/scene_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/load/cycle_gradient.hpp"

namespace flankwright {

namespace {

const LoadedPosition& at(const LoadedCycle& cycle, int position) { return cycle.positions[static_cast<std::size_t>(position)]; }

bool has_derivatives(const LoadedCycle& cycle) { return cycle.positions.front().transmission_error_derivative.size() > 0; }

SmoothValue harmonic(const LoadedCycle& cycle, int order) {
  const TeHarmonic found = te_harmonic(cycle, order);
  return {found.amplitude, found.derivative.transpose()};
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
    default: return position.line_load_derivative.row(candidate.other);
  }
}

bool is_pointwise(Output output) {
  return output == Output::PeakContactStress || output == Output::LoadFactor || output == Output::PeakLineLoad ||
         output == Output::PeakRootStress;
}

/// Value at every contact point, or place on the fillets, of a position for a pointwise output.
Eigen::VectorXd point_values(Output output, const LoadedPosition& position, double mean_load) {
  if (output == Output::PeakContactStress) return position.contact_stress;
  if (output == Output::PeakRootStress) return position.root_stress;
  return output == Output::LoadFactor ? Eigen::VectorXd(position.load.line_load / mean_load) : position.load.line_load;
}

struct Ranked {
  double value;
  PeakCandidate candidate;
};

std::vector<Ranked> rank(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle, double margin) {
  if (!cycle.usable()) throw std::runtime_error("the load distribution did not converge at every mesh position");
  const int positions = static_cast<int>(cycle.positions.size());
  std::vector<Ranked> ranked;
  if (term.output == Output::TeHarmonic) {
    ranked.push_back({harmonic(cycle, term.harmonic).value, {}});
    return ranked;
  }
  if (is_pointwise(term.output)) {
    const double mean_load = model.mean_line_load(cycle.force);
    for (int i = 0; i < positions; ++i) {
      const Eigen::VectorXd values = point_values(term.output, at(cycle, i), mean_load);
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

std::vector<PeakCandidate> leading_candidates(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle,
                                              double margin, std::size_t most) {
  const std::vector<Ranked> ranked = rank(term, model, cycle, margin);
  std::vector<PeakCandidate> leading;
  for (const Ranked& r : ranked) {
    if (leading.size() == most || r.value < (1.0 - margin) * ranked.front().value) break;
    leading.push_back(r.candidate);
  }
  return leading;
}

SmoothValue candidate_value(const ObjectiveTerm& term, const PeakCandidate& candidate, const MeshModel& model,
                            const LoadedCycle& cycle) {
  if (!cycle.usable()) throw std::runtime_error("the load distribution did not converge at every mesh position");
  if (term.output == Output::TeHarmonic) return harmonic(cycle, term.harmonic);
  const LoadedPosition& position = at(cycle, candidate.position);
  SmoothValue result;
  if (is_pointwise(term.output)) {
    const double mean_load = term.output == Output::LoadFactor ? model.mean_line_load(cycle.force) : 1.0;
    result.value = point_values(term.output, position, mean_load)[candidate.other];
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
