#include "optimize/design/problem/design_problem.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/load/cycle/mesh_motion.hpp"
#include "optimize/design/problem/for_each_in_parallel.hpp"
#include "optimize/design/problem/task_checks.hpp"

namespace flankwright {

namespace {

RootStresses root_stresses_for(const DesignTask& task) { return asks_for_root_stress(task) ? RootStresses::WithLoads : RootStresses::Later; }

}  // namespace

bool DesignAnalysis::usable() const { return std::ranges::all_of(cycles, &LoadedCycle::usable); }

DesignProblem::DesignProblem(DesignTask task) : task_(std::move(task)), root_stresses_(root_stresses_for(task_)) {
  check(task_);
  if (task_.scenes.empty()) throw InvalidInput("scenes", "none", "at least one scene");
  if (task_.variables.empty()) throw InvalidInput("optimise.variables", "none", "at least one variable");
  for (const DesignVariable& v : task_.variables) {
    if (!(v.lower < v.upper)) throw InvalidInput("optimise.variables." + v.path, "an empty range", "lower < upper");
    parameters_.push_back(GearParameter{v.member, v.parameter});
  }
  for (const LinkingConstraint& link : task_.links) {
    if (link.as >= task_.variables.size()) throw InvalidInput("optimise.ties." + link.linked.path, "no variable", "the index of a variable");
    parameters_.push_back(GearParameter{link.linked.member, link.linked.parameter});
  }
  set_box(Eigen::VectorXd::Zero(variables()), Eigen::VectorXd::Ones(variables()));
  std::map<MeshPlacement, std::shared_ptr<const MeshModel>> models;
  for (const DesignScene& scene : task_.scenes) {
    if (!(scene.torque > 0.0)) throw InvalidInput("load.torque", std::to_string(scene.torque), "above 0 to optimise");
    models.try_emplace(placement_of(task_.gap, scene.condition, task_.shafts.get(), scene.torque));
  }
  tbb::this_task_arena::isolate([&] { tbb::parallel_for_each(models, [this](auto& known) { known.second = shared_mesh(known.first); }); });
  for (const DesignScene& scene : task_.scenes) {
    models_.push_back(models.at(placement_of(task_.gap, scene.condition, task_.shafts.get(), scene.torque)));
  }
  find_fillets();
  for (const ModificationConstraint& c : task_.modification_constraints) {
    if (modification_scale(c) == 0.0) throw InvalidInput("optimise.constraints." + c.name, "no variable in it", "a sum that a variable changes");
  }
}

MeshModel DesignProblem::made_mesh(const MeshPlacement& placement, const std::vector<double>& phases) const {
  return make_mesh_model(task_.pair, task_.material, {task_.resolution.quadrature, phases}, task_.effects, placement,
                         {.structure = task_.structure.get(), .root_stress = task_.root_stress.get(), .shafts = task_.shafts.get()},
                         for_each_in_parallel);
}

std::shared_ptr<const MeshModel> DesignProblem::shared_mesh(const MeshPlacement& placement) const {
  const auto make = [&](const std::vector<double>& phases) { return made_mesh(placement, phases); };
  if (!task_.meshes) return std::make_shared<const MeshModel>(make(task_.resolution.phases));
  return task_.meshes->mesh({placement, task_.resolution, task_.effects.list(), task_.structure, task_.root_stress, task_.shafts}, make);
}

void DesignProblem::find_fillets() {
  fillets_.clear();
  const std::vector<ObjectiveTerm> terms = terms_of(task_);
  if (std::ranges::none_of(terms, [](const ObjectiveTerm& term) { return term.output == Output::RootDamage; })) return;
  std::map<const MeshModel*, std::shared_ptr<const PerGear<FilletPoints>>> known;
  for (const auto& model : models_) {
    auto& of_model = known[model.get()];
    if (!of_model) {
      of_model = std::make_shared<const PerGear<FilletPoints>>(
          PerGear<FilletPoints>{fillet_points(*model, Member::Pinion), fillet_points(*model, Member::Wheel)});
    }
    fillets_.push_back(of_model);
  }
}

LoadedScene DesignProblem::scene_of(const LoadedCycle& cycle, int scene) const {
  const auto at = static_cast<std::size_t>(scene);
  LoadedScene found{*models_[at], cycle, &task_.scenes[at].operation, task_.life.get()};
  if (!fillets_.empty()) found.fillets = fillets_[at].get();
  return found;
}

LoadedScene DesignProblem::scene(const DesignAnalysis& analysis, int scene) const {
  const auto at = static_cast<std::size_t>(scene);
  LoadedScene found = scene_of(analysis.cycles[at], scene);
  const int spectrum = task_.scenes[at].spectrum;
  if (spectrum < 0) return found;
  for (std::size_t s = 0; s < task_.scenes.size(); ++s) {
    const DesignScene& of = task_.scenes[s];
    if (of.spectrum == spectrum) found.spectrum.push_back({&analysis.cycles[s], of.operation});
  }
  return found;
}

std::vector<int> DesignProblem::judged_scenes(const ObjectiveTerm& term) const {
  const bool over_spectrum = design_output(term.output).over_spectrum;
  std::vector<int> judged;
  std::set<int> spectra;
  for (int s = 0; s < scenes(); ++s) {
    if (!over_spectrum || spectra.insert(task_.scenes[static_cast<std::size_t>(s)].spectrum).second) judged.push_back(s);
  }
  return judged;
}

DesignProblem DesignProblem::judged_by(const Objective& objective, std::vector<ObjectiveBound> bounds,
                                       std::vector<ScalarisedObjective> scalarisation) const {
  DesignProblem other = *this;
  other.task_.objective = objective.terms;
  other.task_.over = objective.over;
  other.task_.objective_bounds = std::move(bounds);
  other.task_.scalarisation = std::move(scalarisation);
  other.task_.later_objectives.clear();
  check(other.task_);
  other.root_stresses_ = root_stresses_for(other.task_);
  if (other.root_stresses_ != root_stresses_) other.last_x_.resize(0);
  other.find_fillets();
  other.analyses_ = 0;
  return other;
}

DesignProblem DesignProblem::over_scenes(const std::vector<int>& scenes) const {
  DesignProblem other = *this;
  const auto keep = [&scenes](auto& of_all) {
    if (of_all.empty()) return;
    std::remove_reference_t<decltype(of_all)> kept;
    for (const int s : scenes) kept.push_back(std::move(of_all[static_cast<std::size_t>(s)]));
    of_all = std::move(kept);
  };
  keep(other.task_.scenes);
  keep(other.models_);
  keep(other.fillets_);
  keep(other.last_.cycles);
  other.analyses_ = 0;
  return other;
}

DesignProblem DesignProblem::judged_by_excess() const {
  std::vector<ScalarisedObjective> excesses;
  std::vector<OutputConstraint> others;
  for (const OutputConstraint& bound : task_.constraints) {
    if (!bound.has_smooth_excess()) {
      others.push_back(bound);
      continue;
    }
    const auto [objective, limit] = bound_on(bound, Aggregate::Worst);
    excesses.push_back({objective, limit, std::abs(limit), bound.is_least()});
  }
  for (const ObjectiveBound& bound : task_.objective_bounds) excesses.push_back({bound.objective, bound.limit, bound.limit});
  DesignProblem other = judged_by(task_.combined_objective(), {}, std::move(excesses));
  other.task_.constraints = std::move(others);
  return other;
}

DesignProblem DesignProblem::with_wider_bounds(double share) const {
  DesignProblem other = *this;
  for (OutputConstraint& bound : other.task_.constraints) {
    double& limit = bound.is_least() ? bound.minimum : bound.maximum;
    limit += (bound.is_least() ? -share : share) * std::abs(limit);
  }
  for (ObjectiveBound& bound : other.task_.objective_bounds) bound.limit *= 1.0 + share;
  other.analyses_ = 0;
  return other;
}

Eigen::VectorXd DesignProblem::start() const {
  if (start_.size() > 0) return start_.cwiseMax(lower_).cwiseMin(upper_);
  Eigen::VectorXd x(variables());
  for (int i = 0; i < variables(); ++i) {
    const DesignVariable& v = task_.variables[static_cast<std::size_t>(i)];
    const Modification& given = task_.modification[v.member];
    x[i] = std::clamp(v.scaled(get(given, v.parameter)), lower_[i], upper_[i]);
  }
  return x;
}

Eigen::VectorXd DesignProblem::scaled_design(const std::vector<double>& values) const {
  Eigen::VectorXd x(variables());
  for (int i = 0; i < variables(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    x[i] = task_.variables[at].scaled(values[at]);
  }
  return x;
}

double DesignProblem::unscaled(const Eigen::VectorXd& x, int i) const { return task_.variables[static_cast<std::size_t>(i)].unscaled(x[i]); }

PerGear<Modification> DesignProblem::modification(const Eigen::VectorXd& x) const {
  PerGear<Modification> modification = task_.modification;
  for (int i = 0; i < variables(); ++i) {
    const DesignVariable& v = task_.variables[static_cast<std::size_t>(i)];
    set(modification[v.member], v.parameter, unscaled(x, i));
  }
  for (const LinkingConstraint& link : task_.links) {
    set(modification[link.linked.member], link.linked.parameter, link.factor * unscaled(x, static_cast<int>(link.as)) + link.offset);
  }
  return modification;
}

FlankCondition DesignProblem::condition(int scene, const PerGear<Modification>& modification) const {
  return task_.scenes[static_cast<std::size_t>(scene)].with_design(modification);
}

LoadedCycle DesignProblem::analyse_positions(int scene, std::span<const std::size_t> positions, const PerGear<Modification>& modification,
                                             const LoadedCycle* earlier) const {
  const double torque = task_.scenes[static_cast<std::size_t>(scene)].torque;
  return flankwright::analyse_positions(model(scene), positions, condition(scene, modification), torque, root_stresses_, earlier);
}

LoadedCycle DesignProblem::analyse_scene(int scene, const PerGear<Modification>& modification, const std::vector<MeshParameter>& parameters,
                                         const LoadedCycle* earlier) const {
  const double torque = task_.scenes[static_cast<std::size_t>(scene)].torque;
  const FlankCondition of_scene = condition(scene, modification);
  ++*cycles_;
  // Where the last scenes are fewer than the threads. With for_each_in_parallel() a thread that waits for the other half would take up no further scene.
  const ForEachIndex in_halves = [](std::size_t count, const std::function<void(std::size_t)>& work) {
    tbb::parallel_for(std::size_t{0}, count, work);
  };
  const auto analyse = [&](const MeshModel& mesh_model) {
    return analyse_cycle(mesh_model, of_scene, torque, parameters, root_stresses_, earlier, in_halves);
  };
  if (moving_among(task_.gap, parameters).empty()) return analyse(model(scene));
  const MeshPlaced placed = [this](const MeshPlacement& placement) { return made_mesh(placement, task_.resolution.phases); };
  return analyse(with_perturbed_meshes(model(scene), placed, parameters));
}

void DesignProblem::add_root_stress(DesignAnalysis& analysis) const {
  if (root_stresses_ == RootStresses::WithLoads) return;
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(0, scenes(), [&](int s) { flankwright::add_root_stress(model(s), analysis.cycles[static_cast<std::size_t>(s)]); }); });
}

