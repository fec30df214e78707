#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"
#include "optimize/design/search/optimality.hpp"

namespace flankwright {

/// A parameter whose influence on a design is assessed, in steps of a size known in a workshop.
struct AssessedParameter {
  std::string name;  ///< as the study names it: "pinion.modification.lead_crowning", "misalignment.crossing"
  double step{1.0};  ///< one step [unit]
  std::string unit;  ///< "um", "mm", "arcmin", "%"
  MeshParameter parameter;
  double inside{1.0};  ///< one step in internal units, added metal with its sign; torque: fraction of each scene's
  int variable{-1};    ///< index of the design variable it is; -1: a tolerance
};

/// A variable of the task that moves in steps of this size in its outside unit.
AssessedParameter parameter_of_variable(const DesignTask& task, int variable, double step);

/// One step of a modification in its outside unit, see assessed_parameters(). @param unit  DesignVariable::unit()
double assessment_step(const std::string& unit);

/// The task's variables with the modifications linked to them. Amounts of a modification step by 1 um, extents by 0.1 mm, parabolic_te by
/// 0.01 arcsec/deg^2.
std::vector<AssessedParameter> variable_parameters(const DesignTask& task);

/// Deviations of housing and workshop, the same in every scene: misalignment 1 um, crossing and intersecting 0.1 arcmin, centre
/// distance 0.01 mm, helix and profile slope of either gear 1 um, torque 1 %.
///
/// An error of helix or profile slope is the negative of that modification; the profile's differs by the same shift on all teeth,
/// reference for pitch circle, which moves the transmission error's mean only.
std::vector<AssessedParameter> tolerance_parameters();

/// variable_parameters(), then tolerance_parameters().
std::vector<AssessedParameter> assessed_parameters(const DesignTask& task);

/// The output that a row with a candidate is about: of what is minimised, of a bounded objective, or of a bounded output.
const ObjectiveTerm& term_of(const EpigraphRow& row, const DesignTask& task);

/// Objective and bounded outputs of one design to first order. Each peak is the largest of its leading candidates,
/// which have exact derivatives,
///
///     measure_s(p) = sum_k w_k max_j v_skj(p)          p in steps of the parameters.
///
/// At a kink of a peak one-sided derivatives follow by themselves; off it, a second candidate is seen before it is the
/// largest. Candidates within `reach` of their peak take part. Linear in p are stresses, loads and differences of the transmission error themselves, the two
/// components of a harmonic, and the n-th root of what grows with the n-th power of a line load (DesignOutput::load_growth):
///
///     v(p) = v (1 + g . p / (n v))^n,   of a harmonic   v(p) = |c + C p|.
class LocalModel {
 public:
  static constexpr double reach = 0.2;  ///< candidate >= (1 - reach)^n peak, n: DesignOutput::growth

  /// @param active  what has a multiplier at this design, for active_slopes() and lagrangian_slope()
  /// @throws std::runtime_error where a scene's load distribution does not converge
  LocalModel(const DesignProblem& problem, const PerGear<Modification>& modification, const std::vector<AssessedParameter>& parameters,
             const std::vector<ActiveBound>& active = {});

  int parameters() const { return parameters_; }
  std::vector<double> scene_measures(const Eigen::VectorXd& steps) const;
  /// The scenes' measures, aggregated as in the task, outside units.
  double objective(const Eigen::VectorXd& steps) const;
  /// Largest excess of the bounded outputs over their limits [-]; 0 where all are kept.
  double violation(const Eigen::VectorXd& steps) const;
  /// Changes of what has a multiplier by a step of each parameter, by_output * slope [in Optimality::objective_scale]: a row for each of `active`, 0
  /// where it has no output.
  const Eigen::MatrixXd& active_slopes() const { return active_slopes_; }
  /// Change of the Lagrangian's outputs by a step of each parameter: the sum of these rows, each times its multiplier.
  Eigen::VectorXd lagrangian_slope() const { return active_slopes_.transpose() * multipliers_; }

 private:
  /// A smooth function: value [outside units; bounded outputs: relative to the limit] and its change by a step of each parameter.
  struct Candidate {
    double value{not_given};
    Eigen::VectorXd slope;
    double growth{1.0};
    double at(const Eigen::VectorXd& steps) const;
  };
  /// The largest of its candidates, less a limit.
  struct Peak {
    std::vector<Candidate> candidates;  ///< first the leading one
    bool is_phasor{false};              ///< the two candidates are the components of a harmonic, whose amplitude it is
    double sign{1.0};                   ///< of the amplitude; -1: it has a least value
    double limit{0.0};
    double at(const Eigen::VectorXd& steps) const;
  };

  const DesignTask& task_;
  int parameters_{0};
  std::vector<std::vector<Peak>> measures_;     ///< [scene][term]
  std::vector<std::vector<Peak>> constraints_;  ///< [constraint][scene]: OutputConstraint::excess()
  Eigen::VectorXd multipliers_;
  Eigen::MatrixXd active_slopes_;
};

}  // namespace flankwright
