#include "core/fidelity/cycle_quantities.hpp"

#include <array>
#include <cmath>
#include <functional>

#include "core/base/units.hpp"

namespace flankwright {

namespace {

/// The source of a row: a member, or a function of the whole.
template <auto of>
std::vector<double> one(const CycleSummary& summary) {
  return {std::invoke(of, summary)};
}
template <auto of>
std::vector<double> error(const CycleErrors& errors, const CycleSummary&) {
  return {std::invoke(of, errors)};
}
template <auto of>
Eigen::MatrixXd slope(const CycleSummary&, const CycleGradient& gradient) {
  return std::invoke(of, gradient);
}

using S = CycleSummary;
using E = CycleErrors;
using G = CycleGradient;

constexpr auto pinion_root = [](const S& s) { return s.pinion_root_stress.stress; };
constexpr auto wheel_root = [](const S& s) { return s.wheel_root_stress.stress; };
constexpr auto pinion_root_slope = [](const G& g) { return g.pinion_root_stress.stress; };
constexpr auto wheel_root_slope = [](const G& g) { return g.wheel_root_stress.stress; };

/// sqrt(sum a_k^2 / 2) over the amplitudes of all orders.
std::vector<double> te_rms(const S& s) {
  double squares = 0.0;
  for (const double amplitude : s.te_harmonics) squares += 0.5 * amplitude * amplitude;
  return {s.te_harmonics.empty() ? not_given : std::sqrt(squares)};
}

/// sum a_k a_k' / (2 rms); at 0, where it has a kink, 0, one of its subgradients.
Eigen::MatrixXd te_rms_slope(const S& s, const G& g) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(g.te_harmonics.cols());
  const double rms = te_rms(s).front();
  for (Eigen::Index k = 0; rms > 0.0 && k < g.te_harmonics.rows(); ++k)
    sum += s.te_harmonics[static_cast<std::size_t>(k)] / (2.0 * rms) * g.te_harmonics.row(k);
  return sum;
}

Eigen::MatrixXd stiffness_variation_slope(const S& s, const G& g) {
  return (g.largest_stiffness - g.least_stiffness - s.stiffness_variation() * g.mean_stiffness) / s.mean_stiffness;
}

/// What the error of the mean stiffness does to all positions alike leaves their ratios: only the rest of the extremes' errors counts, and the scale.
std::vector<double> stiffness_variation_error(const E& e, const S& s) {
  const double scale = e.mean_stiffness / s.mean_stiffness;
  const auto beside_scale = [&](double error, double value) { return error < scale * value ? 0.0 : error - scale * value; };  // NaN stays
  const double apart = beside_scale(e.largest_stiffness, s.largest_stiffness) + beside_scale(e.least_stiffness, s.least_stiffness);
  return {apart / s.mean_stiffness + scale * s.stiffness_variation()};
}

constexpr std::array rows{
    CycleQuantity{.name = "te_peak_to_peak",
                  .key = "te_peak_to_peak_um",
                  .words = "peak-to-peak TE",
                  .topic = "Transmission error",
                  .heading = "TE p-p",
                  .decimals = 4,
                  .unit = "um",
                  .unit_size = units::um,
                  .values = one<&S::te_peak_to_peak>,
                  .errors = error<&E::te_peak_to_peak>,
                  .gradients = slope<&G::te_peak_to_peak>},
    CycleQuantity{.name = "te_harmonic",
                  .key = "te_harmonics_um",
                  .words = "harmonic of TE",
                  .topic = "Transmission error",
                  .heading = "TE 1st",
                  .decimals = 4,
                  .unit = "um",
                  .unit_size = units::um,
                  .is_list = true,
                  .values = [](const S& s) { return s.te_harmonics; },
                  .errors = [](const E& e, const S&) { return e.te_harmonics; },
                  .gradients = slope<&G::te_harmonics>},
    CycleQuantity{.name = "te_rms",
                  .key = "te_rms_um",
                  .words = "rms of the harmonics of TE",
                  .topic = "Transmission error",
                  .unit = "um",
                  .unit_size = units::um,
                  .values = te_rms,
                  .gradients = te_rms_slope},
    CycleQuantity{.name = "te_mean",
                  .key = "te_mean_um",
                  .words = "mean TE",
                  .topic = "Transmission error",
                  .unit = "um",
                  .unit_size = units::um,
                  .values = one<&S::te_mean>,
                  .errors = error<&E::te_mean>,
                  .gradients = slope<&G::te_mean>},
    CycleQuantity{.name = "peak_line_load",
                  .key = "peak_load_N_per_mm",
                  .words = "peak line load",
                  .topic = "Stress and load",
                  .heading = "peak load",
                  .unit = "N/mm",
                  .values = one<&S::peak_line_load>,
                  .errors = error<&E::peak_line_load>,
                  .gradients = slope<&G::peak_line_load>},
    CycleQuantity{.name = "peak_contact_stress",
                  .key = "peak_contact_stress_MPa",
                  .words = "peak contact stress",
                  .topic = "Stress and load",
                  .heading = "peak sigma",
                  .unit = "MPa",
                  .values = one<&S::peak_contact_stress>,
                  .errors = error<&E::peak_contact_stress>,
                  .gradients = slope<&G::peak_contact_stress>},
    CycleQuantity{.name = "edge_stress",
                  .key = "edge_stress_MPa",
                  .words = "contact stress on tip edges",
                  .topic = "Stress and load",
                  .unit = "MPa",
                  .values = one<&S::edge_stress>,
                  .errors = error<&E::edge_stress>,
                  .gradients = slope<&G::edge_stress>},
    CycleQuantity{.name = "tip_edge_share",
                  .key = "tip_edge_share",
                  .words = "part of the force on tip edges",
                  .topic = "Stress and load",
                  .values = one<&S::tip_edge_share>,
                  .errors = error<&E::tip_edge_share>,
                  .gradients = slope<&G::tip_edge_share>},
    CycleQuantity{.name = "peak_root_stress",
                  .key = "peak_root_stress_MPa",
                  .words = "peak root stress",
                  .topic = "Stress and load",
                  .heading = "root sigma",
                  .unit = "MPa",
                  .values = one<&S::peak_root_stress>,
                  .errors = error<&E::peak_root_stress>,
                  .gradients = slope<&G::peak_root_stress>},
    CycleQuantity{.name = "pinion_root_stress",
                  .key = "pinion_root_stress_MPa",
                  .words = "pinion root stress",
                  .topic = "Stress and load",
                  .unit = "MPa",
                  .values = one<pinion_root>,
                  .gradients = slope<pinion_root_slope>},
    CycleQuantity{.name = "wheel_root_stress",
                  .key = "wheel_root_stress_MPa",
                  .words = "wheel root stress",
                  .topic = "Stress and load",
                  .unit = "MPa",
                  .values = one<wheel_root>,
                  .gradients = slope<wheel_root_slope>},
    CycleQuantity{.name = "mean_stiffness",
                  .key = "mean_stiffness_N_per_mm_um",
                  .words = "mean mesh stiffness",
                  .topic = "Stiffness",
                  .heading = "stiffness",
                  .decimals = 3,
                  .unit = "N/(mm um)",
                  .smaller_is_worse = true,
                  .values = one<&S::mean_stiffness>,
                  .errors = error<&E::mean_stiffness>,
                  .gradients = slope<&G::mean_stiffness>},
    CycleQuantity{.name = "least_stiffness",
                  .key = "least_stiffness_N_per_mm_um",
                  .words = "least mesh stiffness",
                  .topic = "Stiffness",
                  .unit = "N/(mm um)",
                  .smaller_is_worse = true,
                  .values = one<&S::least_stiffness>,
                  .errors = error<&E::least_stiffness>,
                  .gradients = slope<&G::least_stiffness>},
    CycleQuantity{.name = "largest_stiffness",
                  .key = "largest_stiffness_N_per_mm_um",
                  .words = "largest mesh stiffness",
                  .topic = "Stiffness",
                  .unit = "N/(mm um)",
                  .smaller_is_worse = true,
                  .values = one<&S::largest_stiffness>,
                  .errors = error<&E::largest_stiffness>,
                  .gradients = slope<&G::largest_stiffness>},
    CycleQuantity{.name = "stiffness_variation",
                  .key = "stiffness_variation",
                  .words = "variation of the mesh stiffness",
                  .topic = "Stiffness",
                  .values = one<&S::stiffness_variation>,
                  .errors = stiffness_variation_error,
                  .gradients = stiffness_variation_slope},
    CycleQuantity{.name = "load_factor",
                  .key = "load_factor",
                  .words = "load factor",
                  .topic = "Stress and load",
                  .heading = "load factor",
                  .values = one<&S::load_factor>,
                  .errors = error<&E::load_factor>,
                  .gradients = slope<&G::load_factor>},
};

}  // namespace

