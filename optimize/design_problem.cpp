#include "optimize/design_problem.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

struct Moments {
  double total_weight{0.0}, mean{0.0};
  double sigma{0.0};  ///< 0 where the spread is round-off
};

Moments moments_of(const std::vector<double>& measures, const std::vector<double>& weights) {
  Moments m;
  double variance = 0.0;
  for (double w : weights) m.total_weight += w;
  for (std::size_t s = 0; s < measures.size(); ++s) m.mean += weights[s] / m.total_weight * measures[s];
  for (std::size_t s = 0; s < measures.size(); ++s) {
    variance += weights[s] / m.total_weight * std::pow(measures[s] - m.mean, 2);
  }
  // Scenes that mirror each other differ by round-off only, which has no direction to descend: sigma <= 1e-12 |mean| is none.
  const double sigma = std::sqrt(variance);
  m.sigma = sigma > 1e-12 * std::abs(m.mean) ? sigma : 0.0;
  return m;
}

/// Harmonics can be told apart only where positions are equally spaced over a pitch and more than two to a period.
void check_harmonics(const DesignTask& task) {
  const std::vector<double>& phases = task.resolution.phases;
  const int n = static_cast<int>(phases.size());
  const auto check = [&](const ObjectiveTerm& term) {
    if (term.output != Output::TeHarmonic) return;
    if (phases != equally_spaced_phases(n)) {
      throw InvalidInput("cycle.phases", "a list", "none for " + term.name + ": set cycle.positions");
    }
    const int least = 2 * term.harmonic + 1;
    if (n < least) {
      throw InvalidInput("cycle.positions", std::to_string(n), "at least " + std::to_string(least) + " for " + term.name);
    }
  };
  for (const ObjectiveTerm& term : task.objective) check(term);
  for (const OutputConstraint& constraint : task.constraints) check(constraint.output);
}

void check_root_stress(const DesignTask& task) {
  const auto wants = [](const ObjectiveTerm& term) { return term.output == Output::PeakRootStress; };
  const bool wanted = std::any_of(task.objective.begin(), task.objective.end(), wants) ||
                      std::any_of(task.constraints.begin(), task.constraints.end(),
                                  [&](const OutputConstraint& constraint) { return wants(constraint.output); });
  if (wanted && !task.root_stress) {
    throw InvalidInput("peak_root_stress", "no model of root stress", "the effect root_stress");
  }
}

}  // namespace

DesignProblem::DesignProblem(DesignTask task) : task_(std::move(task)) {
  if (task_.scenes.empty()) throw InvalidInput("scenes", "none", "at least one scene");
  if (task_.variables.empty()) throw InvalidInput("optimise.variables", "none", "at least one variable");
  if (task_.objective.empty()) throw InvalidInput("optimise.objective", "none", "at least one output");
  check_harmonics(task_);
  check_root_stress(task_);
  for (const DesignVariable& v : task_.variables) {
    if (!(v.lower < v.upper)) throw InvalidInput("optimise.variables." + v.path, "an empty range", "lower < upper");
    parameters_.push_back(GearParameter{v.member, v.parameter});
  }
  for (const DesignScene& scene : task_.scenes) {
    if (!(scene.torque > 0.0)) throw InvalidInput("load.torque", std::to_string(scene.torque), "above 0 to optimise");
    const MeshPlacement placement = MeshPlacement::of(task_.gap, scene.condition.misalignment);
    std::unique_ptr<MeshModel>& model = models_by_placement_[placement];
    if (!model) {
      model = std::make_unique<MeshModel>(make_mesh_model(task_.pair, task_.pinion_material, task_.wheel_material,
                                                          task_.resolution, task_.effects, placement, task_.structure.get(),
                                                          task_.root_stress.get(), task_.shafts.get()));
    }
    models_.push_back(model.get());
  }
}

Eigen::VectorXd DesignProblem::start() const {
  Eigen::VectorXd x(variables());
  for (int i = 0; i < variables(); ++i) {
    const DesignVariable& v = task_.variables[static_cast<std::size_t>(i)];
    const Modification& given = v.member == Member::Pinion ? task_.pinion_modification : task_.wheel_modification;
    x[i] = std::clamp((get(given, v.parameter) - v.lower) / (v.upper - v.lower), 0.0, 1.0);
  }
  return x;
}

double DesignProblem::unscaled(const Eigen::VectorXd& x, int i) const {
  const DesignVariable& v = task_.variables[static_cast<std::size_t>(i)];
  return v.lower + x[i] * (v.upper - v.lower);
}

