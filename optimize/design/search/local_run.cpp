#include "optimize/design/search/local_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "optimize/design/search/deciding_scenes.hpp"
#include "optimize/design/search/direct_program.hpp"
#include "optimize/design/search/epigraph_program.hpp"

namespace flankwright {

namespace {

constexpr int most_rounds = 20;
/// A search ends by these shares, or by its solver's tolerance where that is larger.
constexpr double round_tolerance = 1e-6;  // see run_local()
constexpr double stall_gain = 1e-5;       // share of the objective at the start

/// A worst case over fewer scenes is searched over all of them: the others save less than a second search costs where the first has left out the wrong ones.
constexpr int fewest_scenes_to_choose_from = 12;
/// Scenes take part whose measure is less below the worst than this share, see deciding_scenes(): a search moves those beside it as well.
constexpr double nearly_deciding = 0.01;
/// SolverOptions::tolerance of a search that is to find out which scenes decide.
constexpr double short_step = 0.01;

double round_tolerance_of(const SolverOptions& options) { return std::max(round_tolerance, options.tolerance); }
double stall_gain_of(const SolverOptions& options) { return std::max(stall_gain, options.tolerance); }

/// A solver that gains less than stall_gain_of() in so many analyses has met a kink that it cannot follow: a contact point that comes and
/// goes, a peak that the programme has no candidate of yet, or the start of a relief that passes a point. An active-set method steps to the
/// corner of its linearised constraints at once, so that a few steps without gain are enough to begin a new round from the best design, with
/// the candidates met meanwhile. Only where that round gains nothing either it is given the patience of the others.
constexpr std::size_t patient = 80, impatient = 8;

std::size_t patience_of(const std::string& solver) { return solver == "nlopt:slsqp" ? impatient : patient; }

/// How good the best design is: its true objective as the programme sees it, or how far it violates the constraints as long as it does.
struct Standing {
  bool feasible{false};
  double value{std::numeric_limits<double>::infinity()};  ///< [-]

