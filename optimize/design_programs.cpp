#include "optimize/design_programs.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

/// Which candidates add_candidates() takes: within `margin` of the peak, at most `most` per output and scene.
struct CandidateChoice {
  double margin;
  std::size_t most;
};

/// Stresses and loads: half the peak, which on the design problems tried is one round of solving instead of three. Differences of
/// f_t come in pairs of positions, of which the leading ones are enough.
CandidateChoice choice_for(Output output) {
  return output == Output::TePeakToPeak ? CandidateChoice{0.15, 60} : CandidateChoice{0.5, 400};
}

constexpr double auxiliary_limit = 100.0;        // u <= 100 peaks of the start: no active bound at any sensible design

}  // namespace

void DesignLog::record(const DesignProblem& problem, const Eigen::VectorXd& x, const DesignAnalysis& analysis) {
  if (!entries_.empty() && entries_.back().x == x) return;
  Entry entry{x, problem.objective(analysis), 0.0};
  for (const OutputConstraint& c : problem.task().constraints) {
    entry.constraint_violation = std::max(entry.constraint_violation, problem.constraint_value(analysis, c) / c.maximum - 1.0);
  }
  entries_.push_back(entry);
  const auto worse = [](const Entry& a, const Entry& b) {  // a is worse than b
    const bool fa = a.constraint_violation <= tolerance, fb = b.constraint_violation <= tolerance;
    if (fa != fb) return fb;
    return fa ? b.objective < a.objective : b.constraint_violation < a.constraint_violation;
  };
  if (best_ < 0 || worse(*best(), entry)) best_ = static_cast<int>(entries_.size()) - 1;
  if (progress_) progress_(static_cast<int>(entries_.size()), best()->objective);
}

ProgramValues DirectProgram::evaluate(const Eigen::VectorXd& x, bool with_gradients) {
  const DesignAnalysis& analysis = problem_.analyse(x, with_gradients);
  log_.record(problem_, x, analysis);
  const DesignTask& task = problem_.task();
  ProgramValues values;
  values.objective = problem_.objective(analysis);
  values.constraints.resize(constraints());
  for (int c = 0; c < constraints(); ++c) {
    const OutputConstraint& bound = task.constraints[static_cast<std::size_t>(c)];
    values.constraints[c] = problem_.constraint_value(analysis, bound) / bound.maximum - 1.0;
  }
  if (!with_gradients) return values;

  const auto leading_gradient = [&](const ObjectiveTerm& term, int s) {
    const LoadedCycle& cycle = analysis.cycles[static_cast<std::size_t>(s)];
    const PeakCandidate leader = leading_candidates(term, problem_.model(s), cycle, 0.0, 1).front();
    return problem_.scaled(candidate_value(term, leader, problem_.model(s), cycle).gradient);
  };
  std::vector<double> measures, weights;
  for (int s = 0; s < problem_.scenes(); ++s) {
    measures.push_back(problem_.scene_measure(analysis, s));
    weights.push_back(task.scenes[static_cast<std::size_t>(s)].weight);
  }
  const std::vector<double> slope = aggregate_weights(task.over, measures, weights);
  values.objective_gradient = Eigen::VectorXd::Zero(variables());
  for (int s = 0; s < problem_.scenes(); ++s) {
    if (slope[static_cast<std::size_t>(s)] == 0.0) continue;
    for (const ObjectiveTerm& term : task.objective) {
      values.objective_gradient +=
          slope[static_cast<std::size_t>(s)] * term.weight * term.outside_factor() * leading_gradient(term, s);
    }
  }
  values.constraint_jacobian = Eigen::MatrixXd::Zero(constraints(), variables());
  for (int c = 0; c < constraints(); ++c) {
    const OutputConstraint& bound = task.constraints[static_cast<std::size_t>(c)];
    int worst = 0;
    for (int s = 1; s < problem_.scenes(); ++s) {
      const auto at = [&](int i) {
        return output_value(bound.output, problem_.model(i), analysis.cycles[static_cast<std::size_t>(i)]);
      };
      if (at(s) > at(worst)) worst = s;
    }
    values.constraint_jacobian.row(c) = leading_gradient(bound.output, worst) / bound.maximum;
  }
  return values;
}

