#include "core/compliance/fitted/corrected_compliance.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/compliance/fitted/kernel_sum.hpp"

namespace flankwright {

CorrectedCompliance::CorrectedCompliance(std::shared_ptr<const FlankCompliance> coarse, const GearProportions& gear, std::vector<double> coefficients)
    : coarse_(std::move(coarse)), gear_(gear), form_(KernelForm::correction()), coefficients_(std::move(coefficients)) {
  if (!coarse_) throw InvalidInput("coarse", "none", "a compliance");
  gear_.validate();
  if (static_cast<int>(coefficients_.size()) != form_.count() || !std::ranges::all_of(coefficients_, [](double c) { return std::isfinite(c); })) {
    throw InvalidInput("coefficients", std::to_string(coefficients_.size()), std::to_string(form_.count()) + " finite numbers");
  }
}

Eigen::MatrixXd CorrectedCompliance::evaluate(std::span<const FlankStation> points) const {
  Eigen::MatrixXd K = coarse_->evaluate(points);
  KernelSum kernels(form_, gear_, points);
  kernels.set_coefficients(coefficients_);
  K += kernels.tooth_matrix();
  return K;
}

}  // namespace flankwright
