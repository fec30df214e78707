#include "optimize/solvers/solver.hpp"

#include <string>

#include "core/base/error.hpp"
#include "optimize/solvers/ipopt_adapter.hpp"
#include "optimize/solvers/nlopt_adapter.hpp"
#include "optimize/solvers/recorder.hpp"

namespace flankwright {

namespace {

void require_acceptable(const SolverTraits& traits, const Recorder& recorder, int free_variables) {
  const std::string name{traits.name};
  const int m = recorder.program().constraints();
  if (m > 0 && !traits.constraints) {
    throw InvalidInput("optimise.solver", name + " with " + std::to_string(m) + " constraints",
                       "a solver that takes constraints: " + solvers_where([](const SolverTraits& t) { return t.constraints; }));
  }
  if (traits.global && !(recorder.lower().allFinite() && recorder.upper().allFinite())) {
    throw InvalidInput("optimise.solver", name + " with an infinite bound", "finite bounds for a global solver");
  }
  if (free_variables > 0 && free_variables < traits.least_free_variables) {
    throw InvalidInput("optimise.solver", name + " with " + std::to_string(free_variables) + " free variable",
                       "at least " + std::to_string(traits.least_free_variables) + " free variables for this solver");
  }
}

SolverEnding run(Recorder& recorder, const SolverOptions& options, const SolverTraits& traits, int free_variables) {
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

SolverResult solve(NonlinearProgram& program, const SolverOptions& options) {
  options.validate();
  const SolverTraits& traits = solver_traits(options.name);
  Recorder recorder(program, options, traits.gradients);
  const auto free_variables = static_cast<int>((recorder.upper().array() > recorder.lower().array()).count());
  require_acceptable(traits, recorder, free_variables);
  return recorder.result(run(recorder, options, traits, free_variables));
}

}  // namespace flankwright