void DesignProblem::apply(const Eigen::VectorXd& x, Modification& pinion, Modification& wheel) const {
  pinion = task_.pinion_modification;
  wheel = task_.wheel_modification;
  for (int i = 0; i < variables(); ++i) {
    const DesignVariable& v = task_.variables[static_cast<std::size_t>(i)];
    set(v.member == Member::Pinion ? pinion : wheel, v.parameter, unscaled(x, i));
  }
}

LoadedCycle DesignProblem::analyse_scene(int scene, const Modification& pinion, const Modification& wheel,
                                         const std::vector<MeshParameter>& parameters) const {
  const DesignScene& of_task = task_.scenes[static_cast<std::size_t>(scene)];
  FlankCondition condition = of_task.condition;
  condition.pinion_modification = pinion;
  condition.wheel_modification = wheel;
  return analyse_cycle(model(scene), condition, of_task.torque, parameters);
}

DesignAnalysis DesignProblem::run(const Modification& pinion, const Modification& wheel, bool with_derivatives) const {
  DesignAnalysis analysis{pinion, wheel, std::vector<LoadedCycle>(task_.scenes.size())};
  const std::vector<MeshParameter> none;
  tbb::parallel_for(0, scenes(), [&](int s) {
    analysis.cycles[static_cast<std::size_t>(s)] = analyse_scene(s, pinion, wheel, with_derivatives ? parameters_ : none);
  });
  return analysis;
}

const DesignAnalysis& DesignProblem::analyse(const Eigen::VectorXd& x, bool with_derivatives) {
  const bool known = last_x_.size() == x.size() && last_x_ == x && (last_has_derivatives_ || !with_derivatives);
  if (known) return last_;
  Modification pinion, wheel;
  apply(x, pinion, wheel);
  last_ = run(pinion, wheel, with_derivatives);
  last_x_ = x;
  last_has_derivatives_ = with_derivatives;
  ++analyses_;
  return last_;
}

DesignAnalysis DesignProblem::analyse_given() const {
  return run(task_.pinion_modification, task_.wheel_modification, false);
}

double DesignProblem::scene_measure(const DesignAnalysis& analysis, int scene) const {
  return scene_measure(analysis.cycles[static_cast<std::size_t>(scene)], scene);
}

double DesignProblem::scene_measure(const LoadedCycle& cycle, int scene) const {
  double sum = 0.0;
  for (const ObjectiveTerm& term : task_.objective) {
    sum += term.weight * term.outside_factor() * output_value(term, model(scene), cycle);
  }
  return sum;
}

double DesignProblem::objective(const DesignAnalysis& analysis) const {
  std::vector<double> measures, weights;
  for (int s = 0; s < scenes(); ++s) {
    measures.push_back(scene_measure(analysis, s));
    weights.push_back(task_.scenes[static_cast<std::size_t>(s)].weight);
  }
  return aggregate(task_.over, measures, weights);
}

double DesignProblem::constraint_value(const DesignAnalysis& analysis, const OutputConstraint& constraint) const {
  double largest = -INFINITY;
  for (int s = 0; s < scenes(); ++s) {
    largest = std::max(largest, output_value(constraint.output, model(s), analysis.cycles[static_cast<std::size_t>(s)]));
  }
  return largest;
}

Eigen::VectorXd DesignProblem::scaled(const Eigen::VectorXd& gradient) const {
  Eigen::VectorXd result = gradient;
  for (int i = 0; i < variables(); ++i) {
    const DesignVariable& v = task_.variables[static_cast<std::size_t>(i)];
    result[i] *= v.upper - v.lower;
  }
  return result;
}

std::vector<double> aggregate_weights(Aggregate over, const std::vector<double>& measures, const std::vector<double>& weights) {
  std::vector<double> result(measures.size(), 0.0);
  if (over == Aggregate::Nominal) {
    result.front() = 1.0;
    return result;
  }
  if (over == Aggregate::Worst) {
    result[static_cast<std::size_t>(std::max_element(measures.begin(), measures.end()) - measures.begin())] = 1.0;
    return result;
  }
  const Moments moments = moments_of(measures, weights);
  for (std::size_t s = 0; s < measures.size(); ++s) {
    result[s] = weights[s] / moments.total_weight;
    if (over == Aggregate::MeanPlusTwoSigma && moments.sigma > 0.0) {
      result[s] *= 1.0 + 2.0 * (measures[s] - moments.mean) / moments.sigma;
    }
  }
  return result;
}

double aggregate(Aggregate over, const std::vector<double>& measures, const std::vector<double>& weights) {
  if (over == Aggregate::Nominal) return measures.front();
  if (over == Aggregate::Worst) return *std::max_element(measures.begin(), measures.end());
  const Moments moments = moments_of(measures, weights);
  return over == Aggregate::Mean ? moments.mean : moments.mean + 2.0 * moments.sigma;
}

}  // namespace flankwright
