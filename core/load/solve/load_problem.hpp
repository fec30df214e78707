#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/units.hpp"
#include "core/compliance/local/contact_law.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Loaded contact at one mesh position: the strictly convex programme
///
///     minimise  1/2 (aw)' K (aw) + sum a_i Psi_i(w_i) + sum a_i g_i w_i    subject to  sum a_i w_i = F,  w >= 0
///
/// over the line loads w; Psi' = c is the local deflection. The multiplier of the force balance is the transmission
/// error f_t.
/// This looks at numbers that are kept elsewhere and must outlive it: influence and laws of a mesh serve many problems.
struct LoadProblemView {
  const Eigen::MatrixXd& influence;     ///< K, symmetric, n x n [mm/N]; positive semi-definite with the slopes of the laws
  const Eigen::VectorXd& weight;        ///< a, contact-line length of each point, > 0, n [mm]
  const Eigen::VectorXd& gap;           ///< g before load, n [mm]
  const std::vector<ContactLaw>& laws;  ///< c, n; empty: no local deflection (then K must be positive definite)
  double force;                         ///< F, normal to the flanks, >= 0 [N]
};

/// The same with its own numbers.
struct LoadProblem {
  Eigen::MatrixXd influence;
  Eigen::VectorXd weight;
  Eigen::VectorXd gap;
  std::vector<ContactLaw> laws;
  double force{0.0};

  operator LoadProblemView() const { return {influence, weight, gap, laws, force}; }
};

enum class LoadStatus { NotRun, Converged, NoContactPoints, IterationLimit };

/// Load on the n contact points of one mesh position.
struct LoadDistribution {
  LoadStatus status{LoadStatus::NotRun};
  std::string message{"the load distribution was not solved"};
  Eigen::VectorXd line_load;              ///< w_i >= 0 [N/mm]
  Eigen::VectorXd contact_deflection;     ///< c_i(w_i) [mm]
  Eigen::VectorXd structural_deflection;  ///< (K a w)_i [mm]
  Eigen::VectorXd remaining_gap;          ///< under load, >= 0, 0 where loaded [mm]
  double transmission_error{not_given};   ///< f_t: approach of the gears along the flank normal [mm]
  /// max over i of |remaining gap| where loaded and -min(remaining gap) elsewhere, relative to the largest deflection
  /// of a loaded point, sum_j |K_ij| a_j w_j + c_i; and |sum a w - F| / F. The larger of the two.
  double kkt_residual{not_given};
  /// kappa_1 = ||H||_1 ||H^-1||_1, estimated (Higham 1988), of the matrix H = aKa + a c' over the loaded points in the
  /// last Newton step [-]: line loads have about 16 - log10(kappa_1) of the input's digits. f_t is not affected, as the
  /// objective is stationary in the loads. NaN where no step was needed, or H is indefinite by round-off.
  double condition{not_given};
  int iterations{-1};      ///< Newton steps
  int factorisations{-1};  ///< Cholesky factorisations

  [[nodiscard]] bool usable() const { return status == LoadStatus::Converged; }
};

struct LoadOptions {
  /// Stop when kkt_residual <= tolerance [-], > 0.
  double tolerance{1e-12};
  /// Newton steps before giving up, >= 1.
  int max_iterations{100};
};

}  // namespace flankwright
