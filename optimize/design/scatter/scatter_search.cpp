#include "optimize/design/scatter/scatter_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/base/stopwatch.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/scatter/draw_analyses.hpp"
#include "optimize/design/scatter/model_step.hpp"
#include "optimize/design/grinding/rounding.hpp"
#include "optimize/design/scatter/screening.hpp"
#include "optimize/design/two_level.hpp"

namespace flankwright {

namespace {

constexpr int first_draws = 64, growth_of_draws = 8;
/// A level ends where the model promises to lower the statistic by no more than this share of it: a part of the 1 % that thousands of draws do not tell apart.
constexpr double settled = 2.5e-3;
/// Likewise of a level whose design is only the start of the next one, which moves it by as much. It also ends with a step that lowers the statistic by no more.
constexpr double settled_start = 1e-2;
enum class Level { Start, Last };
/// Half widths of the box, in ranges of the variables: at first, at least when a level begins, at most, and below which a level ends.
constexpr double first_radius = 0.2, level_radius = 0.05, largest_radius = 0.5, least_radius = 1e-3;
constexpr double poor_share = 0.25, good_share = 0.75;  // of the promised gain, see search_over_draws()
constexpr double safety = 2.0;                          // see judge_all()
constexpr std::size_t chunk = 32;                       // draws screened before judge_all() looks whether others can still matter
constexpr std::size_t most_rounded_designs = 24;
constexpr int all_draws = std::numeric_limits<int>::max();

class DrawSearch {
 public:
  DrawSearch(const DesignProblem& full, const DesignProblem& screening, const SolverOptions& options, ScatterDesign& books)
      : full_(full),
        screening_(screening),
        options_(options),
        books_(books),
        model_(full),
        models_(statistics_of(model_)),
        analyses_(full, {models_.begin(), models_.end()}) {}

  int draws() const { return model_.objective.draws(); }

  /// Whether the first n draws are the same ones for all statistics.
  bool can_begin_with_few() const { return !analyses_.of_spectrum(); }

  /// Steps keep to this part of 0 .. 1 from now on.
  void hold(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    model_.lower = lower;
    model_.upper = upper;
  }

  /// A design and its figures over some draws.
  struct Judged {
    Eigen::VectorXd x;
    double value{not_given}, violation{not_given};

    bool keeps() const { return violation <= DesignLog::tolerance; }
    /// What a step lowers, relative: the statistic, or the excess where limits are not kept.
    double gain_to(const Judged& next) const {
      if (keeps()) return next.keeps() ? 1.0 - next.value / value : -INFINITY;
      return violation - std::max(0.0, next.violation);
    }
  };

  /// The best design on one level by a statistic of the first draws, from x on.
  Judged descend(const DesignProblem& problem, const Eigen::VectorXd& x, int draws, const Aggregation& over, Level level = Level::Last) {
    const double least_gain = level == Level::Start ? settled_start : settled;
    model_.objective.combine(over);
    model_.objective.smooth(std::min(draws, model_.objective.draws()));
    radius_ = std::max(radius_, level_radius);
    Judged best = judge(problem, x, draws);
    remember(true);
    bool is_enough = false;  // the last step that gained anything gained little, and this is a start
    books_.status = SolverStatus::Converged;
    while (true) {
      const ModelStep step = least_of_model(model_, best.x, radius_, draws);
      if (is_spent() || is_enough || is_settled(step, least_gain)) {
        if (is_screened(best.x)) break;
        best = judge_all(problem, best.x, draws);
        remember(true);
        continue;
      }
      const double length = (step.x - best.x).lpNorm<Eigen::Infinity>();
      ++books_.steps;
      double gain = -INFINITY;
      try {
        Judged next = judge(problem, step.x, draws);
        if (best.gain_to(next) > 0.0) next = judge_all(problem, step.x, draws, &best);
        gain = best.gain_to(next);
        remember(gain > 0.0);
        if (gain > 0.0) {
          best = next;
          is_enough = level == Level::Start && gain <= least_gain;
        }
      } catch (const std::runtime_error&) {  // such a design cannot be analysed: a shorter step
        last_ = {};
      }
      if (options_.progress) options_.progress(books_.steps, best.value);
      if (gain < poor_share * step.gain) radius_ = 0.5 * length;
      if (gain > good_share * step.gain) radius_ = std::min(2.0 * radius_, largest_radius);
    }
    return best;
  }

  const std::vector<double>& measures() const { return measures_; }
  const std::vector<double>& bounds() const { return bounds_; }
  std::vector<double> weights() const { return models_.front()->statistic_weights(measures_); }
  /// Number of draws analysed by the last judge().
  std::size_t deciding() const { return last_.units.size(); }

