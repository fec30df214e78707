#include "optimize/design/search/epigraph_program.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

using Kind = EpigraphRow::Kind;

/// The candidates that add_candidates() takes: within `margin` of the peak, at most `most` per output and scene.
struct CandidateChoice {
  double margin;
  std::size_t most;
};

/// Stresses and loads: half the peak, which on the design problems tried is one round of solving instead of three. Differences of
/// f_t come in pairs of positions, of which the leading ones are enough.
CandidateChoice choice_for(Output output, double leading_share) {
  const auto within = [&](double margin, std::size_t most) { return CandidateChoice{std::min(margin, leading_share), most}; };
  switch (output) {
    case Output::TePeakToPeak:
      return within(0.15, 60);
    case Output::ContactDamage:
    case Output::RootDamage:
      return within(0.98, 100);  // that is a quarter of the stress: damage grows as some 10th power of it
    case Output::SpecificFilmThickness:
      return within(0.3, 200);
    default:
      return within(0.5, 400);
  }
}

constexpr double auxiliary_limit = 100.0;  // u <= 100 of what it is counted in: no active bound at any sensible design

/// A harmonic's amplitude is itself a candidate where it exceeds this fraction of its largest at the start: far from
/// its kink.
constexpr double away_from_zero = 0.01;

/// Largest over the scenes that count, or one outside unit where an output is 0 there.
double largest_peak(const DesignProblem& problem, const DesignAnalysis& analysis, const Objective& objective, const ObjectiveTerm& term) {
  double largest = 0.0;
  for (const int s : problem.judged_scenes(term)) {
    largest = std::max(largest, output_value(term, problem.scene(analysis, s)));
    if (objective.over == Aggregate::Nominal) break;
  }
  return largest > 0.0 ? largest : 1.0 / term.outside_factor();
}

/// Scale of an objective's outputs [inside units]: their peaks at the start, but no less than a tenth of the
/// objective's value there or of its range [outside unit], to which an output near 0 at the start may rise.
std::vector<double> units_of(const DesignProblem& problem, const DesignAnalysis& analysis, const Objective& objective, double range) {
  constexpr double least_share = 0.1;
  std::vector<double> units, outside;
  double total = 0.0;
  for (const ObjectiveTerm& term : objective.terms) {
    units.push_back(largest_peak(problem, analysis, objective, term));
    outside.push_back(term.weight * term.outside_factor());
    total += outside.back() * units.back();
  }
  for (std::size_t k = 0; k < units.size(); ++k) units[k] = std::max(units[k], least_share * std::max(total, range) / outside[k]);
  return units;
}

}  // namespace

EpigraphProgram::EpigraphProgram(DesignProblem& problem, DesignLog& log) : problem_(problem), log_(log) {
  const Eigen::VectorXd x = problem.start();
  const DesignAnalysis& analysis = problem.analyse(x, true);
  log.record(problem, x, analysis);
  const DesignTask& task = problem.task();
  variables_ = problem.variables();
  const auto add_block = [&](const Objective& objective, double range) {
    const std::vector<int> scenes = problem.judged_scenes(objective.terms.front());
    const std::vector<double> all = problem.scene_weights();
    std::vector<double> weights;
    for (const int s : scenes) weights.push_back(all[static_cast<std::size_t>(s)]);
    blocks_.emplace_back(objective, weights, units_of(problem, analysis, objective, range), variables_, scenes);
    variables_ += blocks_.back().variables();
  };
  for (const ScalarisedObjective& scalarised : task.scalarisation) add_block(scalarised.objective, scalarised.range);
  if (!is_scalarised()) add_block(task.combined_objective(), 0.0);
  for (const ObjectiveBound& bound : task.objective_bounds) add_block(bound.objective, bound.limit);
  if (is_scalarised()) ++variables_;  // tau, the last
  add_candidates(x);
  restart_from(x);
}

const ObjectiveTerm& EpigraphProgram::term_of(const EpigraphRow& row) const {
  return row.kind == Kind::OutputBound ? problem_.task().constraints[static_cast<std::size_t>(row.index)].output
                                       : blocks_[static_cast<std::size_t>(row.objective)].objective().terms[static_cast<std::size_t>(row.index)];
}

Eigen::VectorXd EpigraphProgram::lower() const {
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(variables());
  bound.head(problem_.variables()) = problem_.lower();
  if (is_scalarised()) bound[variables() - 1] = -auxiliary_limit;
  return bound;
}

