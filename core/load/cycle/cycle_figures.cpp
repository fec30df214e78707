#include "core/load/cycle/cycle_figures.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/unloaded/transmission_error.hpp"

namespace flankwright {

const char* name_of(Figure figure) {
  constexpr std::array<const char*, figure_count> names{"te_mean",       "te_peak_to_peak", "te_harmonic_1",       "te_harmonic_2",  "te_harmonic_3",
                                                        "te_harmonic_4", "te_harmonic_5",   "peak_contact_stress", "peak_line_load", "load_factor"};
  return names[static_cast<std::size_t>(figure)];
}

double largest(const PerFigure& values) { return *std::ranges::max_element(values); }

double headline(const PerFigure& values) {
  return *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(Figure::PeakContactStress) + 1);
}

PerFigure root_sum_square(const PerFigure& a, const PerFigure& b) {
  PerFigure both{};
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = std::hypot(a[i], b[i]);
  return both;
}

PerFigure larger_of(const PerFigure& a, const PerFigure& b) {
  PerFigure larger{};
  for (std::size_t i = 0; i < larger.size(); ++i) larger[i] = std::isnan(b[i]) ? b[i] : std::max(a[i], b[i]);
  return larger;
}

PerFigure figure_errors(const CycleFigures& figures, const CycleFigures& reference) {
  const double variation = std::max(reference[Figure::TePeakToPeak], quiet_share * reference.mean_approach);
  PerFigure errors{};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Figure figure = static_cast<Figure>(i);
    const double scale = figure == Figure::TeMean ? reference.mean_approach : figure < Figure::PeakContactStress ? variation : reference.value[i];
    errors[i] = std::abs(figures.value[i] - reference.value[i]) / scale;
  }
  return errors;
}

PerFigure figure_differences(const CycleFigures& figures, const CycleFigures& reference) {
  PerFigure differences = figure_errors(figures, reference);
  const double variation = std::max(reference[Figure::TePeakToPeak], quiet_share * reference.mean_approach);
  for (std::size_t k = 0; k < figure_harmonics; ++k) {
    differences[static_cast<std::size_t>(Figure::TeHarmonic1) + k] = std::abs(figures.te_phasor[k] - reference.te_phasor[k]) / variation;
  }
  return differences;
}

double unseen_rise(const std::vector<double>& samples) {
  const std::size_t n = samples.size();
  const double seen = *std::ranges::max_element(samples);
  double highest = seen;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = samples[i], b = samples[(i + 1) % n];
    const double rise_to_a = a - samples[(i + n - 1) % n], rise_to_b = b - samples[(i + 2) % n];  // towards the interval from either side
    if (rise_to_a > 0.0 && rise_to_b > 0.0) {
      const double t = std::clamp((b + rise_to_b - a) / (rise_to_a + rise_to_b), 0.0, 1.0);
      highest = std::max(highest, std::min(a + rise_to_a * t, b + rise_to_b * (1.0 - t)));
    } else if (rise_to_a > 0.0 && b < a) {
      highest = std::max(highest, a + rise_to_a);
    } else if (rise_to_b > 0.0 && a < b) {
      highest = std::max(highest, b + rise_to_b);
    }
  }
  return highest - seen;
}

CycleFigures figures_of(const LoadedCycle& cycle, const CycleSummary& summary) {
  std::vector<double> te;
  double approach = 0.0;
  for (const LoadedPosition& position : cycle.positions) {
    te.push_back(position.load.transmission_error);
    if (position.load.usable()) approach += position.approach_of_teeth();
  }
  CycleFigures figures;
  figures[Figure::TeMean] = summary.te_mean;
  figures[Figure::TePeakToPeak] = summary.te_peak_to_peak;
  const std::vector<double> harmonics = harmonic_amplitudes(te);
  for (std::size_t k = 0; k < figure_harmonics; ++k) {
    figures.value[static_cast<std::size_t>(Figure::TeHarmonic1) + k] = k < harmonics.size() ? harmonics[k] : not_given;
    figures.te_phasor[k] = k < harmonics.size() ? harmonic_phasor(te, static_cast<int>(k) + 1) : not_given;
  }
  figures[Figure::PeakContactStress] = summary.peak_contact_stress;
  figures[Figure::PeakLineLoad] = summary.peak_line_load;
  figures[Figure::LoadFactor] = summary.load_factor;
  figures.mean_approach = approach / static_cast<double>(te.size());
  return figures;
}

}  // namespace flankwright