  /// @param objective  as the programme sees it
  static Standing of(double objective, double violation) {
    const bool feasible = violation <= DesignLog::tolerance;
    return {feasible, feasible ? objective : violation};
  }
  static Standing of(const EpigraphProgram& program, const DesignLog::Entry& entry) {
    return of(program.seen(entry.objective), entry.constraint_violation);
  }
  static Standing of(const EpigraphProgram& program, const DesignLog& log) { return of(program, *log.best()); }
  /// Better than before by more than a share of the objective at the start, or of the bounds that are violated.
  bool gains_on(const Standing& before, double share) const { return feasible != before.feasible || !(value >= before.value - share); }
};

/// Whether the rows see the last design better than the best before it, which it is not: a peak has no candidate yet. All steps to come would go after the same
/// gain that is none, so that a round ends there, and the next has the candidates of that design. At least one is new, or it is a stall like others.
bool adds_overlooked(EpigraphProgram& program, const DesignLog& log, const Standing& best, double least_gain) {
  const auto& [objective, violation] = program.seen_by_rows();
  if (std::isnan(objective) || best.value == std::numeric_limits<double>::infinity()) return false;
  const Standing by_rows = Standing::of(objective, violation), last = Standing::of(program, log.entries().back());
  const bool is_better = last.feasible != best.feasible ? last.feasible : last.value < best.value;
  const bool seems_better = by_rows.feasible != best.feasible ? by_rows.feasible : by_rows.value < best.value - least_gain;
  return seems_better && !is_better && program.add_candidates(log.entries().back().x) > 0;
}

/// Says that a search has stalled. `log` may still be empty when it is asked.
/// @param overlooked  set where it ends by adds_overlooked(); null: it does not
std::function<std::string()> when_stalled(EpigraphProgram& program, const DesignLog& log, double least_gain, std::size_t window, bool* overlooked) {
  return [&program, &log, window, least_gain, overlooked, at = std::size_t{0}, best = Standing{}]() mutable -> std::string {
    if (log.best() == nullptr) return {};
    const Standing now = Standing::of(program, log);
    const double gain = now.feasible ? least_gain * std::abs(program.seen(log.entries().front().objective)) : least_gain;
    if (overlooked != nullptr && adds_overlooked(program, log, best, gain)) {
      *overlooked = true;
      return "a peak that the programme had no candidate of";
    }
    if (now.gains_on(best, gain)) {
      best = now;
      at = log.entries().size();
    }
    if (log.entries().size() < at + window) return {};
    char share[16];
    std::snprintf(share, sizeof share, "%.2g", 100.0 * least_gain);
    return "gained less than " + std::string(share) + " % in " + std::to_string(window) + " analyses: a kink";
  };
}

/// The remaining budget of the next round.
SolverOptions remaining(const SolverOptions& options, int used, double seconds) {
  SolverOptions left = options;
  left.max_evaluations = std::max(1, options.max_evaluations - used);
  left.max_seconds = std::max(1e-3, options.max_seconds - seconds);
  left.progress = nullptr;  // the design log reports progress
  return left;
}

/// Rounds of the epigraph; fills status, message, failures and rounds.
void run_epigraph(DesignProblem& problem, DesignLog& log, const SolverOptions& options, LocalRun& run) {
  const Stopwatch clock;
  const int analyses_before = problem.analyses();
  EpigraphProgram program(problem, log);
  Standing last;
  std::string solver = options.name;
  std::size_t patience = patience_of(solver);
  const bool has_finisher = options.finisher != "none" && options.finisher != options.name;
  run.rounds = 0;
  for (int whole_rounds = 0; whole_rounds < most_rounds;) {
    ++run.rounds;
    SolverOptions round = remaining(options, problem.analyses() - analyses_before, clock.seconds());
    round.name = solver;
    // Others than an active-set method do not go down at every step.
    bool overlooked = false;
    round.stop_when = when_stalled(program, log, stall_gain_of(options), patience, patience_of(solver) == impatient ? &overlooked : nullptr);
    const SolverResult solved = solve(program, round);
    run.status = solved.status;
    if (overlooked && solved.status == SolverStatus::Stalled) {
      program.restart_from(log.best()->x);
      continue;
    }
    ++whole_rounds;
    run.message = run.finished_by.empty() ? solved.message : solved.message + " (after " + options.name + " stalled on a kink: " + solver + ")";
    run.failures += solved.failures;
    if (solved.x.size() == 0 || solved.status == SolverStatus::EvaluationLimit || solved.status == SolverStatus::TimeLimit) break;
    const Eigen::VectorXd x = program.design(solved.x);
    const DesignAnalysis& analysis = problem.analyse(x, true);
    log.record(problem, x, analysis);
    const bool stalled = solved.status == SolverStatus::Stalled;
    // Done when the true peaks are what the candidates promised, or a stalled round has gained nothing with patience.
    const double excess = program.seen(log.entries().back().objective) - solved.objective;
    const bool holds = excess <= round_tolerance_of(options) && log.entries().back().constraint_violation <= DesignLog::tolerance;
    const Standing best = Standing::of(program, log);
    // A majorant has a next one, as long as rounds descend.
    const bool settled = !program.is_majorant() || !best.gains_on(last, round_tolerance_of(options));
    const bool all_known = program.add_candidates(x) == 0, gained = best.gains_on(last, stall_gain_of(options));
    last = best;
    // Where no design keeps the limits, another round from the same one repeats the last: the excess is searched next, see optimise_design().
    const bool leaves_it_to_the_excess = !best.feasible && !gained && problem.has_upper_bounds();
    if (leaves_it_to_the_excess) {
      run.status = SolverStatus::Infeasible;
      run.message += "; no design that keeps the limits was met";
      break;
    }
    const bool is_done = ((all_known || holds) && settled && !stalled) || (stalled && !gained && patience == patient);
    if (stalled && has_finisher && run.finished_by.empty()) {
      run.finished_by = solver = options.finisher;
      patience = patience_of(solver);
    } else if (is_done) {
      break;
    } else if (stalled && !gained) {
      patience = patient;
    }
    program.restart_from(log.best()->x);
  }
}

/// One search over all scenes of a problem.
LocalRun run_over_all(DesignProblem& problem, const SolverOptions& options) {
  const Stopwatch clock;
  const int analyses_before = problem.analyses();
  LocalRun run;
  run.start = problem.start();
  run.failures = 0;
  run.epigraph = uses_gradients(options.name) && accepts_constraints(options.name);
  DesignLog log(options.progress);
  if (run.epigraph) {
    try {
      run_epigraph(problem, log, options, run);
    } catch (const InvalidInput&) {
      throw;
    } catch (const std::runtime_error& error) {
      run.status = SolverStatus::Failed;
      run.message = std::string("the start cannot be analysed: ") + error.what();
      ++run.failures;
    }
  } else {
    DirectProgram program(problem, log);
    const SolverResult solved = solve(program, remaining(options, 0, 0.0));
    run.status = solved.status;
    run.message = solved.message;
    run.failures = solved.failures;
    run.rounds = 1;
  }
  run.evaluations = problem.analyses() - analyses_before;
  for (std::size_t i = 0; i < log.entries().size(); ++i) {
    run.history.push_back({static_cast<int>(i) + 1, log.entries()[i].objective, log.entries()[i].constraint_violation});
  }
  run.x = run.start;
  if (const DesignLog::Entry* best = log.best()) {
    run.x = best->x;
    run.objective = best->objective;
    run.constraint_violation = best->constraint_violation;
  }
  run.seconds = clock.seconds();
  return run;
}

/// Takes up a search over some of the scenes as a part of a run over all.
void add_part(const LocalRun& part, LocalRun& run) {
  run.status = part.status;
  run.message = part.message;
  if (!part.finished_by.empty()) run.finished_by = part.finished_by;
  run.failures += part.failures;
  run.rounds += part.rounds;
  const int before = static_cast<int>(std::ssize(run.history));
  for (SolverStep step : part.history) {
    step.evaluation += before;
    run.history.push_back(step);
  }
}

/// Searches over the scenes that decide, held against all, until no other scene does.
LocalRun run_over_deciding(DesignProblem& problem, const SolverOptions& options) {
  const Stopwatch clock;
  const int analyses_before = problem.analyses();
  LocalRun run;
  run.start = run.x = problem.start();
  run.epigraph = true;
  run.failures = run.rounds = 0;
  DesignLog log(nullptr);
  log.record(problem, run.x, problem.analyse(run.x, false));
  std::set<int> scenes = deciding_scenes(problem, problem.analyse(run.x, false), nearly_deciding);
  scenes.merge(worst_scenes(problem, problem.analyse(run.x, false), problem.scenes() / 4));
  int analyses_of_parts = 0;
  const auto evaluations = [&] { return problem.analyses() - analyses_before + analyses_of_parts; };
  bool is_first = true, is_done = false;  // the first finds out which scenes decide
  while (!is_done) {
    DesignProblem some = problem.over_scenes({scenes.begin(), scenes.end()});
    some.set_start(run.x);
    SolverOptions rest = remaining(options, evaluations() + 1, clock.seconds());  // one is left to hold the result against all
    if (is_first) rest.tolerance = std::max(options.tolerance, short_step);
    if (options.progress)
      rest.progress = [&options, before = evaluations()](int analyses, double objective) { options.progress(before + analyses, objective); };
    const LocalRun part = run_over_all(some, rest);
    add_part(part, run);
    analyses_of_parts += part.evaluations;
    run.x = part.x;
    if (run.status != SolverStatus::Converged && run.status != SolverStatus::Stalled) break;
    const DesignAnalysis& all = problem.analyse(run.x, false);
    log.record(problem, run.x, all);
    const double excess = log.entries().back().objective - part.objective;
    const std::size_t known = scenes.size();
    if (excess > round_tolerance_of(options) * std::abs(part.objective))
      scenes.merge(deciding_scenes(problem, all, nearly_deciding, std::set<int>(scenes)));
    is_done = !is_first && scenes.size() == known;
    is_first = false;
  }
  log.record(problem, run.x, problem.analyse(run.x, false));
  run.evaluations = evaluations();
  run.x = log.best()->x;
  run.objective = log.best()->objective;
  run.constraint_violation = log.best()->constraint_violation;
  run.seconds = clock.seconds();
  return run;
}

}  // namespace

LocalRun run_local(DesignProblem& problem, const SolverOptions& options) {
  const bool epigraph = uses_gradients(options.name) && accepts_constraints(options.name);
  if (!epigraph || problem.scenes() < fewest_scenes_to_choose_from || !single_scenes_decide(problem.task())) return run_over_all(problem, options);
  try {
    return run_over_deciding(problem, options);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error&) {  // a scene cannot be analysed at a design that was held against all: says so, or finds a way round
    return run_over_all(problem, options);
  }
}

}  // namespace flankwright
