#include "optimize/proof/optimum.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/nonnegative_least_squares.hpp"

namespace flankwright {

namespace {

/// A multiplier to be found.
struct Column {
  enum class Kind { Peak, Constraint, Sum, Bound } kind;
  int index;              ///< scene, constraint, variable
  int term;               ///< of the objective
  bool upper;             ///< of a Sum or Bound
  double sign;            ///< of a Peak: -1 where the objective falls with it
  double slack;           ///< how far it is from touching, >= 0
  Eigen::VectorXd slope;  ///< of the function, by the step of each parameter; of a Sum by the scaled variables; of a Bound none
};

/// Candidates within near_within * scale of the leading one.
std::vector<LocalModel::Candidate> near_of(const LocalModel::Peak& peak, double scale) {
  std::vector<LocalModel::Candidate> near;
  for (const LocalModel::Candidate& c : peak.candidates) {
    if (c.value >= peak.candidates.front().value - near_within * scale) near.push_back(c);
  }
  return near;
}

/// Scenes that the objective may depend on, with the weight that is already known; NaN: to be found, one together.
std::vector<Optimum::Scene> near_scenes(const DesignTask& task, const std::vector<double>& measures) {
  std::vector<Optimum::Scene> scenes;
  if (task.over == Aggregate::Worst) {
    const double worst = *std::max_element(measures.begin(), measures.end());
    for (std::size_t s = 0; s < measures.size(); ++s) {
      if (measures[s] >= worst - near_within * std::abs(worst)) scenes.push_back({static_cast<int>(s), not_given});
    }
    return scenes;
  }
  std::vector<double> weights;
  for (const DesignScene& scene : task.scenes) weights.push_back(scene.weight);
  const std::vector<double> slope = aggregate_weights(task.over, measures, weights);
  for (std::size_t s = 0; s < slope.size(); ++s) {
    if (slope[s] != 0.0) scenes.push_back({static_cast<int>(s), slope[s]});
  }
  return scenes;
}

/// Columns of the sums of modifications that are at a limit.
void add_sums(const DesignProblem& problem, const std::vector<double>& values, std::vector<Column>& columns) {
  Eigen::VectorXd x(problem.variables());
  for (int i = 0; i < problem.variables(); ++i) {
    const DesignVariable& v = problem.task().variables[static_cast<std::size_t>(i)];
    x[i] = (values[static_cast<std::size_t>(i)] - v.lower) / (v.upper - v.lower);
  }
  Modification pinion, wheel;
  problem.apply(x, pinion, wheel);
  for (std::size_t c = 0; c < problem.task().modification_constraints.size(); ++c) {
    const ModificationConstraint& bound = problem.task().modification_constraints[c];
    const double scale = problem.modification_scale(bound), sum = bound.value(pinion, wheel);
    const double above = (bound.maximum - sum) / scale, below = (sum - bound.minimum) / scale;
    const Eigen::VectorXd slope = problem.modification_slope(bound) / scale;
    if (above <= near_within) columns.push_back({Column::Kind::Sum, static_cast<int>(c), 0, true, 1.0, std::abs(above), slope});
    if (below <= near_within) columns.push_back({Column::Kind::Sum, static_cast<int>(c), 0, false, 1.0, std::abs(below), -slope});
  }
}

std::vector<Column> columns_of(const DesignProblem& problem, const LocalModel& model, const std::vector<Optimum::Scene>& scenes,
                               const std::vector<double>& values, double objective) {
  const DesignTask& task = problem.task();
  std::vector<Column> columns;
  for (const Optimum::Scene& scene : scenes) {
    const double sign = scene.weight < 0.0 ? -1.0 : 1.0;
    for (std::size_t k = 0; k < task.objective.size(); ++k) {
      const LocalModel::Peak& peak = model.measure(scene.scene)[k];
      for (const LocalModel::Candidate& c : near_of(peak, objective)) {
        const double slack = (peak.candidates.front().value - c.value) / objective;
        columns.push_back({Column::Kind::Peak, scene.scene, static_cast<int>(k), false, sign, slack, sign * c.slope});
      }
    }
  }
  for (int c = 0; c < model.constraints(); ++c) {
    for (const LocalModel::Peak& peak : model.constraint(c)) {
      for (const LocalModel::Candidate& candidate : near_of(peak, 1.0)) {  // excesses count in the bound
        if (candidate.value < -near_within) continue;
        columns.push_back({Column::Kind::Constraint, c, 0, false, 1.0, std::abs(candidate.value), candidate.slope});
      }
    }
  }
  add_sums(problem, values, columns);
  for (std::size_t i = 0; i < task.variables.size(); ++i) {
    const DesignVariable& v = task.variables[i];
    const double scaled = (values[i] - v.lower) / (v.upper - v.lower);
    for (const bool upper : {false, true}) {
      const double slack = std::abs(scaled - (upper ? 1.0 : 0.0));
      if (slack <= near_within) columns.push_back({Column::Kind::Bound, static_cast<int>(i), 0, upper, 1.0, slack, {}});
    }
  }
  return columns;
}

/// Rows of the least squares: a variable each, then what the weights of the scenes have to be, then slack * multiplier of every column.
struct Balance {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};

Balance balance_of(const DesignTask& task, const std::vector<ProofParameter>& parameters, const std::vector<Column>& columns,
                   const std::vector<Optimum::Scene>& scenes, const std::vector<double>& scene_slack, double objective) {
  constexpr double firm = 100.0;  // weights are kept to 1e-4 of the residual
  const auto n = static_cast<Eigen::Index>(task.variables.size()), terms = static_cast<Eigen::Index>(task.objective.size());
  const auto count = static_cast<Eigen::Index>(scenes.size());
  const bool sought = task.over == Aggregate::Worst;
  const Eigen::Index first = n, last = n + count * terms;  // rows of the weights; the last one: they are one together
  const Eigen::Index multipliers = static_cast<Eigen::Index>(columns.size()) + (sought ? count : 0), rows = last + 1 + multipliers;
  Balance balance{Eigen::MatrixXd::Zero(rows, multipliers), Eigen::VectorXd::Zero(rows)};
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const Column& column = columns[j];
    auto of_column = balance.A.col(static_cast<Eigen::Index>(j));
    of_column[last + 1 + static_cast<Eigen::Index>(j)] = column.slack;
    if (column.kind == Column::Kind::Bound) {
      of_column[column.index] = column.upper ? 1.0 : -1.0;
      continue;
    }
    if (column.kind == Column::Kind::Sum) {
      of_column.head(n) = column.slope;
      continue;
    }
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const int variable = parameters[p].variable;
      if (variable < 0) continue;
      const DesignVariable& v = task.variables[static_cast<std::size_t>(variable)];
      const double scale = column.kind == Column::Kind::Peak ? objective : 1.0;
      of_column[variable] = column.slope[static_cast<Eigen::Index>(p)] * (v.upper - v.lower) / parameters[p].inside / scale;
    }
    if (column.kind != Column::Kind::Peak) continue;
    const auto at = std::find_if(scenes.begin(), scenes.end(), [&](const Optimum::Scene& s) { return s.scene == column.index; });
    of_column[first + (at - scenes.begin()) * terms + column.term] = firm;
  }
  // The candidates of each term share the weight of their scene: known, or one of the unknown weights that are one together.
  for (Eigen::Index s = 0; s < count; ++s) {
    for (Eigen::Index k = 0; k < terms; ++k) {
      const Eigen::Index row = first + s * terms + k;
      if (sought) {
        balance.A(row, static_cast<Eigen::Index>(columns.size()) + s) = -firm;
      } else {
        balance.b[row] = firm * std::abs(scenes[static_cast<std::size_t>(s)].weight);
      }
    }
    if (!sought) continue;
    const Eigen::Index of_scene = static_cast<Eigen::Index>(columns.size()) + s;
    balance.A(last, of_scene) = firm;
    balance.A(last + 1 + of_scene, of_scene) = scene_slack[static_cast<std::size_t>(s)];
  }
  if (sought) balance.b[last] = firm;
  return balance;
}

