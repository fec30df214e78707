#include "optimize/design/grinding/grindable_design.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/search/local_run.hpp"
#include "optimize/design/grinding/rounding.hpp"

namespace flankwright {

namespace {

/// Less than this is nothing [mm; parabolic_te 1/rad].
constexpr double nothing = 1e-6;
/// A search that goes on with one amount held needs some ten analyses; a kink may hold it up for longer than it is worth.
constexpr int most_analyses_of_alternative = 40;
/// Steps of one unit and of pairs around an optimum end before this many analyses where there are up to ten variables.
constexpr int most_rounding_analyses = 1000;

/// Part of 0 .. 1 for every variable.
struct Box {
  Eigen::VectorXd lower, upper;

  void hold(int i, double x) { lower[i] = upper[i] = x; }
  Eigen::VectorXd clamped(const Eigen::VectorXd& x) const { return x.cwiseMax(lower).cwiseMin(upper); }
};

/// The choices between what can be ground, one after the other.
class GrindableSearch {
 public:
  GrindableSearch(const DesignProblem& problem, const Eigen::VectorXd& x, const HeldSearch& search)
      : problem_(problem), task_(problem.task()), search_(search), box_{problem.lower(), problem.upper()}, x_(x) {}

  SettledAmounts run() {
    while (const std::optional<Question> question = next_question()) decide(*question);
    settle();
    return {x_, box_.lower, box_.upper, std::move(choices_)};
  }

 private:
  /// One way, and the box that it leaves.
  struct Way {
    GrindingAlternative alternative;
    Box box;
  };
  struct Question {
    std::vector<GrindingChoice::Amount> amounts;
    std::vector<Way> ways;
  };

  const DesignVariable& variable(int i) const { return task_.variables[static_cast<std::size_t>(i)]; }
  double value(const Eigen::VectorXd& x, int i) const { return problem_.unscaled(x, i); }

  /// The largest of a parameter, or of its halves, in a design.
  double amount(const Eigen::VectorXd& x, Member member, ModificationParameter parameter) const {
    const Modification m = problem_.modification(x)[member];
    const ParameterDescription& row = describe(parameter);
    if (row.half.empty()) return get(m, parameter);
    const double one = find_parameter(row.half)->get(m), other = find_parameter(row.other_half)->get(m);
    return std::abs(one) > std::abs(other) ? one : other;
  }

  bool can_be_zero(int i) const {
    const double low = value(box_.lower, i), high = value(box_.upper, i);
    return low <= nothing && high >= -nothing;
  }

  /// The box with an amount at zero; nothing where the variables cannot hold it there.
  std::optional<Box> at_zero(Member member, ModificationParameter parameter) const {
    Box held = box_;
    for (int i = 0; i < problem_.variables(); ++i) {
      const bool follows = std::ranges::any_of(
          task_.links, [&](const LinkingConstraint& link) { return static_cast<int>(link.as) == i && link.linked.touches(member, parameter); });
      if (!follows && !variable(i).touches(member, parameter)) continue;
      if (!can_be_zero(i)) return std::nullopt;
      held.hold(i, std::clamp(variable(i).scaled(0.0), 0.0, 1.0));
    }
    if (std::abs(amount(held.clamped(x_), member, parameter)) > nothing) return std::nullopt;
    return held;
  }

  /// What variable i is at least, either way, so that it and what is tied to it can be ground [mm]: on its steps, where it has any; 0: no limit.
  double smallest(int i) const {
    const DesignVariable& v = variable(i);
    if (task_.grindable.smallest == 0.0 || describe(v.parameter).kind != ParameterKind::Amount) return 0.0;
    double factor = 1.0;
    for (const LinkingConstraint& link : task_.links) {
      if (static_cast<int>(link.as) == i && link.factor != 0.0) factor = std::min(factor, std::abs(link.factor));
    }
    const double least = task_.grindable.smallest / factor;
    constexpr double round_off = 1e-9;  // of a step
    return v.step > 0.0 ? std::ceil(least / v.step - round_off) * v.step : least;
  }