  /// A design by the draws that decide there once the others are screened: all, or where the design need only be compared as far as the model may err. A
  /// draw is then left out where (1 + safety * shortfall) guess < least measure that a statistic hangs on; the shortfall is the largest by which the model
  /// guessed too little of a draw screened at this design, relative.
  /// @param beaten  the screening ends where it is known to be no better than this; null: all are screened
  Judged judge_all(const DesignProblem& problem, const Eigen::VectorXd& x, int draws, const Judged* beaten = nullptr) {
    Judged judged = judge(problem, x, draws);
    screened_.clear();
    screened_x_ = x;
    all_screened_ = false;
    double shortfall = 0.0;
    const std::vector<Guess> others = others_worst_first(x, draws);
    for (std::size_t from = 0; from < others.size(); from += chunk) {
      if (beaten != nullptr && from > 0 && (1.0 + safety * shortfall) * others[from].of_deciding < 1.0) return judged;
      const std::size_t to = std::min(from + chunk, others.size());
      std::vector<int> some;
      for (std::size_t i = from; i < to; ++i) some.push_back(others[i].draw);
      shortfall = std::max(shortfall, screen_others(x, some, draws));
      if (beaten != nullptr || to == others.size()) judged = judge(problem, x, draws);
      if (beaten != nullptr && !(beaten->gain_to(judged) > 0.0)) return judged;
    }
    all_screened_ = true;
    return judged;
  }

  /// The statistics themselves at the last design that was accepted.
  Judged report(const DesignProblem& problem, const Eigen::VectorXd& x) {
    model_.objective.combine(full_.task().over);
    model_.objective.exact();
    return judge(problem, x, all_draws);
  }

  /// The design on the steps of the variables that the model has least.
  Eigen::VectorXd least_on_steps(const DesignProblem& problem, const Eigen::VectorXd& x) const {
    return flankwright::least_on_steps(problem, x, [&](const Eigen::VectorXd& at) {
      const double of_modification = problem.violation(problem.modification(at));
      return StepFigure{DesignLog::beyond_tolerance(of_modification),
                        DesignLog::beyond_tolerance(std::max(of_modification, model_.excess(at, all_draws))),
                        model_.objective.statistic(model_.objective.measures(at, all_draws))};
    });
  }
  /// A design beside the last that was accepted, whose draws the model then knows there too. @param beaten  as judge_all()
  Judged try_design(const DesignProblem& problem, const Eigen::VectorXd& x, const Judged* beaten) {
    const Judged judged = judge_all(problem, x, all_draws, beaten);
    remember(false);
    return judged;
  }
  /// The same of a design that was not: on the steps of the variables.
  Judged report_all(const DesignProblem& problem, const Eigen::VectorXd& x) {
    const Judged judged = judge_all(problem, x, all_draws);
    remember(true);
    return judged;
  }

 private:
  /// A draw that was not analysed at a design, and the largest of its guessed measures over the statistics, relative to the least that the statistic hangs on.
  struct Guess {
    int draw;
    double of_deciding;
  };

  /// The first draws that the last judge() did not analyse, those first of which the model expects the most.
  std::vector<Guess> others_worst_first(const Eigen::VectorXd& x, int draws) const {
    std::vector<Guess> others;
    for (int draw = 0; draw < models_.front()->draws(draws); ++draw) {
      if (!last_.units.contains(analyses_.unit_of(*models_.front(), draw))) others.push_back({draw, 0.0});
    }
    for (std::size_t m = 0; m < models_.size(); ++m) {
      const std::vector<double> guess = models_[m]->measures(x, draws);
      for (Guess& other : others) other.of_deciding = std::max(other.of_deciding, guess[static_cast<std::size_t>(other.draw)] / least_deciding_[m]);
    }
    std::ranges::stable_sort(others, std::greater{}, &Guess::of_deciding);
    return others;
  }

  /// Screens draws of the objective: contact that reaches an edge there is not foreseen by the gradients of a draw without it.
  /// @returns the largest shortfall of what the model had guessed, relative
  double screen_others(const Eigen::VectorXd& x, const std::vector<int>& others, int draws) {
    const AnalysedDraws analysed = std::exchange(last_, {&screening_, x, {}, {}});
    analyse(*models_.front(), others, false);
    double shortfall = 0.0;
    for (std::size_t m = 0; m < models_.size(); ++m) {
      const StatisticModel& model = *models_[m];
      const std::vector<double> guess = model.measures(x, draws);
      for (const auto& [key, linear] : last_.linear) {
        if (key.first != m) continue;
        screened_[key] = model.unseen(model.seen(linear, x).value);
        shortfall = std::max(shortfall, screened_[key] / guess[static_cast<std::size_t>(key.second)] - 1.0);
      }
    }
    last_ = analysed;
    return shortfall;
  }

