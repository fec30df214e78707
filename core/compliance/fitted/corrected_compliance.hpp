#pragma once

#include <memory>
#include <vector>

#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/kernel_form.hpp"

namespace flankwright {

/// A gear's compliance by a coarse mesh, completed by fitted kernels:
///
///     K(p, q) = K_coarse(p, q) + sum over kernels h(p) h(q)/sqrt(A R) rho(Q)   [KernelForm, the kernels of one tooth]
///
/// positive semi-definite as both parts are. The coarse mesh gives the gear body, the neighbouring teeth and the tooth
/// as a whole. The kernels add the tooth's deflection around the load that it misses.
class CorrectedCompliance final : public FlankCompliance {
 public:
  /// @param coarse        of the same gear by coarse_mesh()
  /// @param coefficients  of KernelForm::correction(), finite
  /// @throws InvalidInput "coarse", "gear" or "coefficients"
  CorrectedCompliance(std::shared_ptr<const FlankCompliance> coarse, const GearProportions& gear, std::vector<double> coefficients);

  /// @throws InvalidInput as the coarse compliance
  Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override;

  const FlankCompliance& coarse() const { return *coarse_; }
  const GearProportions& gear() const { return gear_; }
  const std::vector<double>& coefficients() const { return coefficients_; }

 private:
  std::shared_ptr<const FlankCompliance> coarse_;
  GearProportions gear_;
  KernelForm form_;
  std::vector<double> coefficients_;
};

}  // namespace flankwright
