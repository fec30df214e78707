#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/compliance/tooth/flank_compliance.hpp"
#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/least_squares.hpp"

namespace flankwright {

/// The gear body in the thesis' form.
enum class ThesisBody {
  InMasterFunction,  ///< eqs 1.57, 2.5, 2.6: the end effects multiply it; what the thesis used
  Separate,          ///< eqs 2.6 .. 2.8: added, which the thesis recommends
};

/// The curves of the thesis [Haddad 1991, eqs 1.57, 2.5 .. 2.9], for comparison. On the loaded tooth, with the load at
/// z_F and radius r_F, both in modules, and zbar = z - z_F,
///
///     K = sqrt(G(z_F) G(z)) F(zbar),   G(z) = 1 + C_g2 e^(-C_g3 z) + C_g4 e^(-C_g5 (B - z)),
///     F = C_f1 [e^(-C_f2 |zbar| - C_f6 zbar) - C_f3 e^(-25 |zbar|)] + C_f4 + C_f5 zbar,
///
/// the last two terms outside the root for ThesisBody::Separate. On teeth m apart (eq. 2.9, C_a6 = 0 as the thesis
/// chose)
///
///     K = C_a1 + C_a2 e^(-C_a3 (z_F + z)) + C_a4 e^(-C_a5 (2 B - z_F - z)).
///
/// Departures: the coefficients' dependence on r_F, there a spline through five radii, is a parabola in u_F; C_g1 is 1,
/// as its size is C_f1's; decay rates are exponentials, so that they stay positive; and as F is not reciprocal,
/// evaluate() gives the mean of both directions, which is also fitted. The matrix is not positive semi-definite.
class ThesisCompliance final : public FlankCompliance {
 public:
  static constexpr int kOwnCoefficients = 30;  ///< ten functions of u_F, three powers each
  static constexpr int kAdjacentCoefficients = 5;

  /// @param coefficients  30, then 5 for each number of teeth apart from 1 on
  /// @throws InvalidInput where their number is neither
  ThesisCompliance(ThesisBody body, const GearProportions& gear, std::vector<double> coefficients);

  Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override;

  int teeth_apart() const;  ///< the largest that it covers
  const std::vector<double>& coefficients() const { return coefficients_; }

 private:
  ThesisBody body_;
  GearProportions gear_;
  std::vector<double> coefficients_;
};

struct ThesisFitResult {
  FitStatus status{FitStatus::NotRun};
  std::string message{"fit_thesis_form() was not called"};
  std::optional<ThesisCompliance> fit;  ///< empty unless Converged or IterationLimit
};

/// Fits the thesis' form to influence values of one gear: least squares of the relative residuals, the loaded tooth and
/// each distance between teeth on its own.
/// @throws InvalidInput where a sample or an option is out of range, or the samples are of different gears
ThesisFitResult fit_thesis_form(std::span<const InfluenceSample> samples, ThesisBody body, const LeastSquaresOptions& options = {});

}  // namespace flankwright
