#include "core/compliance/comparison/residual_shares.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <map>

namespace flankwright {

double ResidualDistribution::at(double share) const {
  const auto found = std::find(kResidualShares.begin(), kResidualShares.end(), share);
  assert(found != kResidualShares.end());
  return residual[static_cast<std::size_t>(found - kResidualShares.begin())];
}

std::vector<ResidualDistribution> residual_distributions(const FlankCompliance& model, int teeth_apart, std::span<const InfluenceSample> samples) {
  std::map<int, std::vector<double>> residuals;
  std::map<int, double> worst_of_own;
  for (const InfluenceSample& sample : samples) {
    std::vector<FlankStation> stations;
    std::vector<Eigen::Index> rows;
    for (std::size_t p = 0; p < sample.points.size(); ++p) {
      if (std::abs(sample.points[p].tooth) > teeth_apart) continue;
      stations.push_back(sample.points[p]);
      rows.push_back(static_cast<Eigen::Index>(p));
    }
    // Between neighbours on either side the model may not be defined; those pairs were not computed.
    const Eigen::MatrixXd K = model.evaluate(stations);
    for (std::size_t p = 0; p < stations.size(); ++p) {
      for (std::size_t q = 0; q <= p; ++q) {
        const double known = sample.at(rows[p], rows[q]);
        if (std::isnan(known)) continue;
        const double found = K(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q));
        const double error = std::isnan(found) ? INFINITY : std::abs(found - known);
        const int apart = std::abs(stations[p].tooth - stations[q].tooth);
        residuals[apart].push_back(error / std::abs(known));
        const double own = sample.compliance(rows[p], rows[p]) * sample.compliance(rows[q], rows[q]);
        worst_of_own[apart] = std::max(worst_of_own[apart], error / std::sqrt(own));
      }
    }
  }
  std::vector<ResidualDistribution> distributions;
  for (auto& [apart, sorted] : residuals) {
    std::sort(sorted.begin(), sorted.end());
    ResidualDistribution distribution{apart, static_cast<int>(sorted.size())};
    for (std::size_t i = 0; i < kResidualShares.size(); ++i) {
      const double rank = std::ceil(kResidualShares[i] * static_cast<double>(sorted.size()) - 1e-9);
      distribution.residual[i] = sorted[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
    }
    distribution.worst_of_own = worst_of_own[apart];
    distributions.push_back(distribution);
  }
  return distributions;
}

}  // namespace flankwright
