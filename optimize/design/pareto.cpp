#include "optimize/design/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"

namespace flankwright {

namespace {

/// How far an objective may rise above its least value so that the others fall where it alone is best, see add_anchor()
/// [-].
constexpr double anchor_slack = 1e-3;

/// The problem whose analyses have whatever any of the objectives needs.
DesignProblem with_all(const DesignProblem& problem, const std::vector<Objective>& objectives) {
  std::vector<ScalarisedObjective> scalarisation;
  for (const Objective& objective : objectives) scalarisation.push_back({objective});
  return problem.judged_by(objectives.front(), problem.task().objective_bounds, scalarisation);
}

class FrontTracing {
 public:
  FrontTracing(const DesignProblem& problem, const std::vector<Objective>& objectives, int points, const DesignOptions& options,
               const std::vector<Eigen::VectorXd>& known)
      : problem_(problem), valued_(with_all(problem, objectives)), points_(points), options_(options.solver), starts_(options.starts), known_(known) {
    front_.objectives = objectives;
  }

  ParetoFront trace() {
    const std::vector<ParetoPoint> bests = best_of_each_objective();
    for (std::size_t g = 0; g < bests.size() && !is_spent(); ++g) add_anchor(g, bests);
    if (front_.points.size() == front_.objectives.size()) {
      front_.choose_ranges();
      if (front_.objectives.size() == 2) {
        halve_gaps();
        space_evenly();
      } else {
        fill_triangle();
      }
      search_from_neighbours();
    }
    front_.mark_dominated();
    front_.seconds = clock_.seconds();
    return std::move(front_);
  }

 private:
  SolverOptions left() const {
    SolverOptions options = options_;
    options.max_evaluations = std::max(1, options_.max_evaluations - front_.evaluations);
    options.max_seconds = std::max(1e-3, options_.max_seconds - clock_.seconds());
    if (options_.progress) {
      options.progress = [this](int analyses, double best) { options_.progress(front_.evaluations + analyses, best); };
    }
    return options;
  }

  bool is_out_of_budget() const { return front_.evaluations >= options_.max_evaluations || clock_.seconds() >= options_.max_seconds; }

  bool is_spent() {
    front_.ended_early = is_out_of_budget();
    if (front_.ended_early)
      front_.message = "the budget of analyses and seconds ended the front after " + std::to_string(front_.points.size()) + " points";
    return front_.ended_early;
  }

  void count(const LocalRun& run) {
    front_.evaluations += run.evaluations;
    front_.failures += run.failures;
  }

  LocalRun search(DesignProblem& problem) {
    LocalRun run = run_local(problem, left());
    count(run);
    return run;
  }

  ParetoPoint point(const LocalRun& run) const {
    ParetoPoint point{run.x, {}, run.status, run.constraint_violation};
    DesignProblem problem = valued_;
    const DesignAnalysis& analysis = problem.analyse(run.x, false);
    for (const Objective& objective : front_.objectives) point.values.push_back(problem.value(objective, analysis));
    return point;
  }

  DesignProblem alone(std::size_t g) const { return problem_.judged_by(front_.objectives[g], problem_.task().objective_bounds); }

  /// The best design of each objective, from all starts, from what is known and from the best of every other objective. Otherwise a local
  /// optimum could be an end that the front never reaches, because another objective's best lies lower. Empty where the
  /// budget is spent before each has one.
  std::vector<ParetoPoint> best_of_each_objective() {
    const std::size_t objectives = front_.objectives.size();
    std::vector<LocalRun> bests;
    for (std::size_t g = 0; g < objectives; ++g) {
      if (is_spent()) return {};
      const std::vector<LocalRun> runs = run_from_starts(alone(g), left(), starts_);
      for (const LocalRun& run : runs) count(run);
      bests.push_back(runs[best_run(runs)]);
    }
    for (std::size_t g = 0; g < objectives; ++g) {
      std::vector<Eigen::VectorXd> starts = known_;
      for (std::size_t k = 0; k < objectives; ++k) {
        if (k != g) starts.push_back(bests[k].x);
      }
      for (const Eigen::VectorXd& start : starts) {
        if (is_out_of_budget()) break;
        DesignProblem problem = alone(g);
        problem.set_start(start);
        const LocalRun run = search(problem);
        if (best_run({bests[g], run}) == 1) bests[g] = run;
      }
    }
    std::vector<ParetoPoint> points;
    for (const LocalRun& best : bests) points.push_back(point(best));
    return points;
  }