EpigraphProgram::EpigraphProgram(DesignProblem& problem, DesignLog& log) : problem_(problem), log_(log) {
  const Eigen::VectorXd x = problem.start();
  const DesignAnalysis& analysis = problem.analyse(x, true);
  log.record(problem, x, analysis);
  const auto& terms = problem.task().objective;
  double scale = 0.0;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    double largest = 0.0;
    for (int s = 0; s < considered_scenes(); ++s) largest = std::max(largest, peak(analysis, s, static_cast<int>(k)));
    reference_.push_back(largest > 0.0 ? largest : 1.0);
    scale += terms[k].weight * terms[k].outside_factor() * reference_.back();
  }
  objective_scale_ = scale;
  add_candidates(x);
  restart_from(x);
}

const ObjectiveTerm& EpigraphProgram::term_of(const Row& row) const {
  return is_bound(row) ? problem_.task().constraints[static_cast<std::size_t>(-1 - row.term)].output
                       : problem_.task().objective[static_cast<std::size_t>(row.term)];
}

double EpigraphProgram::peak(const DesignAnalysis& analysis, int scene, int term) const {
  return output_value(problem_.task().objective[static_cast<std::size_t>(term)], problem_.model(scene),
                      analysis.cycles[static_cast<std::size_t>(scene)]);
}

bool EpigraphProgram::shares_one_bound() const {
  return problem_.task().over == Aggregate::Worst && problem_.task().objective.size() == 1;
}

bool EpigraphProgram::has_worst_row() const { return problem_.task().over == Aggregate::Worst && !shares_one_bound(); }

int EpigraphProgram::auxiliary(int scene, int term) const {
  const int terms = static_cast<int>(problem_.task().objective.size());
  return problem_.variables() + (shares_one_bound() ? 0 : scene * terms + term);
}

int EpigraphProgram::variables() const {
  const int terms = static_cast<int>(problem_.task().objective.size());
  return problem_.variables() + (shares_one_bound() ? 1 : considered_scenes() * terms) + (has_worst_row() ? 1 : 0);
}

int EpigraphProgram::constraints() const {
  return static_cast<int>(rows_.size()) + (has_worst_row() ? considered_scenes() : 0);
}

Eigen::VectorXd EpigraphProgram::lower() const { return Eigen::VectorXd::Zero(variables()); }

Eigen::VectorXd EpigraphProgram::upper() const {
  Eigen::VectorXd bound = Eigen::VectorXd::Constant(variables(), auxiliary_limit);
  bound.head(problem_.variables()).setOnes();
  return bound;
}

int EpigraphProgram::add_candidates(const Eigen::VectorXd& x) {
  const DesignAnalysis& analysis = problem_.analyse(x, true);
  const std::size_t before = rows_.size();
  const auto add = [&](int scene, int term) {
    const Row probe{scene, term, {}};
    const CandidateChoice choice = choice_for(term_of(probe).output);
    for (const PeakCandidate& candidate :
         leading_candidates(term_of(probe), problem_.model(scene), analysis.cycles[static_cast<std::size_t>(scene)],
                            choice.margin, choice.most)) {
      rows_.insert({scene, term, candidate});
    }
  };
  for (int s = 0; s < considered_scenes(); ++s) {
    for (int k = 0; k < static_cast<int>(problem_.task().objective.size()); ++k) add(s, k);
  }
  for (int s = 0; s < problem_.scenes(); ++s) {
    for (int c = 0; c < static_cast<int>(problem_.task().constraints.size()); ++c) add(s, -1 - c);
  }
  return static_cast<int>(rows_.size() - before);
}

