#include "studies/study_file/study_checks.hpp"

#include <algorithm>
#include <array>

#include "core/flank/conjugate_field.hpp"
#include "core/gear/gear_pair.hpp"
#include "optimize/solvers/solver.hpp"
#include "studies/compliance/study_compliance.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array members{Member::Pinion, Member::Wheel};

void refuse_key(StudyReading& reading, const std::string& path, const std::string& allowed) {
  const Match* match = reading.find(path);
  reading.refuse(reading.where(path), path, match == nullptr ? nullptr : match->node, allowed);
}

/// True for the tables that PairData is made of.
bool is_geometry(const std::string& path) {
  const std::string table = path.substr(0, path.find('.'));
  if (table == "pair") return true;
  const std::string rest = path.substr(std::min(path.size(), table.size() + 1));
  const bool is_micro = rest.starts_with("modification") || rest.starts_with("error") || rest.starts_with("material") ||
                        rest.starts_with("body") || rest.starts_with("shaft");
  return (table == "pinion" || table == "wheel") && !is_micro;
}

void check_tooth_list(StudyReading& reading, const std::string& path, const std::vector<double>& deviations,
                      int teeth) {
  if (!reading.positions.contains(path) || deviations.empty() || static_cast<int>(deviations.size()) == teeth) return;
  const Position at = reading.where(path);
  reading.problems.push_back({at.file, at.line, at.column, path, "a list of " + std::to_string(deviations.size()),
                              "allowed is one number, or a list of " + std::to_string(teeth) + ", one for each tooth"});
}

void check_tooth_lists(StudyReading& reading, const std::string& prefix, const ManufacturingError& error, int teeth) {
  check_tooth_list(reading, prefix + "pitch", error.cumulative_pitch, teeth);
  check_tooth_list(reading, prefix + "helix_slope", error.helix_slopes, teeth);
  check_tooth_list(reading, prefix + "profile_slope", error.profile_slopes, teeth);
  check_tooth_list(reading, prefix + "twist", error.twists, teeth);
}

void check_tooth_lists(StudyReading& reading) {
  const Draft& draft = reading.draft;
  for (const Member m : members) {
    const auto error_of = [m](const Scene& scene) -> const ManufacturingError& {
      return m == Member::Pinion ? scene.pinion_error : scene.wheel_error;
    };
    const std::string prefix = std::string(name_of(m)) + ".error.";
    const int teeth = draft.study.pair[m].teeth;
    check_tooth_lists(reading, prefix, error_of(draft.base), teeth);
    if (reading.find("scenes") == nullptr) continue;
    for (std::size_t i = 0; i < draft.study.scenes.size(); ++i) {
      check_tooth_lists(reading, "scenes." + std::to_string(i) + "." + prefix, error_of(draft.study.scenes[i]), teeth);
    }
  }
}

/// A variable, or what is tied to one.
const DesignVariable* find_variable(const Study& study, Member m, ModificationParameter parameter) {
  const auto& variables = study.optimise.variables;
  const auto found = std::ranges::find_if(
      variables, [&](const DesignVariable& v) { return v.member == m && v.parameter == parameter; });
  if (found != variables.end()) return &*found;
  const auto& ties = study.optimise.ties;
  const auto tie = std::ranges::find_if(ties, [&](const DesignTie& t) { return t.tied.member == m && t.tied.parameter == parameter; });
  return tie == ties.end() ? nullptr : &tie->tied;
}

bool asks_derivative(const Study& study, Member m, ModificationParameter parameter) {
  return std::ranges::any_of(study.gradients, [&](const GradientParameter& p) {
    const auto* gear = std::get_if<GearParameter>(&p.parameter);
    return gear != nullptr && gear->member == m && gear->parameter == parameter;
  });
}

