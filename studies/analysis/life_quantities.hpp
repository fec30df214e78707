#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "optimize/design/outputs/output_row.hpp"
#include "studies/analysis/life_result.hpp"

namespace flankwright::studies {

/// The column of a quantity in the table of a run.
struct LifeColumn {
  std::string_view heading{};     ///< "loss"; empty: there is none
  std::string_view form{};        ///< "{:.2f}"
  std::string_view subheading{};  ///< "scuffing", below the heading; empty: the unit
};

/// One row of the table of what CaseLife has of a load case: a number of the pair, or one of each gear. results.json, life.csv, the table of a
/// run, the samples of a sweep, the errors in an optimisation and comparisons are written from these rows.
struct LifeQuantity {
  std::string_view key;                               ///< "loss_power_W": in results, with its unit
  double CaseLife::*of_pair{nullptr};                 ///< null: each gear has one
  PerGear<double> CaseLife::*of_gears{nullptr};       ///< null: the pair has one
  double CaseLifeErrors::*error{nullptr};             ///< null: none is estimated
  DamagedPoints SpectrumLife::*of_spectrum{nullptr};  ///< of a damage: where the sum over the spectrum is largest; null: it is no damage
  LifeColumn column{};
  std::optional<Output> output{};                   ///< the output that it or its reciprocal is, for errors and derivatives; none: it has neither
  Eigen::RowVectorXd CaseLife::*gradient{nullptr};  ///< of what is no output; null: there is none
  bool is_reciprocal{false};                        ///< the output is 1 / value
  bool smaller_is_worse{false};
  bool is_in_csv{true};     ///< a column of life.csv
  bool is_sampled{false};   ///< every sample of a sweep has it
  bool is_compared{false};  ///< in the short table of a comparison

  std::string_view unit() const;  ///< "W"; "-" of a plain number
  double of(const CaseLife& life, Member member) const;
  /// Of the pair, or of the gear that is worse off; NaN where it is not known.
  double worst(const CaseLife& life) const;
};

/// All rows, in the order of results.json and of sweeps: of the pair, then of each gear.
std::span<const LifeQuantity> life_quantities();

}  // namespace flankwright::studies
