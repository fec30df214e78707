#include "optimize/solvers/solver_options.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

constexpr std::array solvers{
    SolverTraits{"ipopt", true, true, false, 1},
    SolverTraits{"nlopt:slsqp", true, true, false, 1},
    SolverTraits{"nlopt:mma", true, true, false, 1},
    SolverTraits{"nlopt:ccsaq", true, true, false, 1},
    SolverTraits{"nlopt:lbfgs", true, false, false, 1},
    SolverTraits{"nlopt:cobyla", false, true, false, 1},
    SolverTraits{"nlopt:bobyqa", false, false, false, 2},
    SolverTraits{"nlopt:sbplx", false, false, false, 1},
    SolverTraits{"nlopt:neldermead", false, false, false, 1},
    SolverTraits{"nlopt:crs2_lm", false, false, true, 1},
    SolverTraits{"nlopt:isres", false, true, true, 1},
    SolverTraits{"nlopt:direct_l", false, false, true, 1},
    SolverTraits{"nlopt:esch", false, false, true, 1},
    SolverTraits{"nlopt:mlsl", true, false, true, 1},
};

/// An epigraph can be handed on to it.
bool can_finish(const SolverTraits& traits) { return traits.gradients && traits.constraints; }

}  // namespace

std::string solvers_where(const std::function<bool(const SolverTraits&)>& condition) {
  std::string names;
  for (const SolverTraits& traits : solvers) {
    if (!condition(traits)) continue;
    if (!names.empty()) names += ", ";
    names += traits.name;
  }
  return names;
}

const SolverTraits& solver_traits(const std::string& name) {
  const auto* found = std::find_if(solvers.begin(), solvers.end(), [&](const SolverTraits& t) { return t.name == name; });
  if (found == solvers.end()) {
    throw InvalidInput("optimise.solver", name, "one of " + solvers_where([](const SolverTraits&) { return true; }));
  }
  return *found;
}

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
  solver_traits(name);
  if (const auto names = finisher_names(); std::ranges::find(names, finisher) == names.end()) {
    throw InvalidInput("optimise.finisher", finisher, "one of none, " + solvers_where(can_finish));
  }
  const auto require = [](bool good, const char* field, double value, const char* allowed) {
    if (!good) throw InvalidInput(field, std::to_string(value), allowed);
  };
  // Written so that NaN is refused.
  require(tolerance > 0.0 && tolerance < 1.0, "optimise.tolerance", tolerance, "a number above 0 and below 1");
  require(constraint_tolerance > 0.0 && constraint_tolerance < std::numeric_limits<double>::infinity(), "optimise.constraint_tolerance",
          constraint_tolerance, "a finite number above 0");
  require(max_evaluations >= 1, "optimise.max_evaluations", max_evaluations, "an integer of at least 1");
  require(max_seconds > 0.0, "optimise.max_seconds", max_seconds, "a number above 0");
}

bool uses_gradients(const std::string& solver_name) { return solver_traits(solver_name).gradients; }

bool accepts_constraints(const std::string& solver_name) { return solver_traits(solver_name).constraints; }

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const SolverTraits& traits : solvers) names.emplace_back(traits.name);
  return names;
}

std::vector<std::string> finisher_names() {
  std::vector<std::string> names{"none"};
  for (const SolverTraits& traits : solvers) {
    if (can_finish(traits)) names.emplace_back(traits.name);
  }
  return names;
}

}  // namespace flankwright
