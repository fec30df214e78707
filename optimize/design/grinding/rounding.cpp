#include "optimize/design/grinding/rounding.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "optimize/design/grinding/deciding_positions.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/search/local_model.hpp"

namespace flankwright {

namespace {

/// Number of scenes that a design must pass one by one before all are analysed in parallel.
constexpr std::size_t scenes_tried_first = 4;
/// Number of designs whose first scenes are analysed in parallel. It does not depend on the threads, so that nothing else does.
constexpr std::size_t tried_together = 16;

constexpr double round_off = 1e-9;  // of a step: a bound that is a multiple of it counts as one

/// Sets a variable to a number of its steps, the nearest within DesignProblem::set_box().
void place(const DesignProblem& problem, Eigen::VectorXd& x, int i, double steps) {
  const DesignVariable& v = problem.task().variables[static_cast<std::size_t>(i)];
  const double least = std::ceil(problem.unscaled(problem.lower(), i) / v.step - round_off);
  const double most = std::floor(problem.unscaled(problem.upper(), i) / v.step + round_off);
  x[i] = std::clamp(v.scaled(std::clamp(steps, least, std::max(least, most)) * v.step), problem.lower()[i], problem.upper()[i]);
}

Eigen::VectorXd moved(const DesignProblem& problem, const Eigen::VectorXd& from, int i, int by) {
  Eigen::VectorXd x = from;
  place(problem, x, i, std::round(problem.unscaled(from, i) / problem.task().variables[static_cast<std::size_t>(i)].step) + by);
  return x;
}

/// Whether another modification is tied to a variable.
bool is_followed(const DesignProblem& problem, int i) {
  return std::ranges::any_of(problem.task().links, [&](const LinkingConstraint& link) { return link.as == static_cast<std::size_t>(i); });
}

std::vector<int> stepped_variables(const DesignProblem& problem) {
  std::vector<int> stepped;
  for (int i = 0; i < problem.variables(); ++i) {
    if (problem.task().variables[static_cast<std::size_t>(i)].step > 0.0) stepped.push_back(i);
  }
  return stepped;
}

/// A search over whole numbers of steps; variables without a step keep their values. A worst case is no better where one scene
/// already reaches the best so far, or one position of it: the scenes that governed last are tried first, of each the positions that decided, and most
/// designs go no further. Loads start from those of the best design.
class StepSearch {
 public:
  StepSearch(DesignProblem& problem, const Eigen::VectorXd& x, int most_analyses) : problem_(problem), most_(most_analyses), exact_(x), x_(x) {
    const DesignAnalysis& exact = problem_.analyse(x, false);
    if (exact.usable()) exact_objective_ = problem_.objective(exact);
    stepped_ = stepped_variables(problem);
    for (const int i : stepped_) place(problem_, x_, i, std::round(problem.unscaled(x, i) / variable(i).step));
    first_.resize(static_cast<std::size_t>(problem.scenes()));
    std::iota(first_.begin(), first_.end(), 0);
    if (most_ > 1 && std::isfinite(exact_objective_) && problem.task().scalarisation.empty()) {
      std::vector<AssessedParameter> parameters;
      for (const int i : stepped_) {
        const DesignVariable& v = variable(i);
        parameters.push_back(parameter_of_variable(problem.task(), i, v.step * v.outside_factor()));
      }
      model_.emplace(problem, problem.modification(x), parameters);
      x_ = corners().front();
    }
    take(judge(x_));
  }

  RoundedDesign run() {
    while (improve_singly(1) || improve_in_pairs(1)) {
    }
    if (is_dear()) {
      try_corners();
      while (improve_singly(1) || improve_in_pairs(1) || improve_singly(2) || improve_in_pairs(2)) {
      }
    }
    leave_out_idle();
    return best_;
  }

 private:
  const DesignVariable& variable(int i) const { return problem_.task().variables[static_cast<std::size_t>(i)]; }

  /// The design analysed last.
  RoundedDesign judge(const Eigen::VectorXd& x) {
    ++analyses_;
    RoundedDesign design{x};
    const DesignAnalysis& analysis = problem_.analyse(x, false);
    const bool usable = analysis.usable();
    design.objective = usable ? problem_.objective(analysis) : INFINITY;
    design.constraint_violation = usable ? problem_.violation(analysis) : INFINITY;
    design.modification_violation = problem_.violation(problem_.modification(x));
    design.analyses = analyses_;
    if (model_ && usable) {
      const Predicted predicted = predict(x);
      objective_margin_ = std::max(objective_margin_, predicted.objective - design.objective);
      violation_margin_ = std::max(violation_margin_, predicted.violation - design.constraint_violation);
    }
    return design;
  }

