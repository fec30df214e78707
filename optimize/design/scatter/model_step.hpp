#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimize/design/scatter/statistic_model.hpp"

namespace flankwright {

/// The shortest d with slopes d <= limits, row by row; nothing where none has |d| <= longest. Least distance programming by nonnegative least squares
/// [Lawson & Hanson, Solving Least Squares Problems (1974), ch. 23.4].
std::optional<Eigen::VectorXd> shortest_within(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& limits, double longest);

/// What a search over draws minimises and keeps, modelled.
struct ScatterModel {
  StatisticModel objective;
  std::vector<StatisticModel> bounded;
  std::vector<double> limits;  ///< of them, outside units
  Eigen::MatrixXd slopes;      ///< of the constraints on modifications: slopes x <= most
  Eigen::VectorXd most;
  Eigen::VectorXd lower, upper;  ///< the part of 0 .. 1 that steps keep to, at first that of the problem

  explicit ScatterModel(const DesignProblem& problem);
  /// Largest excess of the statistics over their limits [-]; minus infinity without limits.
  double excess(const Eigen::VectorXd& x, int draws) const;
};

struct ModelStep {
  Eigen::VectorXd x;
  double gain{0.0};  ///< of what is minimised by the model, relative [-]: the statistic, or the excess over the limits where they are not kept
};

/// Least statistic of the model in the box of this half width about a design, within ScatterModel::lower and upper and with the limits kept as far as the
/// model says so; of several the one nearest to the design. Where the limits are not kept at the design their excess is minimised instead.
///
/// A level method [Lemaréchal, Nemirovskii, Nesterov, New variants of bundle methods, Math. Programming 69 (1995)]: halfway between what is reached and
/// what cannot be reached lies a level, and the next design is the nearest one at which no tangent exceeds it. A quantile is minimised as the largest of
/// the draws that it does not leave out, and these are chosen again from where that ends.
///
/// @param draws  the first so many
ModelStep least_of_model(const ScatterModel& model, const Eigen::VectorXd& centre, double radius, int draws);

}  // namespace flankwright
