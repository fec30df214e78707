#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/compliance/tooth/flank_compliance.hpp"
#include "core/compliance/fitted/kernel_form.hpp"
#include "core/compliance/fitted/residual_statistics.hpp"

namespace flankwright {

/// The range of the influence values that a fit was made from.
struct FitRange {
  double u_min{std::numeric_limits<double>::quiet_NaN()}, u_max{std::numeric_limits<double>::quiet_NaN()};
  double zeta_min{std::numeric_limits<double>::quiet_NaN()}, zeta_max{std::numeric_limits<double>::quiet_NaN()};
  int teeth_apart{0};  ///< the largest |m_p - m_q| of a known pair

  bool operator==(const FitRange&) const = default;
};

/// The quality of a fit.
struct FitRecord {
  FitRange range;
  std::vector<ResidualStatistics> residuals;  ///< on the points fitted
  std::vector<double> standard_errors;        ///< of the coefficients; empty where unknown

  bool operator==(const FitRecord&) const = default;
};

/// Names and numbers, one for one: all that a file of fits has to hold.
struct FitTable {
  std::vector<std::string> names;
  std::vector<double> values;
};

/// Tooth compliance as a KernelForm with fitted coefficients: symmetric and positive semi-definite over any points of
/// any teeth by construction, to round-off. Between the outermost points of the sample and the edges of the flank it
/// extrapolates smoothly.
class FittedCompliance final : public FlankCompliance {
 public:
  /// @param coefficients  size form.count(), finite
  /// @throws InvalidInput naming the field that does not match or is out of range
  FittedCompliance(KernelForm form, const GearProportions& gear, std::vector<double> coefficients, FitRecord record);

  /// E m_n K [-], n x n. @throws InvalidInput for |u| > 1.05, zeta outside 0 .. B, or points more teeth apart than
  /// range().teeth_apart
  Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override;

  const KernelForm& form() const { return form_; }
  const GearProportions& gear() const { return gear_; }
  const std::vector<double>& coefficients() const { return coefficients_; }
  const FitRecord& record() const { return record_; }

  /// Everything, form included, as names and numbers.
  FitTable to_table() const;

  bool operator==(const FittedCompliance& other) const;

 private:
  void require_known(std::span<const FlankStation> points) const;

  KernelForm form_;
  GearProportions gear_;
  std::vector<double> coefficients_;
  FitRecord record_;
};

}  // namespace flankwright