  /// By the model at the exact design.
  struct Predicted {
    double modification_violation{0.0}, violation{0.0}, objective{0.0};  ///< violations that are within the tolerance are 0
    auto operator<=>(const Predicted&) const = default;
  };
  Predicted predict(const Eigen::VectorXd& x) const {
    Eigen::VectorXd steps(std::ssize(stepped_));
    for (std::size_t k = 0; k < stepped_.size(); ++k) {
      const int i = stepped_[k];
      steps[static_cast<Eigen::Index>(k)] = (problem_.unscaled(x, i) - problem_.unscaled(exact_, i)) / variable(i).step;
    }
    const double of_modification = problem_.violation(problem_.modification(x));
    return {DesignLog::beyond_tolerance(of_modification), DesignLog::beyond_tolerance(std::max(model_->violation(steps), of_modification)),
            model_->objective(steps)};
  }
  /// Whether the model leaves hope that a design is better than the best.
  bool is_promising(const Eigen::VectorXd& x) const {
    if (!model_) return true;
    const Predicted predicted = predict(x);
    const double violation = std::max(dear_rounding, violation_margin_);
    if (!is_feasible(best_)) {
      const double of_best = DesignLog::beyond_tolerance(best_.modification_violation);
      if (predicted.modification_violation != of_best) return predicted.modification_violation < of_best;
      return predicted.violation < best_.constraint_violation + violation;
    }
    return predicted.violation <= violation && predicted.objective < best_.objective + std::max(dear_rounding * exact_objective_, objective_margin_);
  }

  bool is_feasible(const RoundedDesign& design) const { return design.constraint_violation <= DesignLog::tolerance; }

  /// Whether a scene that is as bad as the best design's worst rules a design out.
  bool scenes_rule_out() const {
    return problem_.task().over == Aggregate::Worst && is_feasible(best_) && !problem_.task().combined_objective().over_spectrum();
  }
  /// The first such scene of those tried first.
  std::optional<int> failed_scene(const Eigen::VectorXd& x) const {
    const PerGear<Modification> modification = problem_.modification(x);
    const Objective objective = problem_.task().combined_objective();
    const std::span<const int> tried(first_.data(), std::min(scenes_tried_first, first_.size()));
    for (const int scene : tried) {
      const auto at = static_cast<std::size_t>(scene);
      if (deciding_[at].empty()) continue;
      const LoadedCycle some = problem_.analyse_positions(scene, deciding_[at], modification, &best_cycles_[at]);
      if (!some.usable() || !(least_measure(objective, problem_.scene_of(some, scene), deciding_[at]) < best_.objective)) return scene;
    }
    for (const int scene : tried) {
      const LoadedCycle cycle = problem_.analyse_scene(scene, modification, {}, &best_cycles_[static_cast<std::size_t>(scene)]);
      if (!cycle.usable() || !(problem_.scene_measure(objective, cycle, scene) < best_.objective)) return scene;
    }
    return std::nullopt;
  }

  /// Makes the design analysed last the best one; its worst scenes are tried first.
  void take(const RoundedDesign& design) {
    best_ = design;
    const DesignAnalysis& analysis = problem_.analyse(best_.x, false);
    best_cycles_ = analysis.cycles;
    if (!is_feasible(best_)) return;
    const Objective objective = problem_.task().combined_objective();
    deciding_.assign(best_cycles_.size(), {});
    if (scenes_rule_out()) {
      for (int scene = 0; scene < problem_.scenes(); ++scene) {
        deciding_[static_cast<std::size_t>(scene)] =
            deciding_positions(objective, problem_.scene_of(best_cycles_[static_cast<std::size_t>(scene)], scene));
      }
    }
    const std::vector<double> measures = problem_.scene_measures(objective, analysis);
    std::ranges::stable_sort(first_, std::ranges::greater{}, [&](int scene) { return measures[static_cast<std::size_t>(scene)]; });
  }

  bool is_better(const RoundedDesign& design) const {
    const bool feasible = is_feasible(design);
    if (feasible != is_feasible(best_)) return feasible;
    if (feasible) return design.objective < best_.objective;
    return std::pair(DesignLog::beyond_tolerance(design.modification_violation), design.constraint_violation) <
           std::pair(DesignLog::beyond_tolerance(best_.modification_violation), best_.constraint_violation);
  }