DesignAnalysis DesignProblem::run(const PerGear<Modification>& modification, bool with_derivatives, DesignAnalysis earlier) const {
  DesignAnalysis analysis{modification, std::vector<LoadedCycle>(task_.scenes.size())};
  const std::vector<MeshParameter> none;
  const auto analyse = [&](int s) {
    const auto at = static_cast<std::size_t>(s);
    analysis.cycles[at] =
        analyse_scene(s, modification, with_derivatives ? parameters_ : none, earlier.cycles.empty() ? nullptr : &earlier.cycles[at]);
    if (!earlier.cycles.empty()) earlier.cycles[at] = {};  // here, where all threads do so: it takes some per cent of the time
  };
  // A thread that waits for its scenes must not take up another start of a multi-start meanwhile.
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, scenes(), analyse); });
  return analysis;
}

DesignAnalysis DesignProblem::analyse_some(const Eigen::VectorXd& x, const std::vector<int>& scenes, bool with_derivatives) const {
  DesignAnalysis analysis{modification(x), std::vector<LoadedCycle>(task_.scenes.size())};
  const std::vector<MeshParameter> none;
  const auto analyse = [&](std::size_t i) {
    analysis.cycles[static_cast<std::size_t>(scenes[i])] = analyse_scene(scenes[i], analysis.modification, with_derivatives ? parameters_ : none);
  };
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, scenes.size(), analyse); });
  return analysis;
}

