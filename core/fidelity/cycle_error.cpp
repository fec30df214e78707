#include "core/fidelity/cycle_error.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/contact/unloaded/transmission_error.hpp"

namespace flankwright {

namespace {

// Shares of a difference that are called an error, see estimate_errors().
constexpr double of_mean = 1.0 / 2.0, of_shape = 1.0 / 3.0, of_harmonics = 1.0 / 2.0, of_peaks = 1.0, of_root_stress = 1.0 / 2.0,
                 of_positions = 1.0 / 3.0, of_positions_beside_jump = 1.0;
/// Share of an estimate for order two that is taken for order one, see point_errors_beside_finer().
constexpr double of_order_one = 2.0;
/// Positions whose peak is within this fraction of the cycle's count for the error of the peak.
constexpr double near_peak = 0.1;
/// The neighbourhood of a position reaches this part of the cycle to either side, one position at least.
constexpr std::size_t neighbourhoods = 16;
/// Of phases [base pitches], sums of a few numbers near 1.
constexpr double round_off = 1e-9;
constexpr double infinity = std::numeric_limits<double>::infinity();

double mean_of(const std::vector<double>& samples) {
  double sum = 0.0;
  for (const double s : samples) sum += s;
  return sum / static_cast<double>(samples.size());
}

std::vector<double> every(const std::vector<double>& samples, std::size_t stride) {
  std::vector<double> some;
  for (std::size_t i = 0; i < samples.size(); i += stride) some.push_back(samples[i]);
  return some;
}

/// A reading of every position.
std::vector<double> curve(const LoadedCycle& cycle, const auto& reading) {
  std::vector<double> values;
  for (const LoadedPosition& position : cycle.positions) values.push_back(reading(position));
  return values;
}

/// A reading of the fine and of the coarse cycle at one phase [base pitches].
struct Sample {
  double phase, fine, coarse;
};

/// @param fine, coarse  at the same evenly spaced phases over one base pitch
std::vector<Sample> evenly_spaced(const std::vector<double>& fine, const std::vector<double>& coarse) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < coarse.size(); ++i)
    samples.push_back({static_cast<double>(i) / static_cast<double>(coarse.size()), fine[i], coarse[i]});
  return samples;
}

/// How far the neighbourhood of a position reaches to either side [base pitches].
/// @param n  number of positions of the coarse cycle
double neighbourhood(std::size_t n) { return static_cast<double>(std::max<std::size_t>(1, n / neighbourhoods)) / static_cast<double>(n) + round_off; }

/// Of peaks. What a point misses at one position, because a kink of the flanks lies between it and the next, it has at the positions around: the peaks of
/// neighbourhoods are compared.
/// @param reach  of these neighbourhoods [base pitches]; 0: every position counts for itself
double peak_difference(const std::vector<Sample>& samples, double reach) {
  Sample peak{0.0, -infinity, -infinity};
  for (const Sample& sample : samples) peak = {0.0, std::max(peak.fine, sample.fine), std::max(peak.coarse, sample.coarse)};
  double largest = std::abs(peak.fine - peak.coarse);
  for (const Sample& at : samples) {
    if (at.fine < (1.0 - near_peak) * peak.fine) continue;
    Sample around = at;
    for (const Sample& other : samples) {
      const double apart = std::abs(other.phase - at.phase);
      if (std::min(apart, 1.0 - apart) > reach) continue;
      around = {at.phase, std::max(around.fine, other.fine), std::max(around.coarse, other.coarse)};
    }
    largest = std::max(largest, std::abs(around.fine - around.coarse));
  }
  return largest;
}

/// Of differences at several positions, less their mean.
double rms_about_mean(const std::vector<double>& d) {
  double square = 0.0;
  for (const double value : d) square += (value - mean_of(d)) * (value - mean_of(d)) / static_cast<double>(d.size());
  return std::sqrt(square);
}

/// By points, of the mean. @param d  fine less coarse at each position of the coarse cycle
double mean_error_by_points(const std::vector<double>& d) { return of_mean * std::abs(mean_of(d)) + of_shape * rms_about_mean(d); }

