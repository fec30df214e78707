#include "core/compliance/fitted/residual_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace flankwright {

std::vector<ResidualStatistics> residual_statistics(const FlankCompliance& model, std::span<const InfluenceSample> samples, double floor) {
  std::map<int, std::vector<double>> errors;
  for (const InfluenceSample& sample : samples) {
    sample.validate();
    const Eigen::MatrixXd K = model.evaluate(sample.points);
    for (Eigen::Index p = 0; p < K.rows(); ++p) {
      for (Eigen::Index q = 0; q <= p; ++q) {
        const double known = sample.at(p, q);
        if (std::isnan(known)) continue;
        const int apart = std::abs(sample.points[static_cast<std::size_t>(p)].tooth - sample.points[static_cast<std::size_t>(q)].tooth);
        const double own = std::sqrt(sample.compliance(p, p) * sample.compliance(q, q));
        const double scale = std::isnan(own) ? std::abs(known) : std::max(std::abs(known), floor * own);
        const double error = std::abs(K(p, q) + sample.given_at(p, q) - known);
        errors[apart].push_back(std::isnan(error) ? INFINITY : error / scale);
      }
    }
  }
  std::vector<ResidualStatistics> statistics;
  for (auto& [apart, sorted] : errors) {
    std::sort(sorted.begin(), sorted.end());
    const auto n = sorted.size();
    statistics.push_back({apart, static_cast<int>(n), sorted[(n - 1) / 2], sorted[(95 * n + 99) / 100 - 1], sorted.back()});
  }
  return statistics;
}

}  // namespace flankwright