const DesignAnalysis& DesignProblem::analyse(const Eigen::VectorXd& x, bool with_derivatives) {
  const bool known = last_x_.size() == x.size() && last_x_ == x && (last_has_derivatives_ || !with_derivatives);
  if (known) return last_;
  last_x_.resize(0);
  last_ = run(modification(x), with_derivatives, std::exchange(last_, {}));
  last_x_ = x;
  last_has_derivatives_ = with_derivatives;
  ++analyses_;
  return last_;
}

DesignAnalysis DesignProblem::analyse_given() const { return run(task_.modification, false); }

double DesignProblem::scene_measure(const Objective& objective, const LoadedCycle& cycle, int scene) const {
  double sum = 0.0;
  for (const ObjectiveTerm& term : objective.terms) {
    sum += term.weight * term.outside_factor() * output_value(term, scene_of(cycle, scene));
  }
  return sum;
}

double DesignProblem::scene_measure(const DesignAnalysis& analysis, int scene) const {
  return scene_measure(task_.combined_objective(), analysis, scene);
}

double DesignProblem::scene_measure(const Objective& objective, const DesignAnalysis& analysis, int scene) const {
  const LoadedScene there = this->scene(analysis, scene);
  double sum = 0.0;
  for (const ObjectiveTerm& term : objective.terms) sum += term.weight * term.outside_factor() * output_value(term, there);
  return sum;
}