Eigen::VectorXd EpigraphProgram::upper() const {
  Eigen::VectorXd bound = (2.0 * start_).cwiseMax(auxiliary_limit);  // a restart may lie beyond it
  bound.head(problem_.variables()) = problem_.upper();
  return bound;
}

int EpigraphProgram::add_candidates(const Eigen::VectorXd& x) {
  const DesignAnalysis& analysis = problem_.analyse(x, true);
  const std::size_t before = candidates_.size();
  const bool first = candidates_.empty();
  const auto add = [&](EpigraphRow row, double reference) {
    const ObjectiveTerm& term = term_of(row);
    const LoadedScene scene = problem_.scene(analysis, row.scene);
    const CandidateChoice choice = choice_for(term.output, problem_.task().leading_share);
    for (const PeakCandidate& candidate : leading_candidates(term, scene, choice.margin, choice.most)) {
      row.candidate = candidate;
      candidates_.insert(row);
    }
    if (first || term.output != Output::TeHarmonic) return;
    if (output_value(term, scene) < away_from_zero * reference) return;
    row.candidate = whole_output;
    candidates_.insert(row);
  };
  for (int g = 0; g < static_cast<int>(blocks_.size()); ++g) {
    const ObjectiveBlock& block = blocks_[static_cast<std::size_t>(g)];
    for (int s = 0; s < block.scenes(); ++s) {
      for (int k = 0; k < static_cast<int>(block.objective().terms.size()); ++k) add({Kind::Floor, block.scene(s), k, g}, block.peak(k));
    }
  }
  for (int c = 0; c < static_cast<int>(problem_.task().constraints.size()); ++c) {
    const OutputConstraint& bound = problem_.task().constraints[static_cast<std::size_t>(c)];
    if (bound.one_suffices()) continue;
    for (const int s : problem_.judged_scenes(bound.output)) add({Kind::OutputBound, s, c}, bound.limit());
  }
  return static_cast<int>(candidates_.size() - before);
}

void EpigraphProgram::restart_from(const Eigen::VectorXd& x) {
  const DesignAnalysis& analysis = problem_.analyse(x, true);
  start_ = Eigen::VectorXd::Zero(variables());
  start_.head(problem_.variables()) = x;
  for (ObjectiveBlock& block : blocks_) {
    if (block.objective().over == Aggregate::Quantile) {
      std::vector<double> measures;
      for (int s = 0; s < block.scenes(); ++s) measures.push_back(problem_.scene_measure(block.objective(), analysis, block.scene(s)));
      block.leave_out(measures);
    }
    for (int s = 0; s < block.scenes(); ++s) {
      if (block.leaves_out(s)) continue;
      for (int k = 0; k < static_cast<int>(block.objective().terms.size()); ++k) {
        const double peak = output_value(block.objective().terms[static_cast<std::size_t>(k)], problem_.scene(analysis, block.scene(s)));
        double& slot = start_[block.bound(s, k)];
        slot = std::max(slot, block.bound_for(peak, k).value);
      }
    }
    block.complete(start_);
  }
  if (is_scalarised()) {
    double& tau = start_[variables() - 1];
    tau = problem_.objective(analysis);
  }
  choose_rows(analysis);
  seen_by_rows_ = {};
}