/// @param share  of what leaving out every second position changes
double mean_error_by_positions(const std::vector<double>& samples, double share = of_positions) {
  const bool halved = samples.size() % 2 == 0 && samples.size() >= 8;
  const double mean_of_half = mean_of(halved ? every(samples, 2) : samples);
  const int highest_order = static_cast<int>(samples.size() - 1) / 2;
  const double highest = highest_order > 0 ? std::abs(harmonic_phasor(samples, highest_order)) : 0.0;
  return share * std::max(std::abs(mean_of(samples) - mean_of_half), highest);
}

double approach_of(const LoadedPosition& position) { return position.approach(); }
double approach_of_teeth(const LoadedPosition& position) { return position.approach_of_teeth(); }
double te_of(const LoadedPosition& position) { return position.load.transmission_error; }
double stress_of(const LoadedPosition& position) { return position.contact_stress.maxCoeff(); }
double load_of(const LoadedPosition& position) { return position.peak_load.maxCoeff(); }
double stiffness_of(const LoadedPosition& position) { return position.stiffness; }
double edge_stress_of(const LoadedPosition& position) { return position.edge_stress.size() > 0 ? position.edge_stress.maxCoeff() : not_given; }
double edge_share_of(const LoadedPosition& position) { return position.tip_edge_share; }
double root_of(const LoadedPosition& position) { return position.root_stress.size() > 0 ? position.root_stress.maxCoeff() : not_given; }

/// Error of the mean stiffness from that of the mean deflection: both are the same share of their values.
double stiffness_error(double approach_error, const LoadedCycle& cycle, const CycleSummary& summary) {
  return approach_error / mean_of(curve(cycle, approach_of)) * summary.mean_stiffness;
}

CycleErrors point_errors(const LoadedCycle& fine, const LoadedCycle& coarse, const CycleSummary& summary, const CyclesBetween& between = {}) {
  CycleErrors errors;
  const std::size_t stride = fine.positions.size() / coarse.positions.size();
  const auto some = [&](const auto& reading) { return every(curve(fine, reading), stride); };
  const auto differences = [&](const auto& reading) {
    std::vector<double> d = some(reading);
    const std::vector<double> of_coarse = curve(coarse, reading);
    for (std::size_t i = 0; i < d.size(); ++i) d[i] -= of_coarse[i];
    return d;
  };
  const std::vector<double> d = differences(te_of);
  const auto samples_of = [&](const auto& reading) {
    std::vector<Sample> samples = evenly_spaced(some(reading), curve(coarse, reading));
    if (between.fine == nullptr) return samples;
    for (std::size_t i = 0; i < between.fine->positions.size(); ++i) {
      const LoadedPosition& at = between.fine->positions[i];
      samples.push_back({at.phase, reading(at), reading(between.coarse->positions[i])});
    }
    return samples;
  };
  const auto peaks_apart = [&](const auto& reading) {
    return of_peaks * peak_difference(samples_of(reading), neighbourhood(coarse.positions.size()));
  };
  double low = infinity, high = -infinity;
  for (const Sample& te : samples_of(te_of)) {
    low = std::min(low, te.fine - te.coarse);
    high = std::max(high, te.fine - te.coarse);
  }
  const double scatter = of_harmonics * rms_about_mean(d);
  errors.te_mean = mean_error_by_points(d);
  errors.te_peak_to_peak = of_shape * (high - low);
  for (std::size_t k = 1; k <= summary.te_harmonics.size(); ++k) {
    errors.te_harmonics.push_back(of_harmonics * std::abs(harmonic_phasor(d, static_cast<int>(k))) + scatter);
  }
  errors.peak_contact_stress = peaks_apart(stress_of);
  errors.peak_line_load = peaks_apart(load_of);
  errors.load_factor = errors.peak_line_load * summary.load_factor / summary.peak_line_load;
  if (!std::isnan(summary.peak_root_stress) && coarse.positions.front().root_stress.size() > 0) {
    const std::vector<Sample> samples = evenly_spaced(some(root_of), curve(coarse, root_of));
    errors.peak_root_stress = of_root_stress * peak_difference(samples, neighbourhood(coarse.positions.size()));
  }
  if (!std::isnan(summary.edge_stress)) {
    // The highest of a few positions that an edge touches at: two resolutions may agree there by chance, and do not beside it.
    errors.edge_stress = of_peaks * peak_difference(samples_of(edge_stress_of), 0.0);
    errors.tip_edge_share = of_peaks * peak_difference(samples_of(edge_share_of), 0.0);
  }
  // The least gap, which the approach is counted from, is that of a point: order one.
  errors.mean_stiffness = stiffness_error(of_order_one * mean_error_by_points(differences(approach_of)), fine, summary);
  // Its extremes have the relative error of the mean, and between them all that the shape changes by, as peaks.
  const std::vector<double> of_stiffness = differences(stiffness_of);
  const double shape = 0.5 * of_peaks * (std::ranges::max(of_stiffness) - std::ranges::min(of_stiffness)),
               relative = errors.mean_stiffness / summary.mean_stiffness;
  errors.least_stiffness = relative * summary.least_stiffness + shape;
  errors.largest_stiffness = relative * summary.largest_stiffness + shape;
  return errors;
}

