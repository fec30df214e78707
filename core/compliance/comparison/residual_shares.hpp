#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/compliance/fitted/influence_sample.hpp"

namespace flankwright {

/// Fractions of the pairs at which a distribution of residuals is given.
inline constexpr std::array<double, 17> kResidualShares{0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.97, 0.98, 0.99, 0.995, 1};

/// Distribution of the relative residuals |K_model - K| / |K| over all known pairs of points so many teeth apart, each
/// once, the diagonal included: the residual that a share of the pairs does not exceed, for kResidualShares. Where a
/// model has no value (the thesis' form under a negative root) its residual is infinite.
struct ResidualDistribution {
  int teeth_apart{-1};
  int pairs{0};
  std::array<double, kResidualShares.size()> residual{};  ///< [-]
  /// Largest |K_model - K| / sqrt(K_pp K_qq) [-]: the measure where a compliance passes through zero.
  double worst_of_own{0.0};

  /// @param share  one of kResidualShares
  double at(double share) const;
  double median() const { return at(0.5); }
  double share_95() const { return at(0.95); }
  double worst() const { return residual.back(); }
};

/// One entry per number of teeth apart that occurs and that the model covers, in rising order.
/// @param teeth_apart  the largest that the model covers
/// @param samples      with known own compliances
std::vector<ResidualDistribution> residual_distributions(const FlankCompliance& model, int teeth_apart, std::span<const InfluenceSample> samples);

}  // namespace flankwright