/// A relief with an amount needs an extent above 0; an extent to be varied needs an amount.
void check_relief(StudyReading& reading, Member m, const ModificationDescriptor& of_amount, const ModificationDescriptor& of_extent) {
  const Study& study = reading.draft.study;
  const Modification& modification = m == Member::Pinion ? study.pinion_modification : study.wheel_modification;
  const std::string prefix = std::string(name_of(m)) + ".modification.";
  const std::string amount_path = prefix + std::string(of_amount.key), path = prefix + std::string(of_extent.key);
  const DesignVariable* amount = find_variable(study, m, of_amount.parameter);
  const DesignVariable* extent = find_variable(study, m, of_extent.parameter);
  const bool has_amount = amount != nullptr || of_amount.get(modification) != 0.0;
  if (extent != nullptr && !has_amount) {
    return refuse_key(
        reading, "optimise.variables." + path,
        "has no effect while " + amount_path + " is 0: give it a value or make it a variable");
  }
  const bool has_derivative = asks_derivative(study, m, of_amount.parameter);
  if (!has_amount && !has_derivative) return;
  if (extent != nullptr && extent->lower <= 0.0) {
    return refuse_key(reading, "optimise.variables." + path,
                      "allowed is a lower bound above 0 mm: the relief is spread over it");
  }
  if (extent != nullptr || of_extent.get(modification) > 0.0) return;
  const std::string asked_by = has_amount ? (amount != nullptr ? "optimise.variables." : "") + amount_path : "analyse.gradients";
  const bool is_given = reading.find(path) != nullptr;
  const Position at = reading.where(is_given ? path : asked_by);
  reading.refuse(at, path, is_given ? reading.find(path)->node : nullptr,
                 "set " + path + " above 0 mm: the relief's amount is spread over it");
}

/// A predesigned parabola, given or at the upper end of a variable, must have a flank.
void check_parabola(StudyReading& reading, Member m) {
  const Study& study = reading.draft.study;
  if (!reading.problems.empty()) return;  // the pair may not exist
  const std::string path = std::string(name_of(m)) + ".modification.parabolic_te";
  const auto check = [&](const std::string& key, double coefficient) {
    if (coefficient == 0.0) return;
    try {
      make_conjugate_field(make_gear_pair(study.pair), m, coefficient);
    } catch (const InvalidInput& problem) {
      refuse_key(reading, key, "allowed is " + problem.allowed());
    }
  };
  check(path, (m == Member::Pinion ? study.pinion_modification : study.wheel_modification).parabolic_te);
  if (const DesignVariable* variable = find_variable(study, m, parameter_of("parabolic_te"))) {
    check("optimise.variables." + path, variable->upper);
  }
}

/// What the finite elements of a gear refuse, before anything is solved.
void check_finite_elements(StudyReading& reading, Member m) {
  const Study& study = reading.draft.study;
  if (!reading.problems.empty() || !solves_finite_elements(study)) return;
  try {
    influence_table_task(compliance_task(study, make_gear_pair(study.pair)), m);
  } catch (const InvalidInput& problem) {
    refuse_key(reading, problem.field(), "allowed is " + problem.allowed());
  }
}

void check_variables(StudyReading& reading) {
  const OptimiseTable& optimise = reading.draft.study.optimise;
  const auto is_variable = [&](const std::string& path) {
    return std::ranges::any_of(optimise.variables, [&](const DesignVariable& v) { return v.path == path; });
  };
  for (const ExclusiveKeys& keys : exclusive_keys()) {
    if (!is_variable(keys.first) || !is_variable(keys.second)) continue;
    refuse_key(reading, "optimise.variables." + keys.second,
               "overlaps the variable " + keys.first + "; allowed is one of them");
  }
}

/// What is to be minimised or bounded must not be switched off.
void check_root_stress(StudyReading& reading) {
  const Study& study = reading.draft.study;
  const auto is_root_stress = [](const ObjectiveTerm& term) { return term.output == Output::PeakRootStress; };
  const auto asks = [&](const Goal& goal) { return std::ranges::any_of(goal.terms, is_root_stress); };
  const bool asked = std::ranges::any_of(study.optimise.objective, is_root_stress) || std::ranges::any_of(study.optimise.then, asks) ||
                     std::ranges::any_of(study.optimise.pareto_goals, asks) ||
                     std::ranges::any_of(study.optimise.constraints, is_root_stress, &OutputConstraint::output);
  if (asked && !wants_root_stress(study)) {
    refuse_key(reading, "fidelity.effects", "peak_root_stress is asked for: allowed is \"auto\" or a list with \"root_stress\"");
  }
}