  std::optional<Question> next_question() const {
    for (const ExcludedPair& pair : task_.grindable.not_together) {
      if (auto question = question_of(pair)) return question;
    }
    int least = -1;
    double least_part = 1.0 - 1e-9;  // round-off
    for (int i = 0; i < problem_.variables(); ++i) {
      const double part = smallest(i) > 0.0 ? std::abs(value(x_, i)) / smallest(i) : 1.0;
      if (std::abs(value(x_, i)) <= nothing && can_be_zero(i)) continue;
      if (part >= least_part) continue;
      least = i;
      least_part = part;
    }
    return least < 0 ? std::nullopt : std::optional(question_of(least));
  }

  std::optional<Question> question_of(const ExcludedPair& pair) const {
    const double one = amount(x_, pair.member, pair.one), other = amount(x_, pair.member, pair.other);
    if (std::abs(one) <= nothing || std::abs(other) <= nothing) return std::nullopt;
    Question question{{{pair.member, pair.one, one}, {pair.member, pair.other, other}}, {}};
    for (std::size_t k = 0; k < 2; ++k) {
      if (auto box = at_zero(pair.member, question.amounts[k].parameter)) question.ways.push_back({{.amount = k}, std::move(*box)});
    }
    if (question.ways.empty())
      throw InvalidInput("optimise.grinding.not_together", pair_in_words(pair), "a pair of which the variables can hold one at 0");
    return question;
  }

  static std::string pair_in_words(const ExcludedPair& pair) {
    return std::string(name_of(pair.member)) + " " + std::string(describe(pair.one).name) + " and " + std::string(describe(pair.other).name);
  }

  Question question_of(int i) const {
    const DesignVariable& v = variable(i);
    const double found = value(x_, i), limit = smallest(i);
    Question question{{{v.member, v.parameter, found}}, {}};
    const auto add = [&](HeldAmount held, double low, double high) {
      Way way{{.amount = 0, .held = held, .limit = held == HeldAmount::AtZero ? 0.0 : held == HeldAmount::AtLeast ? limit : -limit}, box_};
      way.box.lower[i] = std::max(box_.lower[i], v.scaled(low));
      way.box.upper[i] = std::min(box_.upper[i], v.scaled(high));
      if (way.box.lower[i] <= way.box.upper[i]) question.ways.push_back(std::move(way));
    };
    if (can_be_zero(i)) {
      const double zero = std::clamp(v.scaled(0.0), 0.0, 1.0);
      question.ways.push_back({{.amount = 0}, box_});
      question.ways.back().box.hold(i, zero);
    }
    const bool rises = found > 0.0 || (found == 0.0 && v.upper >= limit);
    rises ? add(HeldAmount::AtLeast, limit, v.upper) : add(HeldAmount::AtMost, v.lower, -limit);
    if (question.ways.empty()) {
      throw InvalidInput("optimise.grinding.smallest_amount", std::to_string(task_.grindable.smallest / units::um) + " um",
                         "one that the range of " + v.path + " reaches, or a range that holds 0");
    }
    return question;
  }

  static bool is_better(const GrindingAlternative& one, const GrindingAlternative& than) {
    if (std::isnan(one.objective) || std::isnan(than.objective)) return std::isnan(than.objective) && !std::isnan(one.objective);
    const auto rank = [](const GrindingAlternative& of) {
      return std::tuple(DesignLog::beyond_tolerance(of.modification_violation), DesignLog::beyond_tolerance(of.constraint_violation), of.objective);
    };
    return rank(one) < rank(than);
  }

  void decide(const Question& question) {
    GrindingChoice choice{question.amounts, {}, 0};
    std::vector<Eigen::VectorXd> designs;
    for (const Way& way : question.ways) {
      const HeldDesign run = search_(way.box.lower, way.box.upper, x_);
      GrindingAlternative tried = way.alternative;
      const GrindingChoice::Amount& held = choice.amounts[tried.amount];
      tried.value = amount(run.x, held.member, held.parameter);
      tried.objective = run.objective;
      tried.constraint_violation = run.constraint_violation;
      tried.modification_violation = problem_.violation(problem_.modification(run.x));
      designs.push_back(run.x);
      choice.tried.push_back(tried);
      if (is_better(tried, choice.tried[choice.taken])) choice.taken = choice.tried.size() - 1;
    }
    box_ = question.ways[choice.taken].box;
    x_ = box_.clamped(designs[choice.taken]);
    choices_.push_back(std::move(choice));
  }