void EpigraphProgram::choose_rows(const DesignAnalysis& analysis) {
  const DesignTask& task = problem_.task();
  rows_.clear();
  const auto leader = [&](EpigraphRow row) {
    row.candidate = leading_candidates(term_of(row), problem_.scene(analysis, row.scene), 0.0, 1).front();
    return row;
  };
  const auto falls_with = [&](const ObjectiveBlock& block, int scene) { return block.falls_with(start_, block.scene_of(scene)); };
  for (const EpigraphRow& row : candidates_) {
    const ObjectiveBlock* block = row.kind == Kind::Floor ? &blocks_[static_cast<std::size_t>(row.objective)] : nullptr;
    const bool counts = block == nullptr || !(falls_with(*block, row.scene) || block->leaves_out(block->scene_of(row.scene)));
    if (counts) rows_.push_back(row);
  }
  for (int g = 0; g < static_cast<int>(blocks_.size()); ++g) {
    const ObjectiveBlock& block = blocks_[static_cast<std::size_t>(g)];
    for (int s = 0; s < block.scenes(); ++s) {
      if (!block.falls_with(start_, s)) continue;
      for (int k = 0; k < static_cast<int>(block.objective().terms.size()); ++k) rows_.push_back(leader({Kind::Ceiling, block.scene(s), k, g}));
    }
    for (int r = 0; r < block.rows(); ++r) rows_.push_back({Kind::ObjectiveHelper, block.scene(r), -1, g});
  }
  for (int c = 0; c < static_cast<int>(task.constraints.size()); ++c) {
    if (!task.constraints[static_cast<std::size_t>(c)].one_suffices()) continue;
    for (const int s : problem_.judged_scenes(task.constraints[static_cast<std::size_t>(c)].output))
      rows_.push_back(leader({Kind::OutputBound, s, c}));
  }
  for (int i = 0; i < static_cast<int>(task.objective_bounds.size()); ++i) rows_.push_back({Kind::ObjectiveBound, -1, i, objectives_minimised() + i});
  for (int i = 0; i < static_cast<int>(task.scalarisation.size()); ++i) rows_.push_back({Kind::ScalarisedObjective, -1, i, i});
  for (int c = 0; c < static_cast<int>(task.modification_constraints.size()); ++c) {
    const ModificationConstraint& bound = task.modification_constraints[static_cast<std::size_t>(c)];
    if (std::isfinite(bound.maximum)) rows_.push_back({Kind::ModificationBound, -1, c, -1, {}, 1});
    if (std::isfinite(bound.minimum)) rows_.push_back({Kind::ModificationBound, -1, c, -1, {}, -1});
  }
}

bool EpigraphProgram::is_majorant() const {
  if (std::ranges::any_of(blocks_, &ObjectiveBlock::leaves_out_any)) return true;
  return std::any_of(rows_.begin(), rows_.end(), [&](const EpigraphRow& row) {
    return row.kind == Kind::Ceiling ||
           (row.kind == Kind::OutputBound && problem_.task().constraints[static_cast<std::size_t>(row.index)].one_suffices());
  });
}

void EpigraphProgram::write_objective(int at, const ObjectiveBlock& block, const Eigen::VectorXd& y, const std::function<Slope(double)>& excess,
                                      ProgramValues& values) const {
  const SmoothValue value = block.value(y);
  const Slope objective = block.objective_of(value.value), row = excess(objective.value);
  values.constraints[at] = row.value;
  values.constraint_jacobian.row(at) = row.by * objective.by * value.gradient;
}

void EpigraphProgram::write_row(const EpigraphRow& row, int at, const Eigen::VectorXd& y, const DesignAnalysis& analysis, ProgramValues& values) {
  const DesignTask& task = problem_.task();
  const int n = problem_.variables();
  auto jacobian = values.constraint_jacobian.row(at);
  double& by_output = by_output_[static_cast<std::size_t>(at)];
  switch (row.kind) {
    case Kind::Floor:
    case Kind::Ceiling: {
      const ObjectiveBlock& block = blocks_[static_cast<std::size_t>(row.objective)];
      const SmoothValue value = candidate_value(term_of(row), row.candidate, problem_.scene(analysis, row.scene));
      const double sign = row.kind == Kind::Floor ? 1.0 : -1.0;
      const int u = block.bound(block.scene_of(row.scene), row.index);
      const Slope least = block.bound_for(value.value, row.index);
      values.constraints[at] = sign * (least.value - y[u]);
      by_output = sign * least.by;
      jacobian.head(n) = by_output * problem_.scaled(value.gradient, analysis, row.scene);
      jacobian[u] = -sign;
      return;
    }
    case Kind::OutputBound: {
      const OutputConstraint& bound = task.constraints[static_cast<std::size_t>(row.index)];
      const SmoothValue value = candidate_value(bound.output, row.candidate, problem_.scene(analysis, row.scene));
      values.constraints[at] = bound.excess(value.value);
      by_output = (bound.is_least() ? -1.0 : 1.0) / std::abs(bound.limit());
      jacobian.head(n) = by_output * problem_.scaled(value.gradient, analysis, row.scene);
      return;
    }
    case Kind::ObjectiveBound: {
      const double factor = 1.0 / task.objective_bounds[static_cast<std::size_t>(row.index)].limit;
      const auto excess = [factor](double value) { return Slope{factor * value - 1.0, factor}; };
      return write_objective(at, blocks_[static_cast<std::size_t>(row.objective)], y, excess, values);
    }
    case Kind::ScalarisedObjective: {
      const ScalarisedObjective& scalarised = task.scalarisation[static_cast<std::size_t>(row.index)];
      const double factor = 1.0 / scalarised.range, shift = scalarised.origin / scalarised.range;
      const auto excess = [&](double value) {
        return scalarised.of_reciprocal ? Slope{scalarised.part(value), 1.0 / scalarised.range_at(value)} : Slope{factor * value - shift, factor};
      };
      write_objective(at, blocks_[static_cast<std::size_t>(row.objective)], y, excess, values);
      values.constraints[at] -= y[variables() - 1];
      jacobian[variables() - 1] = -1.0;
      return;
    }
    case Kind::ModificationBound: {
      const ModificationConstraint& bound = task.modification_constraints[static_cast<std::size_t>(row.index)];
      const double sum = bound.value(analysis.modification);
      const double scale = problem_.modification_scale(bound), sign = row.side;
      values.constraints[at] = sign * (sum - (row.side > 0 ? bound.maximum : bound.minimum)) / scale;
      jacobian.head(n) = sign / scale * problem_.modification_slope(bound);
      return;
    }
    case Kind::ObjectiveHelper:
      return;  // written by the block
  }
}