std::vector<double> DesignProblem::scene_measures(const Objective& objective, const DesignAnalysis& analysis) const {
  std::vector<double> measures;
  std::map<int, double> of_spectrum;
  for (int s = 0; s < scenes(); ++s) {
    if (!objective.over_spectrum()) {
      measures.push_back(scene_measure(objective, analysis, s));
      continue;
    }
    const auto [known, is_new] = of_spectrum.try_emplace(task_.scenes[static_cast<std::size_t>(s)].spectrum, not_given);
    if (is_new) known->second = scene_measure(objective, analysis, s);
    measures.push_back(known->second);
  }
  return measures;
}

double DesignProblem::value(const Objective& objective, const DesignAnalysis& analysis) const {
  return aggregate(objective.over, scene_measures(objective, analysis), scene_weights());
}

double DesignProblem::objective(const DesignAnalysis& analysis) const {
  if (task_.scalarisation.empty()) return value(task_.combined_objective(), analysis);
  double largest = -INFINITY;
  for (const ScalarisedObjective& scalarised : task_.scalarisation) {
    largest = std::max(largest, scalarised.part(value(scalarised.objective, analysis)));
  }
  return largest;
}

double DesignProblem::constraint_value(const DesignAnalysis& analysis, const OutputConstraint& constraint) const {
  double extreme = not_given;
  for (const int s : judged_scenes(constraint.output)) {
    const double value = output_value(constraint.output, scene(analysis, s));
    extreme = constraint.is_least() ? std::fmin(extreme, value) : std::fmax(extreme, value);
  }
  return extreme;
}

double DesignProblem::violation(const DesignAnalysis& analysis) const {
  double worst = violation(analysis.modification);
  for (const OutputConstraint& c : task_.constraints) worst = std::max(worst, c.excess(constraint_value(analysis, c)));
  for (const ObjectiveBound& bound : task_.objective_bounds) worst = std::max(worst, value(bound.objective, analysis) / bound.limit - 1.0);
  return worst;
}

double DesignProblem::violation(const PerGear<Modification>& modification) const {
  double worst = 0.0;
  for (const ModificationConstraint& c : task_.modification_constraints) {
    const double sum = c.value(modification);
    worst = std::max(worst, std::max(sum - c.maximum, c.minimum - sum) / modification_scale(c));
  }
  return worst;
}

Eigen::VectorXd DesignProblem::modification_slope(const ModificationConstraint& constraint) const {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(variables() + static_cast<Eigen::Index>(task_.links.size()));
  for (const ModificationConstraint::Term& term : constraint.terms) {
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      const auto& parameter = std::get<GearParameter>(parameters_[p]);
      if (parameter.member == term.member && parameter.parameter == term.parameter) slope[static_cast<Eigen::Index>(p)] += term.factor;
    }
  }
  return scaled(slope);
}

double DesignProblem::modification_scale(const ModificationConstraint& constraint) const { return modification_slope(constraint).cwiseAbs().sum(); }

std::vector<double> DesignProblem::scene_weights() const {
  std::vector<double> weights;
  for (const DesignScene& scene : task_.scenes) weights.push_back(scene.weight);
  return weights;
}

Eigen::VectorXd DesignProblem::scaled(Eigen::VectorXd gradient, const DesignAnalysis& analysis, int scene) const {
  for (const ModificationDeviation& deviation : task_.scenes[static_cast<std::size_t>(scene)].deviations) {
    if (!deviation.is_cut(analysis.modification)) continue;
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      const auto& parameter = std::get<GearParameter>(parameters_[p]);
      if (parameter.member == deviation.member && parameter.parameter == deviation.parameter) gradient[static_cast<Eigen::Index>(p)] = 0.0;
    }
  }
  return scaled(gradient);
}

Eigen::VectorXd DesignProblem::scaled(const Eigen::VectorXd& gradient) const {
  const Eigen::Index n = variables();
  Eigen::VectorXd result = gradient.head(n);
  for (std::size_t t = 0; t < task_.links.size(); ++t) {
    result[static_cast<Eigen::Index>(task_.links[t].as)] += task_.links[t].factor * gradient[n + static_cast<Eigen::Index>(t)];
  }
  for (int i = 0; i < n; ++i) {
    const DesignVariable& v = task_.variables[static_cast<std::size_t>(i)];
    result[i] *= v.upper - v.lower;
  }
  return result;
}

}  // namespace flankwright