  /// The best of objective g; then a scalarisation of the others, in units of their largest among the bests, while g
  /// stays within anchor_slack of its least value, or of its own largest among them where its least is (nearly) 0.
  void add_anchor(std::size_t g, const std::vector<ParetoPoint>& bests) {
    const auto largest = [&](std::size_t k) {
      return std::ranges::max(bests, {}, [k](const ParetoPoint& best) { return best.values[k]; }).values[k];
    };
    ParetoPoint anchor = bests[g];
    std::vector<ObjectiveBound> held = problem_.task().objective_bounds;
    held.push_back({front_.objectives[g], std::max((1.0 + anchor_slack) * anchor.values[g], anchor_slack * largest(g))});
    std::vector<ScalarisedObjective> others;
    for (std::size_t k = 0; k < front_.objectives.size(); ++k) {
      if (k != g && largest(k) > 0.0) others.push_back({front_.objectives[k], 0.0, largest(k)});
    }
    if (largest(g) > 0.0 && !others.empty() && !is_spent()) {
      DesignProblem rest = problem_.judged_by(front_.objectives[g], held, others);
      rest.set_start(anchor.x);
      const LocalRun run = search(rest);
      if (run.constraint_violation <= DesignLog::tolerance) anchor = point(run);
    }
    front_.points.push_back(anchor);
  }

  double range(std::size_t k) const { return front_.range(k); }
  Eigen::VectorXd normalised(const ParetoPoint& point) const { return front_.normalised(point); }

  /// The compromise seen from a reference point, searched from a design.
  ParetoPoint compromise(const Eigen::VectorXd& reference, const Eigen::VectorXd& start) {
    std::vector<ScalarisedObjective> scalarisation;
    for (std::size_t k = 0; k < front_.objectives.size(); ++k) {
      scalarisation.push_back({front_.objectives[k], front_.ideal[k] + reference[static_cast<Eigen::Index>(k)] * range(k), range(k)});
    }
    DesignProblem problem = problem_.judged_by(front_.objectives.front(), problem_.task().objective_bounds, scalarisation);
    problem.set_start(start);
    return point(search(problem));
  }

  /// The point of some that is nearest to values.
  const ParetoPoint& nearest(const std::vector<ParetoPoint>& points, const Eigen::VectorXd& values) const {
    return *std::ranges::min_element(points, {}, [&](const ParetoPoint& p) { return (normalised(p) - values).norm(); });
  }
  ParetoPoint compromise(const Eigen::VectorXd& reference) { return compromise(reference, nearest(front_.points, reference).x); }

