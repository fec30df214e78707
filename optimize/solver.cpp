#include "optimize/solver.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/base/error.hpp"
#include "optimize/ipopt_adapter.hpp"
#include "optimize/nlopt_adapter.hpp"
#include "optimize/recorder.hpp"

namespace flankwright {

namespace {

/// What a solver needs and takes.
struct Traits {
  std::string_view name;
  bool gradients;    ///< uses them
  bool constraints;  ///< accepts c(x) <= 0
  bool global;       ///< searches the whole box: needs finite bounds, survives a start that cannot be evaluated
  int least_free_variables;
};

constexpr std::array kSolvers{
    Traits{"ipopt", true, true, false, 1},
    Traits{"nlopt:slsqp", true, true, false, 1},
    Traits{"nlopt:mma", true, true, false, 1},
    Traits{"nlopt:ccsaq", true, true, false, 1},
    Traits{"nlopt:lbfgs", true, false, false, 1},
    Traits{"nlopt:cobyla", false, true, false, 1},
    Traits{"nlopt:bobyqa", false, false, false, 2},
    Traits{"nlopt:sbplx", false, false, false, 1},
    Traits{"nlopt:neldermead", false, false, false, 1},
    Traits{"nlopt:crs2_lm", false, false, true, 1},
    Traits{"nlopt:isres", false, true, true, 1},
    Traits{"nlopt:direct_l", false, false, true, 1},
    Traits{"nlopt:esch", false, false, true, 1},
    Traits{"nlopt:mlsl", true, false, true, 1},
};

template <typename Condition>
std::string names_where(Condition condition) {
  std::string names;
  for (const Traits& traits : kSolvers) {
    if (!condition(traits)) continue;
    if (!names.empty()) names += ", ";
    names += traits.name;
  }
  return names;
}

/// An epigraph can be handed on to it.
bool can_finish(const Traits& traits) { return traits.gradients && traits.constraints; }

const Traits& traits_of(const std::string& name) {
  const auto* found = std::find_if(kSolvers.begin(), kSolvers.end(), [&](const Traits& t) { return t.name == name; });
  if (found == kSolvers.end()) {
    throw InvalidInput("optimise.solver", name, "one of " + names_where([](const Traits&) { return true; }));
  }
  return *found;
}

void require_acceptable(const Traits& traits, const Recorder& recorder, int free_variables) {
  const std::string name{traits.name};
  const int m = recorder.program().constraints();
  if (m > 0 && !traits.constraints) {
    throw InvalidInput(
        "optimise.solver", name + " with " + std::to_string(m) + " constraints",
        "a solver that takes constraints: " + names_where([](const Traits& t) { return t.constraints; }));
  }
  if (traits.global && !(recorder.lower().allFinite() && recorder.upper().allFinite())) {
    throw InvalidInput("optimise.solver", name + " with an infinite bound", "finite bounds for a global solver");
  }
  if (free_variables > 0 && free_variables < traits.least_free_variables) {
    throw InvalidInput("optimise.solver", name + " with " + std::to_string(free_variables) + " free variable",
                       "at least " + std::to_string(traits.least_free_variables) + " free variables for this solver");
  }
}

SolverEnding run(Recorder& recorder, const SolverOptions& options, const Traits& traits, int free_variables) {
  try {
    const bool usable = recorder.at(recorder.start(), false).usable;
    if (free_variables == 0) return {SolverStatus::Converged, "every variable is fixed", recorder.start(), {}};
    if (!usable && !traits.global) return {SolverStatus::Failed, "the start cannot be evaluated", {}, {}};
    return traits.name == "ipopt" ? solve_with_ipopt(recorder, options) : solve_with_nlopt(recorder, options);
  } catch (const StopRun&) {
    return recorder.stop_reason();
  }
}

}  // namespace

std::string to_string(SolverStatus status) {
  switch (status) {
    case SolverStatus::NotRun:
      return "not run";
    case SolverStatus::Converged:
      return "converged";
    case SolverStatus::EvaluationLimit:
      return "evaluation limit";
    case SolverStatus::TimeLimit:
      return "time limit";
    case SolverStatus::Stalled:
      return "stalled";
    case SolverStatus::Infeasible:
      return "infeasible";
    case SolverStatus::Failed:
      return "failed";
  }
  return "unknown";
}

void SolverOptions::validate() const {
  traits_of(name);
  if (const auto names = finisher_names(); std::ranges::find(names, finisher) == names.end()) {
    throw InvalidInput("optimise.finisher", finisher, "one of none, " + names_where(can_finish));
  }
  const auto require = [](bool good, const char* field, double value, const char* allowed) {
    if (!good) throw InvalidInput(field, std::to_string(value), allowed);
  };
  // Written so that NaN is refused.
  require(tolerance > 0.0 && tolerance < 1.0, "optimise.tolerance", tolerance, "a number above 0 and below 1");
  require(constraint_tolerance > 0.0 && constraint_tolerance < std::numeric_limits<double>::infinity(),
          "optimise.constraint_tolerance", constraint_tolerance, "a finite number above 0");
  require(max_evaluations >= 1, "optimise.max_evaluations", max_evaluations, "an integer of at least 1");
  require(max_seconds > 0.0, "optimise.max_seconds", max_seconds, "a number above 0");
}

SolverResult solve(NonlinearProgram& program, const SolverOptions& options) {
  options.validate();
  const Traits& traits = traits_of(options.name);
  Recorder recorder(program, options, traits.gradients);
  const auto free_variables = static_cast<int>((recorder.upper().array() > recorder.lower().array()).count());
  require_acceptable(traits, recorder, free_variables);
  return recorder.result(run(recorder, options, traits, free_variables));
}

bool uses_gradients(const std::string& solver_name) {
  return traits_of(solver_name).gradients;
}

bool accepts_constraints(const std::string& solver_name) {
  return traits_of(solver_name).constraints;
}

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const Traits& traits : kSolvers) names.emplace_back(traits.name);
  return names;
}

std::vector<std::string> finisher_names() {
  std::vector<std::string> names{"none"};
  for (const Traits& traits : kSolvers) {
    if (can_finish(traits)) names.emplace_back(traits.name);
  }
  return names;
}

}  // namespace flankwright