  /// Takes the first of these designs that is promising and better than the best, and tells which.
  std::optional<std::size_t> first_better(const std::vector<Eigen::VectorXd>& all) {
    std::vector<Eigen::VectorXd> designs;
    std::vector<std::size_t> number;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k] == best_.x || !is_promising(all[k])) continue;
      designs.push_back(all[k]);
      number.push_back(k);
    }
    const std::optional<std::size_t> better = first_better_of(designs);
    return better ? std::optional(number[*better]) : std::nullopt;
  }
  /// Of designs that are all worth an analysis.
  std::optional<std::size_t> first_better_of(std::span<const Eigen::VectorXd> designs) {
    std::span<const Eigen::VectorXd> some;
    for (std::size_t begin = 0; begin < designs.size() && analyses_ < most_; begin += some.size()) {
      some = designs.subspan(begin, std::min({tried_together, static_cast<std::size_t>(most_ - analyses_), designs.size() - begin}));
      std::vector<std::optional<int>> failed(some.size());
      if (scenes_rule_out()) {
        tbb::this_task_arena::isolate(
            [&] { tbb::parallel_for(std::size_t{0}, some.size(), [&](std::size_t k) { failed[k] = failed_scene(some[k]); }); });
      }
      for (std::size_t k = 0; k < some.size(); ++k) {
        if (failed[k]) {
          best_.analyses = ++analyses_;
          const auto scene = std::ranges::find(first_, *failed[k]);
          std::rotate(first_.begin(), scene, scene + 1);
          continue;
        }
        const RoundedDesign design = judge(some[k]);
        best_.analyses = analyses_;
        if (!is_better(design)) continue;
        take(design);
        return begin + k;
      }
    }
    return std::nullopt;
  }

  bool is_dear() const { return !is_feasible(best_) || best_.objective > (1.0 + dear_rounding) * exact_objective_; }

  /// The values on either side of the exact ones, in all combinations of the variables that lie farthest from a step; as many as make the
  /// most_corners, with a model the most promising first.
  std::vector<Eigen::VectorXd> corners() const {
    constexpr std::size_t most_corners = 64, most_variables = 6, most_by_model = 12;
    const auto steps = [&](int i) { return problem_.unscaled(exact_, i) / variable(i).step; };
    std::vector<int> between = stepped_;
    std::ranges::stable_sort(between, std::ranges::greater{}, [&](int i) { return std::abs(steps(i) - std::round(steps(i))); });
    between.resize(std::min(between.size(), model_ ? most_by_model : most_variables));
    std::vector<std::pair<Predicted, Eigen::VectorXd>> found;
    for (unsigned corner = 0; corner < 1U << between.size(); ++corner) {
      Eigen::VectorXd x = x_;
      for (std::size_t k = 0; k < between.size(); ++k) place(problem_, x, between[k], std::floor(steps(between[k])) + (corner >> k & 1U));
      const Predicted predicted = model_ ? predict(x) : Predicted{};
      found.emplace_back(predicted, std::move(x));
    }
    std::ranges::stable_sort(found, {}, [](const auto& corner) { return corner.first; });
    found.resize(std::min(found.size(), most_corners));
    std::vector<Eigen::VectorXd> designs;
    for (auto& [predicted, x] : found) designs.push_back(std::move(x));
    return designs;
  }

  /// Takes each of the corners that is better than the best.
  void try_corners() {
    std::vector<Eigen::VectorXd> designs = corners();
    while (!designs.empty()) {
      const std::optional<std::size_t> better = first_better(designs);
      if (!better) return;
      designs.erase(designs.begin(), designs.begin() + static_cast<std::ptrdiff_t>(*better) + 1);
    }
  }

  bool improve_singly(int reach) {
    std::vector<std::pair<int, int>> moves;
    for (int i : stepped_) moves.insert(moves.end(), {{i, -reach}, {i, reach}});
    bool improved = false;
    for (std::size_t next = 0; next < moves.size();) {
      std::vector<Eigen::VectorXd> designs;
      for (std::size_t k = next; k < moves.size(); ++k) designs.push_back(moved(problem_, best_.x, moves[k].first, moves[k].second));
      const std::optional<std::size_t> better = first_better(designs);
      if (!better) break;
      improved = true;
      next += *better + 1;
    }
    return improved;
  }

  /// Two variables at once, one of them by as many steps as the reach.
  bool improve_in_pairs(int reach) {
    std::vector<Eigen::VectorXd> designs;
    for (std::size_t a = 0; a < stepped_.size(); ++a) {
      for (std::size_t b = a + 1; b < stepped_.size(); ++b) {
        for (int by = -reach; by <= reach; ++by) {
          for (int with = -reach; with <= reach; ++with) {
            if (by == 0 || with == 0 || std::max(std::abs(by), std::abs(with)) < reach) continue;
            designs.push_back(moved(problem_, moved(problem_, best_.x, stepped_[a], by), stepped_[b], with));
          }
        }
      }
    }
    return first_better(designs).has_value();
  }

  /// Sets every variable to 0 that the objective does not feel, all together within idle_share.
  void leave_out_idle() {
    if (!is_feasible(best_) || !model_) return;
    const double most = (1.0 + idle_share) * best_.objective;
    for (const int i : stepped_) {
      if (is_followed(problem_, i)) continue;  // at 0 of one the other need not be 0
      Eigen::VectorXd x = best_.x;
      place(problem_, x, i, 0.0);
      if (x == best_.x || std::abs(problem_.unscaled(x, i)) > round_off * variable(i).step || analyses_ >= most_) continue;
      const Predicted predicted = predict(x);
      if (predicted.violation > DesignLog::tolerance || predicted.objective > most + objective_margin_) continue;
      const RoundedDesign without = judge(x);
      if (is_feasible(without) && without.objective <= most) take(without);
    }
    best_.analyses = analyses_;
  }

  DesignProblem& problem_;
  const int most_;
  const Eigen::VectorXd exact_;
  double exact_objective_{not_given};
  Eigen::VectorXd x_;                 ///< where the search begins
  std::vector<int> stepped_, first_;  ///< variables with a step; scenes in the order they are tried
  int analyses_{0};
  RoundedDesign best_;
  std::vector<LoadedCycle> best_cycles_;            ///< of it, one per scene
  std::vector<std::vector<std::size_t>> deciding_;  ///< its deciding positions in each scene
  std::optional<LocalModel> model_;                 ///< about the exact design, by its variables' steps
  /// By how much the model was above a design that was analysed, at most.
  double objective_margin_{0.0}, violation_margin_{0.0};
};

}  // namespace

