#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/compliance/tooth/flank_compliance.hpp"
#include "core/compliance/fitted/influence_sample.hpp"

namespace flankwright {

/// Distance of a model from influence values, over all known pairs of points that are so many teeth apart: the
/// distribution of |K_model - K| / max(|K|, floor sqrt(K_pp K_qq)), relative to the local value.
struct ResidualStatistics {
  int teeth_apart{-1};  ///< |m_p - m_q|
  int pairs{0};
  double median{std::numeric_limits<double>::quiet_NaN()};    ///< [-]
  double share_95{std::numeric_limits<double>::quiet_NaN()};  ///< 95 % of the pairs are at or below this [-]
  double worst{std::numeric_limits<double>::quiet_NaN()};     ///< [-]

  bool operator==(const ResidualStatistics&) const = default;
};

/// One entry per number of teeth apart that occurs, in rising order. The reciprocal value of a pair counts, once, the
/// diagonal included; where the model has no value the residual is infinite.
/// @param floor  [-], >= 0: on gears of few teeth the compliance between a far corner's points passes through zero, where
///               a relative figure says nothing; with 0.01 such pairs count relative to a hundredth of their own values
/// @throws InvalidInput where a sample is not valid or has a point outside the model
std::vector<ResidualStatistics> residual_statistics(const FlankCompliance& model, std::span<const InfluenceSample> samples, double floor = 0);

}  // namespace flankwright