  /// Holds what rounding could otherwise raise from zero, or lower from what can be ground.
  void settle() {
    for (int i = 0; i < problem_.variables(); ++i) {
      const double limit = smallest(i), now = value(x_, i);
      if (limit == 0.0) continue;
      const DesignVariable& v = variable(i);
      if (std::abs(now) <= nothing) {
        box_.hold(i, std::clamp(v.scaled(0.0), 0.0, 1.0));
      } else if (now > 0.0) {
        box_.lower[i] = std::max(box_.lower[i], v.scaled(limit));
      } else {
        box_.upper[i] = std::min(box_.upper[i], v.scaled(-limit));
      }
    }
    for (const ExcludedPair& pair : task_.grindable.not_together) {
      for (const ModificationParameter parameter : {pair.one, pair.other}) {
        if (std::abs(amount(x_, pair.member, parameter)) > nothing) continue;
        if (auto held = at_zero(pair.member, parameter)) box_ = std::move(*held);
      }
    }
    x_ = box_.clamped(x_);
  }

  const DesignProblem& problem_;
  const DesignTask& task_;
  const HeldSearch& search_;
  Box box_;
  Eigen::VectorXd x_;
  std::vector<GrindingChoice> choices_;
};

/// Searches of alternatives by the analyses of all scenes, with their books.
class AlternativeSearch {
 public:
  AlternativeSearch(const DesignProblem& problem, const SolverOptions& options) : problem_(problem), options_(options) {
    if (options.finisher != "none") options_.name = options.finisher;
    options_.finisher = "none";
    options_.progress = nullptr;
  }

  HeldDesign search(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Eigen::VectorXd& start) {
    DesignProblem held = problem_;
    held.set_box(lower, upper);
    held.set_start(start);
    SolverOptions options = options_;
    options.max_evaluations = std::clamp(options_.max_evaluations - analyses_, 1, most_analyses_of_alternative);
    options.max_seconds = std::max(1e-3, options_.max_seconds - clock_.seconds());
    const LocalRun run = run_local(held, options);
    analyses_ += run.evaluations;
    failures_ += run.failures;
    return {run.x, run.objective, run.constraint_violation};
  }

  int analyses() const { return analyses_; }
  int failures() const { return failures_; }

 private:
  const DesignProblem& problem_;
  SolverOptions options_;
  const Stopwatch clock_;
  int analyses_{0}, failures_{0};
};

}  // namespace

SettledAmounts settle_amounts(const DesignProblem& problem, const Eigen::VectorXd& x, const HeldSearch& search) {
  return GrindableSearch(problem, x, search).run();
}

DesignToGrind design_to_grind(DesignProblem& problem, const Eigen::VectorXd& x, const SolverOptions& options) {
  DesignToGrind design{.x = x, .choices = {}};
  const Box whole{problem.lower(), problem.upper()};
  if (problem.task().grindable.any()) {
    AlternativeSearch alternatives(problem, options);
    SettledAmounts settled =
        settle_amounts(problem, x, [&](const auto& lower, const auto& upper, const auto& start) { return alternatives.search(lower, upper, start); });
    design.x = settled.x;
    design.choices = std::move(settled.choices);
    design.analyses = design.choice_analyses = alternatives.analyses();
    design.failures = alternatives.failures();
    problem.set_box(settled.lower, settled.upper);
  }
  if (has_steps(problem.task())) {
    const int budget = std::clamp(options.max_evaluations - design.analyses, 1, most_rounding_analyses);
    const RoundedDesign rounded = round_design(problem, design.x, budget);
    design.x = rounded.x;
    design.analyses += rounded.analyses;
  }
  problem.set_box(whole.lower, whole.upper);
  design.is_changed = !design.choices.empty() || has_steps(problem.task());
  return design;
}

}  // namespace flankwright