RoundedDesign round_design(DesignProblem& problem, const Eigen::VectorXd& x, int most_analyses) {
  return StepSearch(problem, x, most_analyses).run();
}

Eigen::VectorXd least_on_steps(const DesignProblem& problem, const Eigen::VectorXd& x,
                               const std::function<StepFigure(const Eigen::VectorXd&)>& figure) {
  const std::vector<int> stepped = stepped_variables(problem);
  Eigen::VectorXd best = x;
  for (const int i : stepped) best = moved(problem, best, i, 0);
  StepFigure least = figure(best);
  const auto improve = [&](const std::vector<Eigen::VectorXd>& designs) {
    bool improved = false;
    for (const Eigen::VectorXd& design : designs) {
      const StepFigure of = figure(design);
      if (!(of < least)) continue;
      least = of;
      best = design;
      improved = true;
    }
    return improved;
  };
  const auto neighbours = [&](bool in_pairs) {
    std::vector<Eigen::VectorXd> designs;
    for (std::size_t a = 0; a < stepped.size(); ++a) {
      for (const int by : {-1, 1}) {
        const Eigen::VectorXd one = moved(problem, best, stepped[a], by);
        if (!in_pairs) designs.push_back(one);
        for (std::size_t b = a + 1; in_pairs && b < stepped.size(); ++b) {
          for (const int with : {-1, 1}) designs.push_back(moved(problem, one, stepped[b], with));
        }
      }
    }
    return designs;
  };
  while (improve(neighbours(false)) || improve(neighbours(true))) {
  }
  const double most = (1.0 + idle_share) * least.objective;
  for (const int i : stepped) {
    Eigen::VectorXd without = best;
    place(problem, without, i, 0.0);
    if (is_followed(problem, i) || problem.unscaled(without, i) != 0.0 || without == best) continue;
    const StepFigure of = figure(without);
    if (of.violation <= least.violation && of.objective <= most) best = without;
  }
  return best;
}

bool has_steps(const DesignTask& task) {
  return std::any_of(task.variables.begin(), task.variables.end(), [](const DesignVariable& v) { return v.step > 0.0; });
}

}  // namespace flankwright
