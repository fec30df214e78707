#include "optimize/design/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "optimize/design/design_log.hpp"

namespace flankwright {

namespace {

/// Number of scenes that a design must pass one by one before all are analysed in parallel.
constexpr std::size_t scenes_tried_first = 4;

/// A search over whole numbers of steps; variables without a step keep their values. A worst case is no better where one scene
/// already reaches the best so far: the scenes that governed last are tried first, and most designs go no further.
class StepSearch {
 public:
  StepSearch(DesignProblem& problem, const Eigen::VectorXd& x, int most_analyses) : problem_(problem), most_(most_analyses), exact_(x), x_(x) {
    const DesignAnalysis& exact = problem_.analyse(x, false);
    if (is_usable(exact)) exact_objective_ = problem_.objective(exact);
    for (int i = 0; i < problem.variables(); ++i) {
      const DesignVariable& v = variable(i);
      if (v.step == 0.0) continue;
      stepped_.push_back(i);
      place(x_, i, std::round(problem.unscaled(x, i) / v.step));
    }
    best_ = judge(x_);
    first_.resize(static_cast<std::size_t>(problem.scenes()));
    std::iota(first_.begin(), first_.end(), 0);
    if (is_feasible(best_)) put_worst_first();
  }

  RoundedDesign run() {
    while (improve_singly(1) || improve_in_pairs(1)) {
    }
    if (!is_dear()) return best_;
    try_corners();
    while (improve_singly(1) || improve_in_pairs(1) || improve_singly(2) || improve_in_pairs(2)) {
    }
    return best_;
  }

 private:
  const DesignVariable& variable(int i) const { return problem_.task().variables[static_cast<std::size_t>(i)]; }

  /// Sets variable i to a number of steps, the nearest within its bounds.
  void place(Eigen::VectorXd& x, int i, double steps) const {
    const DesignVariable& v = variable(i);
    constexpr double round_off = 1e-9;  // of a step: a bound that is a multiple of it counts as one
    const double least = std::ceil(v.lower / v.step - round_off), most = std::floor(v.upper / v.step + round_off);
    x[i] = std::clamp(v.scaled(std::clamp(steps, least, std::max(least, most)) * v.step), 0.0, 1.0);
  }

  Eigen::VectorXd moved(const Eigen::VectorXd& from, int i, int by) const {
    Eigen::VectorXd x = from;
    place(x, i, std::round(problem_.unscaled(from, i) / variable(i).step) + by);
    return x;
  }

  RoundedDesign judge(const Eigen::VectorXd& x) {
    ++analyses_;
    RoundedDesign design{x};
    const DesignAnalysis& analysis = problem_.analyse(x, false);
    const bool usable = is_usable(analysis);
    design.objective = usable ? problem_.objective(analysis) : INFINITY;
    design.constraint_violation = usable ? problem_.violation(analysis) : INFINITY;
    design.analyses = analyses_;
    return design;
  }

  static bool is_usable(const DesignAnalysis& analysis) {
    return std::ranges::all_of(analysis.cycles, [](const LoadedCycle& cycle) { return cycle.usable(); });
  }

  bool is_feasible(const RoundedDesign& design) const { return design.constraint_violation <= DesignLog::tolerance; }

  /// Whether one of the scenes tried first is as bad as the best design's worst; that one is tried first from then on.
  bool fails_early(const Eigen::VectorXd& x) {
    if (!(problem_.task().over == Aggregate::Worst) || !is_feasible(best_) || problem_.task().combined_objective().over_spectrum()) return false;
    const PerGear<Modification> modification = problem_.modification(x);
    for (std::size_t k = 0; k < std::min(scenes_tried_first, first_.size()); ++k) {
      const int scene = first_[k];
      const LoadedCycle cycle = problem_.analyse_scene(scene, modification);
      if (cycle.usable() && problem_.scene_measure(problem_.task().combined_objective(), cycle, scene) < best_.objective) continue;
      std::rotate(first_.begin(), first_.begin() + static_cast<std::ptrdiff_t>(k), first_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      return true;
    }
    return false;
  }

  /// The worst scenes of the best design are tried first. It is the design analysed last.
  void put_worst_first() {
    const std::vector<double> measures = problem_.scene_measures(problem_.task().combined_objective(), problem_.analyse(best_.x, false));
    std::ranges::stable_sort(first_, std::ranges::greater{}, [&](int scene) { return measures[static_cast<std::size_t>(scene)]; });
  }

  bool try_design(const Eigen::VectorXd& x) {
    if (analyses_ >= most_ || x == best_.x) return false;
    if (fails_early(x)) {
      best_.analyses = ++analyses_;
      return false;
    }
    const RoundedDesign design = judge(x);
    best_.analyses = analyses_;
    const bool feasible = is_feasible(design), was = is_feasible(best_);
    const bool better = feasible != was ? feasible
                        : feasible      ? design.objective < best_.objective
                                        : design.constraint_violation < best_.constraint_violation;
    if (better) {
      best_ = design;
      if (is_feasible(best_)) put_worst_first();
    }
    return better;
  }

  bool is_dear() const { return !is_feasible(best_) || best_.objective > (1.0 + dear_rounding) * exact_objective_; }

  /// The values on either side of the exact ones, in all combinations of the variables that lie farthest from a step.
  void try_corners() {
    constexpr std::size_t most_variables = 6;  // 64 corners
    const auto steps = [&](int i) { return problem_.unscaled(exact_, i) / variable(i).step; };
    std::vector<int> between = stepped_;
    std::ranges::stable_sort(between, std::ranges::greater{}, [&](int i) { return std::abs(steps(i) - std::round(steps(i))); });
    between.resize(std::min(between.size(), most_variables));
    for (unsigned corner = 0; corner < 1U << between.size(); ++corner) {
      Eigen::VectorXd x = x_;
      for (std::size_t k = 0; k < between.size(); ++k) place(x, between[k], std::floor(steps(between[k])) + (corner >> k & 1U));
      try_design(x);
    }
  }

  bool improve_singly(int reach) {
    bool improved = false;
    for (int i : stepped_) {
      for (int by : {-reach, reach}) improved = try_design(moved(best_.x, i, by)) || improved;
    }
    return improved;
  }

  /// Two variables at once, one of them by as many steps as the reach.
  bool improve_in_pairs(int reach) {
    for (std::size_t a = 0; a < stepped_.size(); ++a) {
      for (std::size_t b = a + 1; b < stepped_.size(); ++b) {
        for (int by = -reach; by <= reach; ++by) {
          for (int with = -reach; with <= reach; ++with) {
            if (by == 0 || with == 0 || std::max(std::abs(by), std::abs(with)) < reach) continue;
            if (try_design(moved(moved(best_.x, stepped_[a], by), stepped_[b], with))) return true;
          }
        }
      }
    }
    return false;
  }

  DesignProblem& problem_;
  const int most_;
  const Eigen::VectorXd exact_;
  double exact_objective_{not_given};
  Eigen::VectorXd x_;                 ///< the nearest steps
  std::vector<int> stepped_, first_;  ///< variables with a step; scenes in the order they are tried
  int analyses_{0};
  RoundedDesign best_;
};

}  // namespace

RoundedDesign round_design(DesignProblem& problem, const Eigen::VectorXd& x, int most_analyses) {
  return StepSearch(problem, x, most_analyses).run();
}

bool has_steps(const DesignTask& task) {
  return std::any_of(task.variables.begin(), task.variables.end(), [](const DesignVariable& v) { return v.step > 0.0; });
}

}  // namespace flankwright
