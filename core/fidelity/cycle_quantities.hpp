#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/fidelity/cycle_error.hpp"
#include "core/load/cycle/cycle_gradient.hpp"

namespace flankwright {

/// One row of the table of a loaded mesh cycle's quantities: a number, or one for each order of the mesh frequency.
/// Results, their gradients and errors, tables, sweeps and the report are written from these rows. What an objective may name has a row in
/// optimize/design/outputs/design_output.cpp as well.
struct CycleQuantity {
  std::string_view name;       ///< "te_peak_to_peak": as objectives and bounds name it
  std::string_view key;        ///< "te_peak_to_peak_um": in results, with its unit
  std::string_view words;      ///< "peak-to-peak TE"
  std::string_view topic;      ///< its table in the report: "Transmission error"
  std::string_view heading{};  ///< "TE p-p": of its column in the table of a run, a list's first entry; empty: not shown there
  int decimals{2};             ///< shown in that column
  std::string_view unit{};     ///< "um"; "" of a plain number
  double unit_size{1.0};       ///< internal units in one of it: mm in one um
  bool smaller_is_worse{false};
  bool is_list{false};  ///< one entry for each order, from 1 on; else one

  using Values = std::vector<double> (*)(const CycleSummary&);
  using Errors = std::vector<double> (*)(const CycleErrors&, const CycleSummary&);
  using Gradients = Eigen::MatrixXd (*)(const CycleSummary&, const CycleGradient&);
  Values values{nullptr};        ///< internal unit; NaN: not computed
  Errors errors{nullptr};        ///< estimated discretisation errors, internal unit; null: none are estimated
  Gradients gradients{nullptr};  ///< a row for each value, internal units; 0 x 0: none
};

/// All rows, in the order in which results show them.
std::span<const CycleQuantity> cycle_quantities();

/// A row with the order of the entry that is meant; order 0 of what is no list.
struct CycleEntry {
  const CycleQuantity* quantity{nullptr};
  int order{0};

  std::string name() const;   ///< "te_peak_to_peak", "te_harmonic_3"
  std::string key() const;    ///< "te_peak_to_peak_um", "te_harmonic_3_um"
  std::string words() const;  ///< "peak-to-peak TE", "third harmonic of TE"
  /// Its own one of a row's values, internal unit; NaN where there is none.
  double of(const std::vector<double>& values) const;
  /// In the row's unit; NaN where it was not computed or estimated.
  double value(const CycleSummary& summary) const;
  double error(const CycleErrors& errors, const CycleSummary& summary) const;
};

inline constexpr int highest_te_harmonic = 10;  ///< order that a summary has

/// "first" .. "tenth". @param order  1 .. highest_te_harmonic
std::string_view ordinal(int order);

/// Every entry of every row, for sweeps and tables.
std::vector<CycleEntry> cycle_entries();
/// The entry of that name; its quantity is null where there is none.
CycleEntry find_cycle_entry(std::string_view name);

}  // namespace flankwright
