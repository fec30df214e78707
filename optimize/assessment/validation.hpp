#pragma once

#include <array>
#include <string>
#include <vector>

#include "optimize/assessment/compared_design.hpp"

namespace flankwright {

/// One design over many scenes.
struct ValidatedDesign {
  std::string name;
  std::vector<double> measures;  ///< per draw as draws_of() lists them, or per scene of none [outside units]; NaN where it could not be analysed
};

/// Analyses designs over scenes that need not be the task's own, each on its own and in parallel; the same bits whatever the number of
/// threads. Only the numbers are kept, so that there may be many scenes. The load cases of a draw give it one value, as task.within_draw says.
/// @throws InvalidInput as DesignProblem, for a scene that is none
std::vector<ValidatedDesign> validate_designs(const DesignTask& task, const std::vector<DesignScene>& scenes,
                                              const std::vector<NamedDesign>& designs);

/// Statistics of a sample of numbers; NaN are left out and counted.
struct Spread {
  static constexpr std::array shares{0.05, 0.25, 0.5, 0.75, 0.95};

  int count{0};   ///< numbers
  int failed{0};  ///< NaN
  double mean{not_given};
  double deviation{not_given};  ///< of the sample, n - 1; NaN for fewer than two
  double least{not_given}, greatest{not_given};
  std::array<double, 5> quantiles{not_given, not_given, not_given, not_given, not_given};  ///< at `shares`
};

/// Quantiles are linear between the sorted numbers, the least at share 0 and the greatest at 1.
Spread spread_of(const std::vector<double>& values);

/// Share of the scenes in which `a` is below `b` [-]; scenes where either is NaN are left out, NaN where none is left.
double share_below(const std::vector<double>& a, const std::vector<double>& b);

/// Number of values in each of equal bins of low .. high, the last one with its upper end.
std::vector<int> histogram(const std::vector<double>& values, double low, double high, int bins);

}  // namespace flankwright
