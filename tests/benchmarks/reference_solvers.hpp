#pragma once

#include <Eigen/Core>

#include "core/load/solve/load_problem.hpp"

/// The loaded-contact programme handed to general solvers that know nothing of contact.
namespace flankwright::reference_solvers {

struct Answer {
  Eigen::VectorXd line_load;  ///< [N/mm]
  int evaluations{0};         ///< of the gradient
  double callback_ms{0.0};    ///< processor time spent in objective, gradient and Hessian
};

/// Ipopt's primal-dual interior-point method with the exact Hessian, dense, by MUMPS.
Answer solve_by_ipopt(const LoadProblem& problem);

/// NLopt's SLSQP (Kraft 1988): a sequence of bounded, equality-constrained least-squares problems, each by Lawson and Hanson's LSEI
/// and NNLS; BFGS for the Hessian.
Answer solve_by_slsqp(const LoadProblem& problem);

/// How far loads are from optimal, for interior points too: the largest |min(load / mean load, remaining gap / largest deflection)|,
/// the remaining gap counted from the load-weighted mean approach; and the imbalance of force. Zero exactly at the solution.
double natural_residual(const LoadProblem& problem, const Eigen::VectorXd& line_load);

/// Processor time of this thread [ms].
double processor_ms();

}  // namespace flankwright::reference_solvers