std::string_view ordinal(int order) {
  static constexpr std::array<std::string_view, highest_te_harmonic> ordinals{"first", "second",  "third",  "fourth", "fifth",
                                                                              "sixth", "seventh", "eighth", "ninth",  "tenth"};
  return ordinals.at(static_cast<std::size_t>(order - 1));
}

std::span<const CycleQuantity> cycle_quantities() { return rows; }

std::string CycleEntry::name() const {
  std::string name(quantity->name);
  if (order > 0) name.append("_").append(std::to_string(order));
  return name;
}

std::string CycleEntry::key() const {
  if (order == 0) return std::string(quantity->key);
  std::string key = name();
  if (!quantity->unit.empty()) key.append("_").append(quantity->unit);
  return key;
}

std::string CycleEntry::words() const {
  std::string words;
  if (order > 0) words.append(ordinal(order)).append(" ");
  return words.append(quantity->words);
}

double CycleEntry::of(const std::vector<double>& values) const {
  const auto index = static_cast<std::size_t>(order == 0 ? 0 : order - 1);
  return index < values.size() ? values[index] : not_given;
}

double CycleEntry::value(const CycleSummary& summary) const { return of(quantity->values(summary)) / quantity->unit_size; }

double CycleEntry::error(const CycleErrors& errors, const CycleSummary& summary) const {
  return quantity->errors == nullptr ? not_given : of(quantity->errors(errors, summary)) / quantity->unit_size;
}

std::vector<CycleEntry> cycle_entries() {
  std::vector<CycleEntry> entries;
  for (const CycleQuantity& row : rows) {
    for (int order = row.is_list ? 1 : 0; order <= (row.is_list ? highest_te_harmonic : 0); ++order) entries.push_back({&row, order});
  }
  return entries;
}

CycleEntry find_cycle_entry(std::string_view name) {
  for (const CycleEntry& entry : cycle_entries()) {
    if (entry.name() == name) return entry;
  }
  return {};
}

}  // namespace flankwright
