#pragma once

#include <set>
#include <variant>

#include "optimize/sampling/sensitivity_design.hpp"
#include "studies/study_file/sweep_value.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

/// The samples of a sweep, each from its number alone.
class SweepDesign {
 public:
  explicit SweepDesign(const SweepTable& sweep);

  long long samples() const { return samples_; }
  std::size_t parameters() const { return parameters_.size(); }
  /// Levels of a parameter, rising, without repetition; none of a continuous distribution.
  std::vector<double> levels(std::size_t parameter) const {
    const std::vector<double>& values = parameters_[parameter].distribution.level_values();
    const std::set<double> sorted(values.begin(), values.end());
    return {sorted.begin(), sorted.end()};
  }
  /// Whether a parameter's values are numbers of draws, without an order that means anything.
  bool is_draw(std::size_t parameter) const { return parameters_[parameter].pitch.has_value(); }
  /// Consecutive samples that belong together for Sobol indices; 0: the design gives none.
  int block_size() const;
  /// Values of the parameters, in the units of bare numbers. @param i  0 .. samples() - 1
  std::vector<double> values(long long i) const;

 private:
  std::vector<SweepParameter> parameters_;
  std::variant<SampleDesign, SensitivityDesign> design_;
  long long samples_;
};

/// Puts a parameter's value, in the unit of a bare number, in its place; of a pitch by tolerance class the deviations of every tooth, drawn by the
/// whole part of the value.
/// @throws InvalidInput where it is out of the key's range
void set_swept(SweptCondition& condition, const SweepParameter& parameter, double value);

/// What the parameters do at the low and at the high end of their distributions, one by one, where that is in the range of their keys, and all together where most effects
/// are called for: at Distribution::widest(), held to the range, and without compensation of a twist. For decisions that must hold for every sample.
std::vector<SweptCondition> extreme_conditions(const Study& study);

}  // namespace flankwright::studies
