#include "core/compliance/fitted/fitted_compliance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/compliance/fitted/kernel_sum.hpp"

namespace flankwright {
namespace {

/// {lowest, highest} tooth number.
std::pair<int, int> teeth_of(std::span<const FlankStation> points) {
  std::pair<int, int> teeth{points.front().tooth, points.front().tooth};
  for (const FlankStation& point : points) {
    teeth = {std::min(teeth.first, point.tooth), std::max(teeth.second, point.tooth)};
  }
  return teeth;
}

}  // namespace

FittedCompliance::FittedCompliance(KernelForm form, const GearProportions& gear, std::vector<double> coefficients, FitRecord record)
    : form_(std::move(form)), gear_(gear), coefficients_(std::move(coefficients)), record_(std::move(record)) {
  form_.validate();
  gear_.validate();
  if (static_cast<int>(coefficients_.size()) != form_.count()) {
    throw InvalidInput("fit.coefficients", std::to_string(coefficients_.size()), std::to_string(form_.count()));
  }
  for (const double coefficient : coefficients_) {
    if (!std::isfinite(coefficient)) throw InvalidInput("fit.coefficients", "not finite", "finite numbers");
  }
  if (record_.range.teeth_apart > 0 && !form_.couples_teeth()) {
    throw InvalidInput("fit.range.teeth_apart", std::to_string(record_.range.teeth_apart), "0 for a form without kernels between teeth");
  }
  if (!record_.standard_errors.empty() && record_.standard_errors.size() != coefficients_.size()) {
    throw InvalidInput("fit.standard_errors", std::to_string(record_.standard_errors.size()),
                       "none, or one for each of " + std::to_string(coefficients_.size()) + " coefficients");
  }
}

void FittedCompliance::require_known(std::span<const FlankStation> points) const {
  for (const FlankStation& point : points) {
    if (!(std::abs(point.u) <= 1.05)) throw InvalidInput("point.u", std::to_string(point.u), "-1.05 .. 1.05");
    if (!(point.zeta >= 0 && point.zeta <= gear_.relative_face)) {
      throw InvalidInput("point.zeta", std::to_string(point.zeta), "0 .. " + std::to_string(gear_.relative_face));
    }
  }
  if (points.empty()) return;
  const auto [lowest, highest] = teeth_of(points);
  if (highest - lowest > record_.range.teeth_apart) {
    throw InvalidInput("point.tooth", std::to_string(highest - lowest) + " teeth apart",
                       "at most " + std::to_string(record_.range.teeth_apart) + ", as the influence values fitted");
  }
}

Eigen::MatrixXd FittedCompliance::evaluate(std::span<const FlankStation> points) const {
  require_known(points);
  KernelSum sum(form_, gear_, points);
  sum.set_coefficients(coefficients_);
  return sum.tooth_matrix() + sum.body_matrix();
}

bool FittedCompliance::operator==(const FittedCompliance& other) const {
  return form_ == other.form_ && gear_ == other.gear_ && coefficients_ == other.coefficients_ && record_ == other.record_;
}

}  // namespace flankwright