void EpigraphProgram::restart_from(const Eigen::VectorXd& x) {
  const DesignAnalysis& analysis = problem_.analyse(x, true);
  start_ = Eigen::VectorXd::Zero(variables());
  start_.head(problem_.variables()) = x;
  const auto& terms = problem_.task().objective;
  double worst = 0.0;
  for (int s = 0; s < considered_scenes(); ++s) {
    double sum = 0.0;
    for (int k = 0; k < static_cast<int>(terms.size()); ++k) {
      const double u = peak(analysis, s, k) / reference_[static_cast<std::size_t>(k)];
      double& slot = start_[auxiliary(s, k)];
      slot = std::max(slot, u);
      sum += terms[static_cast<std::size_t>(k)].weight * terms[static_cast<std::size_t>(k)].outside_factor() *
             reference_[static_cast<std::size_t>(k)] / objective_scale_ * u;
    }
    worst = std::max(worst, sum);
  }
  if (has_worst_row()) start_[variables() - 1] = worst;
}

ProgramValues EpigraphProgram::evaluate(const Eigen::VectorXd& y, bool with_gradients) {
  const Eigen::VectorXd x = design(y);
  const DesignAnalysis& analysis = problem_.analyse(x, true);
  log_.record(problem_, x, analysis);
  const DesignTask& task = problem_.task();
  const int n = problem_.variables(), terms = static_cast<int>(task.objective.size());
  ProgramValues values;
  values.constraints.resize(constraints());
  values.constraint_jacobian = Eigen::MatrixXd::Zero(constraints(), variables());
  values.objective_gradient = Eigen::VectorXd::Zero(variables());
  int r = 0;
  for (const Row& row : rows_) {
    const SmoothValue value = candidate_value(term_of(row), row.candidate, problem_.model(row.scene),
                                              analysis.cycles[static_cast<std::size_t>(row.scene)]);
    const double scale = is_bound(row) ? task.constraints[static_cast<std::size_t>(-1 - row.term)].maximum
                                       : reference_[static_cast<std::size_t>(row.term)];
    values.constraint_jacobian.row(r).head(n) = problem_.scaled(value.gradient) / scale;
    values.constraints[r] = value.value / scale;
    if (is_bound(row)) {
      values.constraints[r] -= 1.0;
    } else {
      const int u = auxiliary(row.scene, row.term);
      values.constraints[r] -= y[u];
      values.constraint_jacobian(r, u) = -1.0;
    }
    ++r;
  }
  const auto weight_of = [&](int k) {
    const ObjectiveTerm& term = task.objective[static_cast<std::size_t>(k)];
    return term.weight * term.outside_factor() * reference_[static_cast<std::size_t>(k)] / objective_scale_;
  };
  if (shares_one_bound()) {
    values.objective_gradient[n] = 1.0;
  } else if (has_worst_row()) {
    const int t = variables() - 1;
    values.objective_gradient[t] = 1.0;
    for (int s = 0; s < considered_scenes(); ++s, ++r) {
      for (int k = 0; k < terms; ++k) values.constraint_jacobian(r, auxiliary(s, k)) = weight_of(k);
      values.constraint_jacobian(r, t) = -1.0;
      values.constraints[r] = values.constraint_jacobian.row(r).dot(y);
    }
  } else {
    double total = 0.0;
    for (int s = 0; s < considered_scenes(); ++s) total += task.scenes[static_cast<std::size_t>(s)].weight;
    for (int s = 0; s < considered_scenes(); ++s) {
      for (int k = 0; k < terms; ++k) {
        values.objective_gradient[auxiliary(s, k)] = task.scenes[static_cast<std::size_t>(s)].weight / total * weight_of(k);
      }
    }
  }
  values.objective = values.objective_gradient.dot(y);
  if (!with_gradients) {
    values.objective_gradient.resize(0);
    values.constraint_jacobian.resize(0, 0);
  }
  return values;
}

}  // namespace flankwright