EpigraphProgram::SeenByRows EpigraphProgram::judged_by_rows(const Eigen::VectorXd& y, const ProgramValues& values) const {
  if (is_majorant()) return {};
  const DesignTask& task = problem_.task();
  Eigen::VectorXd least = Eigen::VectorXd::Zero(variables());  // the variables at what the rows ask for
  SeenByRows seen{.objective = 0.0, .violation = 0.0};
  for (int at = 0; at < constraints(); ++at) {
    const EpigraphRow& row = rows_[static_cast<std::size_t>(at)];
    if (row.kind == Kind::Floor) {
      const ObjectiveBlock& block = blocks_[static_cast<std::size_t>(row.objective)];
      const int u = block.bound(block.scene_of(row.scene), row.index);
      least[u] = std::max(least[u], values.constraints[at] + y[u]);
    } else if (row.kind == Kind::OutputBound || row.kind == Kind::ModificationBound) {
      seen.violation = std::max(seen.violation, values.constraints[at]);
    }
  }
  std::vector<double> objectives;  // outside units
  for (const ObjectiveBlock& block : blocks_) {
    block.complete(least);
    objectives.push_back(block.objective_of(block.value(least).value).value);
  }
  for (std::size_t i = 0; i < task.scalarisation.size(); ++i) seen.objective = std::max(seen.objective, task.scalarisation[i].part(objectives[i]));
  if (!is_scalarised()) seen.objective = this->seen(objectives.front());
  for (std::size_t i = 0; i < task.objective_bounds.size(); ++i) {
    const double value = objectives[static_cast<std::size_t>(objectives_minimised()) + i];
    seen.violation = std::max(seen.violation, value / task.objective_bounds[i].limit - 1.0);
  }
  return seen;
}

ProgramValues EpigraphProgram::evaluate(const Eigen::VectorXd& y, bool with_gradients) {
  const Eigen::VectorXd x = design(y);
  const DesignAnalysis& analysis = problem_.analyse(x, true);
  log_.record(problem_, x, analysis);
  ProgramValues values;
  values.constraints = Eigen::VectorXd::Zero(constraints());
  values.constraint_jacobian = Eigen::MatrixXd::Zero(constraints(), variables());
  by_output_.assign(rows_.size(), 0.0);
  for (int at = 0; at < constraints(); ++at) {
    const EpigraphRow& row = rows_[static_cast<std::size_t>(at)];
    if (row.kind == Kind::ObjectiveHelper) {
      const ObjectiveBlock& block = blocks_[static_cast<std::size_t>(row.objective)];
      if (row.scene == block.scene(0)) block.write_rows(y, at, values);
    }
    write_row(row, at, y, analysis, values);
  }
  seen_by_rows_ = judged_by_rows(y, values);
  if (is_scalarised()) {
    values.objective = y[variables() - 1];
    values.objective_gradient = Eigen::VectorXd::Unit(variables(), variables() - 1);
  } else {
    SmoothValue value = blocks_.front().value(y);
    values.objective = value.value;
    values.objective_gradient = std::move(value.gradient);
  }
  if (!with_gradients) {
    values.objective_gradient.resize(0);
    values.constraint_jacobian.resize(0, 0);
  }
  return values;
}

}  // namespace flankwright