void check_optimise(StudyReading& reading) {
  const Study& study = reading.draft.study;
  const Match* variables = reading.find("optimise.variables");
  const bool has_entry =
      variables != nullptr && (!variables->node->is_table() || !variables->node->as_table()->empty());
  if (!has_entry) refuse_key(reading, "optimise.variables", "task \"optimise\" needs at least one variable");
  if (!study.optimise.constraints.empty() && !accepts_constraints(study.optimise.solver)) {
    refuse_key(reading, "optimise.solver", "this solver takes no constraints; one that does: \"ipopt\"");
  }
  if (study.fidelity.compliance == ComplianceModel::Rigid) {
    refuse_key(reading, "fidelity.compliance", "task \"optimise\" needs a compliance: allowed is \"thin_slice\", \"fitted\" or \"fe\"");
  }
  const bool smooth = uses_gradients(study.optimise.solver) && accepts_constraints(study.optimise.solver);  // the epigraph is
  if (!study.optimise.pareto_goals.empty() && !smooth) {
    refuse_key(reading, "optimise.solver", "a Pareto front needs gradients and constraints: allowed is \"ipopt\", \"nlopt:slsqp\", \"nlopt:mma\" or \"nlopt:ccsaq\"");
  }
  if (study.optimise.then.size() > 0 && !accepts_constraints(study.optimise.solver)) {
    refuse_key(reading, "optimise.solver", "a list of objectives bounds the earlier ones: allowed is a solver that takes constraints, such as \"ipopt\"");
  }
  if (reading.find("optimise.finisher") != nullptr && !smooth) {
    refuse_key(reading, "optimise.finisher", "has a meaning with a solver of gradients and constraints only: \"ipopt\", \"nlopt:slsqp\", \"nlopt:mma\" or \"nlopt:ccsaq\"");
  }
  const Match* over = reading.find("optimise.over");
  const bool free_sigmas = over != nullptr && over->node->is_string() && over->node->as_string()->get() == "mean+sigmas";
  if (reading.find("optimise.sigmas") != nullptr && !free_sigmas) {
    refuse_key(reading, "optimise.sigmas", "has a meaning with optimise.over = \"mean+sigmas\" only");
  }
  check_root_stress(reading);
  for (const Scene& scene : study.scenes) {
    if (std::ranges::any_of(scene.torques, [](double torque) { return torque > 0.0; })) continue;
    return refuse_key(reading, "load.torque", "task \"optimise\" needs a torque above 0 in every scene: " + scene.name);
  }
}

}  // namespace

void check_presence(StudyReading& reading) {
  for (const ExclusiveKeys& keys : exclusive_keys()) {
    if (reading.find(keys.first) == nullptr || reading.find(keys.second) == nullptr) continue;
    refuse_key(reading, keys.second, "allowed is this or " + keys.first + ", not both");
  }
  for (const SchemaKey& key : study_schema()) {
    const bool in_list = key.path.find("[].") != std::string::npos;  // checked where the list is read
    if (in_list || !is_required(key) || reading.find(key.path) != nullptr) continue;
    const bool is_replaced = std::ranges::any_of(exclusive_keys(), [&](const ExclusiveKeys& keys) {
      return keys.first == key.path && reading.find(keys.second) != nullptr;
    });
    if (!is_replaced) refuse_key(reading, key.path, "required: allowed is " + allowed_values(key));
  }
}

void check_pair(StudyReading& reading) {
  const bool has_problem = std::ranges::any_of(
      reading.problems, [](const StudyProblem& problem) { return problem.key.empty() || is_geometry(problem.key); });
  if (has_problem) return;
  const PairData& pair = reading.draft.study.pair;
  if (reading.find("wheel.hand") != nullptr && reading.draft.wheel_hand == pair.pinion_hand) {
    refuse_key(reading, "wheel.hand", "allowed is the opposite of pinion.hand");
  }
  check_tooth_lists(reading);
  for (const InvalidInput& problem : find_problems(pair)) {
    const bool is_pitch = problem.field() == "pair.normal_module" && reading.find(problem.field()) == nullptr;
    const Position at = reading.where(is_pitch ? "pair.normal_diametral_pitch" : problem.field());
    reading.problems.push_back(
        {at.file, at.line, at.column, problem.field(), problem.value(), "allowed is " + problem.allowed()});
  }
}

void check_task(StudyReading& reading) {
  for (const Member m : members) {
    for (const ModificationDescriptor& amount : modification_parameters) {
      if (!amount.extent.empty()) check_relief(reading, m, amount, *find_parameter(amount.extent));
    }
    check_parabola(reading, m);
    check_finite_elements(reading, m);
  }
  check_variables(reading);
  if (reading.draft.study.task == Task::Optimise) check_optimise(reading);
}

}  // namespace flankwright::studies