std::vector<Sensitivity> sensitivities_of(const DesignTask& task, const LocalModel& model, const std::vector<ProofParameter>& parameters,
                                          const std::vector<double>& values, const Eigen::VectorXd& lagrangian) {
  std::vector<Sensitivity> sensitivities;
  const auto m = static_cast<Eigen::Index>(parameters.size());
  const double now = model.objective(Eigen::VectorXd::Zero(m));
  for (Eigen::Index p = 0; p < m; ++p) {
    Sensitivity found{.parameter = parameters[static_cast<std::size_t>(p)]};
    const Eigen::VectorXd step = Eigen::VectorXd::Unit(m, p);
    found.less = model.objective(-step) - now;
    found.more = model.objective(step) - now;
    if (const int i = found.parameter.variable; i >= 0) {
      const DesignVariable& v = task.variables[static_cast<std::size_t>(i)];
      const double slack = at_bound * (v.upper - v.lower), value = values[static_cast<std::size_t>(i)];
      found.can_less = value - found.parameter.inside >= v.lower - slack;
      found.can_more = value + found.parameter.inside <= v.upper + slack;
    } else {
      found.optimised_anew = lagrangian[p];
    }
    sensitivities.push_back(found);
  }
  return sensitivities;
}

}  // namespace

Optimum find_optimum(const DesignProblem& problem, const LocalModel& model, const std::vector<ProofParameter>& parameters,
                     const std::vector<double>& values) {
  const DesignTask& task = problem.task();
  const auto m = static_cast<Eigen::Index>(parameters.size());
  const Eigen::VectorXd nowhere = Eigen::VectorXd::Zero(m);
  const double objective = model.objective(nowhere), scale = std::max(std::abs(objective), 1e-300);
  const std::vector<double> measures = model.scene_measures(nowhere);
  std::vector<Optimum::Scene> scenes = near_scenes(task, measures);
  std::vector<double> scene_slack;
  for (const Optimum::Scene& s : scenes) scene_slack.push_back((objective - measures[static_cast<std::size_t>(s.scene)]) / scale);
  const std::vector<Column> columns = columns_of(problem, model, scenes, values, scale);
  const Balance balance = balance_of(task, parameters, columns, scenes, scene_slack, scale);
  const Eigen::VectorXd y = nonnegative_least_squares(balance.A, balance.b);

  Optimum optimum;
  optimum.residual = (balance.A * y - balance.b).head(static_cast<Eigen::Index>(task.variables.size())).lpNorm<Eigen::Infinity>();
  Eigen::VectorXd lagrangian = nowhere;  // slope by the step of each parameter [outside units]
  std::vector<double> of_constraint(task.constraints.size(), 0.0);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const Column& column = columns[j];
    const double multiplier = y[static_cast<Eigen::Index>(j)];
    switch (column.kind) {
      case Column::Kind::Peak: lagrangian += multiplier * column.slope; break;
      case Column::Kind::Constraint:
        lagrangian += scale * multiplier * column.slope;
        of_constraint[static_cast<std::size_t>(column.index)] += multiplier;
        break;
      case Column::Kind::Sum: {
        const ModificationConstraint& bound = task.modification_constraints[static_cast<std::size_t>(column.index)];
        const double step = proof_step(bound.unit()) / bound.outside_factor();
        if (multiplier > felt) optimum.sums.push_back({column.index, column.upper, -scale * multiplier * step / problem.modification_scale(bound)});
        break;
      }
      case Column::Kind::Bound: {
        if (multiplier <= felt && column.slack > at_bound) break;
        const DesignVariable& v = task.variables[static_cast<std::size_t>(column.index)];
        const auto p = std::find_if(parameters.begin(), parameters.end(), [&](const ProofParameter& q) { return q.variable == column.index; });
        optimum.bounds.push_back({column.index, column.upper, -scale * multiplier * p->inside / (v.upper - v.lower)});
        break;
      }
    }
  }
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (task.over == Aggregate::Worst) scenes[s].weight = y[static_cast<Eigen::Index>(columns.size() + s)];
    if (std::abs(scenes[s].weight) > felt) optimum.scenes.push_back(scenes[s]);
  }
  for (std::size_t c = 0; c < of_constraint.size(); ++c) {
    if (of_constraint[c] > felt) optimum.constraints.push_back({static_cast<int>(c), -0.01 * scale * of_constraint[c]});
  }
  std::stable_sort(optimum.scenes.begin(), optimum.scenes.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
  const auto by_gain = [](const auto& a, const auto& b) { return a.gain < b.gain; };
  std::stable_sort(optimum.bounds.begin(), optimum.bounds.end(), by_gain);
  std::stable_sort(optimum.constraints.begin(), optimum.constraints.end(), by_gain);
  std::stable_sort(optimum.sums.begin(), optimum.sums.end(), by_gain);
  optimum.sensitivities = sensitivities_of(task, model, parameters, values, lagrangian);
  return optimum;
}

}  // namespace flankwright