  /// Every search is a local one: each compromise is sought once more from the design of a neighbour, along the front and back, so that a better kind of design spreads from
  /// where it was found. One that is better in all objectives takes its place.
  void search_from_neighbours() {
    const std::size_t anchors = front_.objectives.size();
    std::vector<std::size_t> order(front_.points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (const bool back : {false, true}) {
      if (back) std::ranges::reverse(order);
      std::vector<ParetoPoint> passed;
      for (const std::size_t i : order) {
        const bool is_anchor = anchors == 2 ? i == 0 || i + 1 == order.size() : i < anchors;
        if (!is_anchor && !passed.empty()) {
          if (is_out_of_budget()) {
            if (front_.message.empty()) front_.message = "the budget ended before all compromises of the front were sought from their neighbours";
            return;
          }
          const Eigen::VectorXd here = normalised(front_.points[i]);
          const ParetoPoint found = compromise(here, nearest(passed, here).x);
          const bool keeps_limits = found.constraint_violation <= DesignLog::tolerance;
          if (keeps_limits && (normalised(found) - here).maxCoeff() < -ParetoFront::same) front_.points[i] = found;
        }
        passed.push_back(front_.points[i]);
      }
    }
  }

  void halve_gaps() {
    std::vector<bool> closed(front_.points.size(), false);  // gap after each point: nothing new is found in it
    while (static_cast<int>(front_.points.size()) < points_ && !is_spent()) {
      std::size_t widest = front_.points.size();
      double width = 0.0;
      for (std::size_t i = 0; i + 1 < front_.points.size(); ++i) {
        const double gap = (normalised(front_.points[i + 1]) - normalised(front_.points[i])).norm();
        if (!closed[i] && gap > width) {
          width = gap;
          widest = i;
        }
      }
      if (widest == front_.points.size()) {
        front_.message = "the front has gaps that no design fills";
        return;
      }
      const Eigen::VectorXd from = normalised(front_.points[widest]), to = normalised(front_.points[widest + 1]);
      const ParetoPoint found = compromise(0.5 * (from + to));
      const Eigen::VectorXd at = normalised(found);
      constexpr double apart = 0.05;  // of the gap: a new point lies at least so far from both of its ends
      if (std::min((at - from).norm(), (at - to).norm()) < apart * width) {
        closed[widest] = true;
        continue;
      }
      front_.points.insert(front_.points.begin() + static_cast<std::ptrdiff_t>(widest) + 1, found);
      closed.insert(closed.begin() + static_cast<std::ptrdiff_t>(widest) + 1, false);
    }
  }

  /// Seeks the points between the ends once more, from equal steps of arc length along the broken line through them;
  /// one that is there already is kept. Taken where the front has grown more even by it.
  void space_evenly() {
    constexpr double there = 0.1;  // of a step
    const std::size_t n = front_.points.size();
    if (n < 4) return;
    std::vector<Eigen::VectorXd> line;
    std::vector<double> along{0.0};
    for (const ParetoPoint& p : front_.points) line.push_back(normalised(p));
    for (std::size_t i = 1; i < n; ++i) along.push_back(along.back() + (line[i] - line[i - 1]).norm());
    const double step = along.back() / static_cast<double>(n - 1);
    ParetoFront even = front_;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double wanted = step * static_cast<double>(i);
      const std::size_t end = static_cast<std::size_t>(std::upper_bound(along.begin() + 1, along.end() - 1, wanted) - along.begin());
      const std::size_t nearest = wanted - along[end - 1] < along[end] - wanted ? end - 1 : end;
      if (std::abs(along[nearest] - wanted) <= there * step) {
        even.points[i] = front_.points[nearest];
        continue;
      }
      if (is_out_of_budget()) return;
      const double share = (wanted - along[end - 1]) / (along[end] - along[end - 1]);
      even.points[i] = compromise((1.0 - share) * line[end - 1] + share * line[end]);
      if (even.points[i].constraint_violation > DesignLog::tolerance) return;
    }
    if (even.unevenness() < front_.unevenness()) front_.points = even.points;
  }

  void fill_triangle() {
    int sides = 1;
    while ((sides + 2) * (sides + 3) / 2 <= points_) ++sides;
    const std::vector<ParetoPoint> anchors = front_.points;
    for (int i = 0; i <= sides; ++i) {
      for (int j = 0; i + j <= sides; ++j) {
        if (i == sides || j == sides || (i == 0 && j == 0)) continue;  // the anchors themselves
        if (is_spent()) return;
        const double a = static_cast<double>(i) / sides, b = static_cast<double>(j) / sides;
        const Eigen::VectorXd reference = a * normalised(anchors[0]) + b * normalised(anchors[1]) + (1.0 - a - b) * normalised(anchors[2]);
        front_.points.push_back(compromise(reference));
      }
    }
  }

  const DesignProblem& problem_;
  const DesignProblem valued_;
  const int points_;
  const SolverOptions& options_;
  const int starts_;
  const std::vector<Eigen::VectorXd>& known_;
  const Stopwatch clock_;
  ParetoFront front_;
};

}  // namespace

ParetoPoint& ParetoFront::anchor(std::size_t objective) { return objectives.size() == 2 && objective == 1 ? points.back() : points[objective]; }

void ParetoFront::choose_ranges() {
  ideal.clear();
  worst.clear();
  std::vector<const ParetoPoint*> anchors;
  for (std::size_t g = 0; g < objectives.size(); ++g) anchors.push_back(&anchor(g));
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const auto by = [k](const ParetoPoint* a, const ParetoPoint* b) { return a->values[k] < b->values[k]; };
    ideal.push_back((*std::ranges::min_element(anchors, by))->values[k]);
    worst.push_back((*std::ranges::max_element(anchors, by))->values[k]);
  }
}

double ParetoFront::range(std::size_t k) const { return std::max(worst[k] - ideal[k], 1e-9 * std::abs(worst[k]) + 1e-300); }