CycleErrors position_errors(const LoadedCycle& fine, const CycleSummary& summary, const CycleExtremes* extremes) {
  CycleErrors errors;
  const std::vector<double> te = curve(fine, te_of);
  const bool halved = te.size() % 2 == 0 && te.size() >= 8;
  const std::vector<double> half = halved ? every(te, 2) : te;
  const double share = fine.closes ? of_positions : of_positions_beside_jump;
  errors.te_mean = mean_error_by_positions(te, share);
  for (std::size_t k = 1; k <= summary.te_harmonics.size(); ++k) {
    // Beyond what half the positions resolve, the aliases of the orders that are.
    const bool resolved = 2 * k < half.size();
    const int order = static_cast<int>(k);
    errors.te_harmonics.push_back(share *
                                  (resolved ? std::abs(harmonic_phasor(te, order) - harmonic_phasor(half, order)) : summary.te_harmonics[k - 1]));
  }
  const auto unseen = [&](Figure figure, const std::vector<double>& samples) {
    return extremes != nullptr ? extremes->unseen[static_cast<std::size_t>(figure)] : unseen_rise(samples);
  };
  std::vector<double> turned;
  for (const double f : te) turned.push_back(-f);
  errors.te_peak_to_peak = unseen(Figure::TePeakToPeak, te) + (extremes != nullptr ? 0.0 : unseen_rise(turned));
  errors.peak_contact_stress = unseen(Figure::PeakContactStress, curve(fine, stress_of));
  errors.peak_line_load = unseen(Figure::PeakLineLoad, curve(fine, load_of));
  errors.load_factor = errors.peak_line_load * summary.load_factor / summary.peak_line_load;
  if (!std::isnan(summary.peak_root_stress)) errors.peak_root_stress = unseen_rise(curve(fine, root_of));
  if (!std::isnan(summary.edge_stress)) {
    errors.edge_stress = extremes != nullptr ? extremes->unseen_edge_stress : unseen_rise(curve(fine, edge_stress_of));
    errors.tip_edge_share = extremes != nullptr ? extremes->unseen_edge_share : unseen_rise(curve(fine, edge_share_of));
  }
  errors.mean_stiffness = stiffness_error(mean_error_by_positions(curve(fine, approach_of), share), fine, summary);
  std::vector<double> turned_stiffness;
  for (const LoadedPosition& position : fine.positions) turned_stiffness.push_back(-position.stiffness);
  const double relative = errors.mean_stiffness / summary.mean_stiffness;
  errors.least_stiffness = relative * summary.least_stiffness + unseen_rise(turned_stiffness);
  errors.largest_stiffness = relative * summary.largest_stiffness + unseen_rise(curve(fine, stiffness_of));
  return errors;
}

}  // namespace