  /// A design by the draws that decide there, as far as is known of the others.
  Judged judge(const DesignProblem& problem, const Eigen::VectorXd& x, int draws) {
    Judged judged{x, not_given, 0.0};
    if (!last_.is_of(problem, x)) last_ = accepted_.is_of(problem, x) ? accepted_ : AnalysedDraws{&problem, x, {}, {}};
    bounds_.clear();
    least_deciding_.clear();
    for (std::size_t m = 0; m < models_.size(); ++m) {
      StatisticModel& model = *models_[m];
      std::vector<double> guess = model.measures(x, draws);
      if (screened_x_.size() == x.size() && screened_x_ == x) {
        for (const auto& [key, measure] : screened_) {
          if (key.first == m) guess[static_cast<std::size_t>(key.second)] = measure;
        }
      }
      screen(
          guess, model.first(guess.size()), [&model](const std::vector<double>& measures) { return model.statistic_weights(measures); },
          [&](const std::vector<int>& some) { return analyse(model, some, true); });
      const double value = model.statistic(guess);
      least_deciding_.push_back(least_deciding(guess, model.statistic_weights(guess)));
      if (m == 0) {
        judged.value = value;
        measures_ = std::move(guess);
      } else {
        bounds_.push_back(value);
        judged.violation = std::max(judged.violation, value / model_.limits[m - 1] - 1.0);
      }
    }
    for (Eigen::Index r = 0; r < model_.slopes.rows(); ++r) {
      judged.violation = std::max(judged.violation, model_.slopes.row(r).dot(x) - model_.most[r]);
    }
    return judged;
  }

  /// Keeps the analyses of the last judge(): for a design that was accepted instead of all that was known, else beside it.
  void remember(bool accepted) {
    for (const auto& [key, linear] : last_.linear) {
      if (accepted) {
        models_[key.first]->set(key.second, linear);
      } else {
        models_[key.first]->add(key.second, linear);
      }
    }
    if (!accepted) return;
    accepted_ = last_;
    if (!(screened_x_.size() == last_.x.size() && screened_x_ == last_.x)) return;
    for (const auto& [key, measure] : screened_) {
      if (!last_.linear.contains(key)) models_[key.first]->set(key.second, models_[key.first]->moved(key.second, last_.x, measure));
    }
  }

  bool is_screened(const Eigen::VectorXd& x) const { return all_screened_ && screened_x_ == x; }

  bool is_settled(const ModelStep& step, double least_gain) {
    if (step.gain <= least_gain) {
      books_.message = "no step promises to gain a quarter of a per cent";
    } else if (radius_ < least_radius) {
      books_.message = "no step longer than a thousandth of the ranges gains";
    } else {
      return false;
    }
    return true;
  }

  bool is_spent() {
    if (books_.steps >= options_.max_evaluations) books_.status = SolverStatus::EvaluationLimit;
    if (clock_.seconds() >= options_.max_seconds) books_.status = SolverStatus::TimeLimit;
    if (books_.status == SolverStatus::Converged) return false;
    books_.message = "the best design met so far";
    return true;
  }

  static std::vector<StatisticModel*> statistics_of(ScatterModel& model) {
    std::vector<StatisticModel*> all{&model.objective};
    for (StatisticModel& bounded : model.bounded) all.push_back(&bounded);
    return all;
  }

  /// Analyses draws that the last judge() has not analysed yet; measures of all these.
  std::vector<double> analyse(const StatisticModel& of, const std::vector<int>& draws, bool with_derivatives) {
    const std::int64_t cycles = analyses_.add(last_, of, draws, with_derivatives);
    books_.cycles += cycles;
    if (last_.problem != &full_) books_.screening_cycles += cycles;
    return analyses_.measures(last_, of, draws);
  }