Eigen::VectorXd ParetoFront::normalised(const ParetoPoint& point) const {
  Eigen::VectorXd f(static_cast<Eigen::Index>(point.values.size()));
  for (std::size_t k = 0; k < point.values.size(); ++k) f[static_cast<Eigen::Index>(k)] = (point.values[k] - ideal[k]) / range(k);
  return f;
}

void ParetoFront::mark_dominated() {
  if (ideal.empty()) return;
  const auto keeps = [](const ParetoPoint& point) { return point.constraint_violation <= DesignLog::tolerance; };
  for (ParetoPoint& a : points) {
    a.dominated = std::ranges::any_of(points, [&](const ParetoPoint& b) {
      if (keeps(a) && !keeps(b)) return false;
      const Eigen::VectorXd ahead = normalised(a) - normalised(b);
      return ahead.minCoeff() >= 0.0 && ahead.maxCoeff() > same;
    });
  }
}

void resolve_front(const DesignProblem& problem, const std::vector<OutputConstraint>& asked, const DesignResolver& resolve,
                   const std::vector<Eigen::VectorXd>& known, ParetoFront& front, const FurtherErrorsOf& further_errors_of) {
  DesignProblem valued = with_all(problem, front.objectives);
  const auto shown = [&](ParetoPoint point) {
    const DesignAnalysis& analysis = valued.analyse(point.x, false);
    if (!analysis.usable()) return point;
    const std::vector<ResolvedCycle> cycles = resolve(analysis);
    const FurtherError further = further_errors_of ? further_errors_of(analysis, cycles) : FurtherError();
    point.values.clear();
    point.errors.clear();
    for (const ResolvedValue& resolved : resolved_values(valued, front.objectives, analysis, cycles, further)) {
      point.values.push_back(resolved.value);
      point.errors.push_back(resolved.error);
    }
    DesignReport report = report_design(problem, analysis);
    resolve_report(problem, cycles, report);
    point.constraint_values = report.constraint_values;
    point.modification_values = report.modification_values;
    point.constraint_violation = problem.violation(analysis.modification);
    for (std::size_t c = 0; c < asked.size(); ++c)
      point.constraint_violation = std::max(point.constraint_violation, asked[c].excess(report.constraint_values[c]));
    return point;
  };
  for (ParetoPoint& point : front.points) point = shown(std::move(point));
  if (front.ideal.empty()) return;
  for (const Eigen::VectorXd& x : known) {
    const ParetoPoint point = shown({x, {}, SolverStatus::Converged, 0.0});
    if (point.values.empty()) continue;
    for (std::size_t g = 0; g < front.objectives.size(); ++g) {
      ParetoPoint& best = front.anchor(g);
      if (point.constraint_violation <= std::max(best.constraint_violation, DesignLog::tolerance) && point.values[g] < best.values[g]) best = point;
    }
  }
  front.choose_ranges();
  front.mark_dominated();
}

double ParetoFront::unevenness() const {
  if (objectives.size() != 2 || points.size() < 3 || ideal.empty()) return not_given;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    double square = 0.0;
    for (std::size_t k = 0; k < 2; ++k) square += std::pow((points[i + 1].values[k] - points[i].values[k]) / (worst[k] - ideal[k]), 2);
    shortest = std::min(shortest, std::sqrt(square));
    longest = std::max(longest, std::sqrt(square));
  }
  return longest / shortest;
}

ParetoFront trace_front(const DesignProblem& problem, const std::vector<Objective>& objectives, int points, const DesignOptions& options,
                        const std::vector<Eigen::VectorXd>& known) {
  options.solver.validate();
  if (objectives.size() < 2 || objectives.size() > 3)
    throw InvalidInput("optimise.pareto.objectives", std::to_string(objectives.size()), "two or three");
  if (points < static_cast<int>(objectives.size())) {
    throw InvalidInput("optimise.pareto.points", std::to_string(points), "at least one for each objective");
  }
  const std::string& solver = options.solver.name;
  if (!uses_gradients(solver) || !accepts_constraints(solver)) {
    throw InvalidInput("optimise.solver", solver, "a solver with gradients and constraints for a Pareto front, such as ipopt");
  }
  return FrontTracing(problem, objectives, points, options, known).trace();
}

}  // namespace flankwright