CycleErrors CycleErrorParts::sum(const CycleSummary& summary) const {
  CycleErrors both;
  for (const auto of : CycleErrors::single()) both.*of = points.*of + positions.*of;
  for (std::size_t k = 0; k < points.te_harmonics.size(); ++k) both.te_harmonics.push_back(points.te_harmonics[k] + positions.te_harmonics[k]);
  const double edge_above = summary.edge_stress + both.edge_stress - summary.peak_contact_stress;
  if (!std::isnan(both.peak_contact_stress)) both.peak_contact_stress = std::fmax(both.peak_contact_stress, edge_above);
  return both;
}

std::vector<double> coarse_phases(const std::vector<double>& phases) {
  return phases.size() % 2 == 0 && phases.size() >= 8 ? every(phases, 2) : phases;
}

void join_edge_to_peak(const CycleSummary& summary, CycleErrors& errors) {
  if (summary.edge_stress != summary.peak_contact_stress) return;
  errors.edge_stress = errors.peak_contact_stress = std::fmax(errors.edge_stress, errors.peak_contact_stress);
}

CycleErrorParts estimate_errors(const LoadedCycle& fine, const CycleSummary& summary, const LoadedCycle& coarse, const CycleExtremes* extremes,
                                const CyclesBetween& between) {
  if (!fine.usable() || !coarse.usable() || fine.positions.empty() || coarse.positions.empty() || !(fine.force > 0.0)) return {};
  CycleErrorParts parts{point_errors(fine, coarse, summary, between), position_errors(fine, summary, extremes)};
  join_edge_to_peak(summary, parts.points);
  join_edge_to_peak(summary, parts.positions);
  return parts;
}

double mean_error(const std::vector<double>& fine, const std::vector<double>& coarse) {
  std::vector<double> d = every(fine, fine.size() / coarse.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= coarse[i];
  return mean_error_by_points(d) + mean_error_by_positions(fine);
}

double peak_error_by_points(const PeakReadings& of) {
  std::vector<Sample> samples = evenly_spaced(every(of.fine, of.fine.size() / of.coarse.size()), of.coarse);
  for (std::size_t i = 0; i < of.between.size(); ++i) samples.push_back({of.between[i], of.fine_between[i], of.coarse_between[i]});
  return of_peaks * peak_difference(samples, neighbourhood(of.coarse.size()));
}

double error_beside_finer(double change, double beyond, double stated) {
  return std::isgreater(change, stated) ? change + beyond : std::fmin(stated, change + beyond);  // the one that is a number
}

CycleErrors point_errors_beside_finer(const CycleErrors& stated, const LoadedCycle& cycle, const CycleSummary& summary, const LoadedCycle& finer,
                                      const CycleSummary& finer_summary) {
  if (!cycle.usable() || !finer.usable() || cycle.positions.empty() || !(cycle.force > 0.0)) return stated;
  CycleErrors of_finer = point_errors(finer, cycle, finer_summary);
  of_finer.te_mean *= of_order_one;
  of_finer.te_peak_to_peak *= of_order_one;
  for (double& harmonic : of_finer.te_harmonics) harmonic *= of_order_one;
  CycleErrors errors;
  for (const auto of : CycleErrors::single()) errors.*of = error_beside_finer(std::abs(summary.*of - finer_summary.*of), of_finer.*of, stated.*of);
  for (std::size_t k = 0; k < stated.te_harmonics.size(); ++k) {
    errors.te_harmonics.push_back(
        error_beside_finer(std::abs(summary.te_harmonics[k] - finer_summary.te_harmonics[k]), of_finer.te_harmonics[k], stated.te_harmonics[k]));
  }
  return errors;
}

double headline_error(const CycleErrors& errors, const CycleSummary& summary, const LoadedCycle& cycle) {
  if (!cycle.usable() || cycle.positions.empty() || std::isnan(errors.te_peak_to_peak)) return not_given;
  const double variation = std::max(summary.te_peak_to_peak, quiet_share * mean_of(curve(cycle, approach_of_teeth)));
  double largest = errors.te_peak_to_peak / variation;
  for (std::size_t k = 0; k < std::min<std::size_t>(figure_harmonics, errors.te_harmonics.size()); ++k) {
    largest = std::max(largest, errors.te_harmonics[k] / variation);
  }
  return std::max(largest, errors.peak_contact_stress / summary.peak_contact_stress);
}

}  // namespace flankwright