  const DesignProblem &full_, &screening_;
  const SolverOptions& options_;
  ScatterDesign& books_;
  const Stopwatch clock_;
  ScatterModel model_;
  std::vector<StatisticModel*> models_;  ///< the objective's, then those of the bounds
  const DrawAnalyses analyses_;
  double radius_{first_radius};
  AnalysedDraws last_, accepted_;                           ///< of the last judge(), and of the last design accepted
  std::map<std::pair<std::size_t, int>, double> screened_;  ///< measures of the others where a step was to be accepted
  Eigen::VectorXd screened_x_;
  bool all_screened_{false};  ///< at screened_x_ no draw was left out
  std::vector<double> measures_, bounds_;
  std::vector<double> least_deciding_;  ///< per statistic the least measure that it hangs on at the last judge()
};

/// The design on the steps that is least by the model. Each design tried is added to the model, because gradients at the optimum do not foresee contact that reaches
/// an edge beside it. The search ends where the least of the model was tried.
DrawSearch::Judged round(DrawSearch& search, const DesignProblem& full, ScatterDesign& design) {
  const Eigen::VectorXd exact = design.x;
  std::vector<Eigen::VectorXd> tried;
  std::optional<DrawSearch::Judged> best;
  while (tried.size() < most_rounded_designs) {
    const Eigen::VectorXd x = search.least_on_steps(full, exact);
    if (std::ranges::find(tried, x) != tried.end()) break;
    tried.push_back(x);
    const DrawSearch::Judged judged = search.try_design(full, x, best ? &*best : nullptr);
    // A design that keeps more of the limits on modifications can be ground, whatever its statistics are.
    const auto excess = [&](const DrawSearch::Judged& of) { return DesignLog::beyond_tolerance(full.violation(full.modification(of.x))); };
    if (!best || excess(judged) < excess(*best) || (excess(judged) == excess(*best) && best->gain_to(judged) > 0.0)) best = judged;
  }
  design.x = best->x;
  return search.report_all(full, design.x);
}

/// Decides on amounts that cannot be ground. Each alternative continues from what is known of the draws, at the resolution of the task.
DrawSearch::Judged settle(DrawSearch& search, DesignProblem& full, ScatterDesign& design) {
  const auto go_on = [&](const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Eigen::VectorXd& start) {
    const Eigen::VectorXd x = start.cwiseMax(lower).cwiseMin(upper);
    search.hold(lower, upper);
    try {
      const DrawSearch::Judged found = search.report(full, search.descend(full, x, search.draws(), full.task().over).x);
      return HeldDesign{found.x, found.value, std::max(0.0, found.violation)};
    } catch (const InvalidInput&) {
      throw;
    } catch (const std::runtime_error&) {  // the design at which the alternative begins cannot be analysed
      return HeldDesign{x};
    }
  };
  SettledAmounts to_grind = settle_amounts(full, design.x, go_on);
  full.set_box(to_grind.lower, to_grind.upper);
  design.x = std::move(to_grind.x);
  design.choices = std::move(to_grind.choices);
  return search.report_all(full, design.x);
}

}  // namespace

ScatterDesign search_over_draws(const DesignTask& task, const std::vector<double>& start, const SolverOptions& options, ScatterStart start_is) {
  const Stopwatch clock;
  ScatterDesign design;
  DesignProblem full(task);
  const std::optional<DesignProblem> coarse = can_be_coarser(task) ? std::optional<DesignProblem>(screening_task(task)) : std::nullopt;
  const DesignProblem& screening = coarse ? *coarse : full;
  DrawSearch search(full, screening, options, design);
  design.x = full.nearest_design(start);
  try {
    const bool is_quantile = task.over == Aggregate::Quantile;
    const Aggregation approach = is_quantile ? Aggregation{Aggregate::Cvar, 2.0, task.over.level} : task.over;
    const int all = search.draws(), few = search.can_begin_with_few() ? std::min(first_draws, all) : all;
    for (int draws = few; draws < all; draws = std::min(draws * growth_of_draws, all)) {
      design.x = search.descend(screening, design.x, draws, approach, Level::Start).x;
    }
    if (is_quantile && few == all) design.x = search.descend(screening, design.x, all, approach, Level::Start).x;
    const DrawSearch::Judged screened = search.descend(screening, design.x, all, task.over);
    const bool was_found = coarse && start_is == ScatterStart::FoundOverTheseDraws;
    if (was_found && !(search.judge_all(screening, full.nearest_design(start), all).gain_to(screened) > settled_start)) {
      design.x = full.nearest_design(start);
      design.modification = full.modification(design.x);
      design.message = "no better design by the screening resolution";
      design.seconds = clock.seconds();
      return design;
    }
    design.x = screened.x;
    if (coarse) design.x = search.descend(full, design.x, all, task.over).x;
    DrawSearch::Judged found = search.report(full, design.x);
    const double exact = found.value;
    if (task.grindable.any()) found = settle(search, full, design);
    if (has_steps(task)) found = round(search, full, design);
    if (has_steps(task) || !design.choices.empty()) design.exact_value = exact;
    design.value = found.value;
    design.violation = found.violation;
    design.measures = search.measures();
    design.weights = search.weights();
    design.bounds = search.bounds();
    design.decided_by = search.deciding();
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    design.status = SolverStatus::Failed;
    design.message = std::string("the start cannot be analysed: ") + error.what();
  }
  design.modification = full.modification(design.x);
  if (design.violation > DesignLog::tolerance && design.status != SolverStatus::Failed) {
    design.status = SolverStatus::Infeasible;
    design.message = "no design that keeps the constraints over the draws was found";
  }
  design.seconds = clock.seconds();
  return design;
}

}  // namespace flankwright
