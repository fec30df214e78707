#pragma once

#include <vector>

#include "optimize/design/problem/design_task.hpp"

namespace flankwright {

/// A task with fewer load cases that is nearly the same.
struct JoinedLoads {
  DesignTask task;
  std::vector<std::size_t> joined_into;  ///< of each scene of the task before, the scene that has taken its place

  /// A number for each scene of the task before from those of the joined scenes: a sum over a spectrum is the same in all of its scenes.
  std::vector<double> of_scenes(const std::vector<double>& of_joined) const;
};

/// Joins load cases of each spectrum that differ by their torque and their duration alone, from the largest torque down, as long as the largest torque of those joined is at
/// most `widest` times their least. Together they have the sum of the load cycles, and the torque that does the same damage where that grows with the power g of the torque,
///
///     T = (sum n_k T_k^g / sum n_k)^(1/g),     g = DesignOutput::load_growth.
///
/// Damage that grows with another power q is off by about q (q - g) times the variance of the torques over their mean square, halved. Nothing is joined unless all outputs of the task are
/// sums over the spectrum: a peak belongs to one load case.
/// @param widest  > 1; the variance is at most ((widest - 1) / (widest + 1))^2, 0.2 % with 1.1
JoinedLoads with_joined_loads(DesignTask task, double widest = 1.1);

}  // namespace flankwright
