#pragma once

#include "optimize/sampling/sample_design.hpp"

namespace flankwright {

/// Samples in blocks of d + 2 for Sobol indices of d parameters [Saltelli et al., Comput. Phys. Commun. 181 (2010), the radial
/// scheme A, B, A_B]: of a design with 2 d coordinates point k gives two points A and B; the block is A, B, and A with its coordinate
/// j taken from B, j = 1 .. d. Every single sample is distributed as in a plain design, so that means and quantiles may be taken over
/// all of them; only the last block may be cut short.
class SensitivityDesign {
 public:
  /// As SampleDesign's; Sobol: at most half of sobol_dimensions parameters.
  SensitivityDesign(Sampler sampler, long long samples, int parameters, std::uint64_t seed)
      : parameters_(parameters), samples_(samples), blocks_(sampler, (samples + parameters + 1) / (parameters + 2), 2 * parameters, seed) {}

  long long samples() const { return samples_; }
  int block_size() const { return parameters_ + 2; }

  std::vector<double> point(long long i) const {
    const auto d = static_cast<std::size_t>(parameters_);
    const auto role = static_cast<std::size_t>(i % block_size());
    const std::vector<double> both = blocks_.point(i / block_size());
    std::vector<double> point(both.begin() + (role == 1 ? parameters_ : 0), both.begin() + (role == 1 ? 2 : 1) * parameters_);
    if (role >= 2) point[role - 2] = both[d + role - 2];
    return point;
  }

 private:
  int parameters_;
  long long samples_;
  SampleDesign blocks_;
};

}  // namespace flankwright
