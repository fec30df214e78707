#include "studies/study_file/study_checks.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "core/flank/conjugate_field.hpp"
#include "core/flank/contact_shift.hpp"
#include "core/gear/flank_tolerances.hpp"
#include "core/gear/gear_pair.hpp"
#include "core/gear/tooth_form.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/study_file/scene_placement.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array members{Member::Pinion, Member::Wheel};

/// True for the tables that PairData is made of.
bool is_geometry(const std::string& path) {
  const std::string table = path.substr(0, path.find('.'));
  if (table == "pair") return true;
  const std::string rest = path.substr(std::min(path.size(), table.size() + 1));
  const bool is_micro = rest.starts_with("modification") || rest.starts_with("error") || rest.starts_with("material") || rest.starts_with("body") ||
                        rest.starts_with("shaft");
  return (table == "pinion" || table == "wheel") && !is_micro;
}

void check_tooth_list(StudyReading& reading, const std::string& path, const std::vector<double>& deviations, int teeth) {
  if (!reading.positions.contains(path) || deviations.empty() || static_cast<int>(deviations.size()) == teeth) return;
  reading.refuse_value(path, "a list of " + std::to_string(deviations.size()),
                       "allowed is one number, or a list of " + std::to_string(teeth) + ", one for each tooth");
}

void check_tooth_lists(StudyReading& reading, const std::string& prefix, const ManufacturingError& error, int teeth) {
  check_tooth_list(reading, prefix + "pitch", error.cumulative_pitch, teeth);
  check_tooth_list(reading, prefix + "helix_slope", error.helix_slopes, teeth);
  check_tooth_list(reading, prefix + "profile_slope", error.profile_slopes, teeth);
  check_tooth_list(reading, prefix + "twist", error.twists, teeth);
}

void check_tooth_lists(StudyReading& reading) {
  const StudyBuilder& builder = reading.builder;
  for (const Member m : members) {
    const auto error_of = [m](const Scene& scene) -> const ManufacturingError& { return scene.error[m]; };
    const std::string prefix = std::string(name_of(m)) + ".error.";
    const int teeth = builder.study.pair[m].teeth;
    check_tooth_lists(reading, prefix, error_of(builder.base), teeth);
    if (reading.find("scenes") == nullptr) continue;
    for (std::size_t i = 0; i < builder.study.scenes.size(); ++i) {
      check_tooth_lists(reading, "scenes." + std::to_string(i) + "." + prefix, error_of(builder.study.scenes[i]), teeth);
    }
  }
}

std::optional<DesignVariable> find_variable(const Study& study, Member m, ModificationParameter parameter) {
  for (const DesignVariable& v : varied_by_tasks(study)) {
    if (v.member == m && v.parameter == parameter) return v;
  }
  return std::nullopt;
}

bool asks_derivative(const Study& study, Member m, ModificationParameter parameter) {
  return std::ranges::any_of(study.gradients, [&](const GradientParameter& p) {
    const auto* gear = std::get_if<GearParameter>(&p.parameter);
    return gear != nullptr && gear->member == m && gear->parameter == parameter;
  });
}

/// A relief with an amount needs an extent above 0; an extent to be varied needs an amount.
void check_relief(StudyReading& reading, Member m, const ModificationDescriptor& of_amount, const ModificationDescriptor& of_extent) {
  const Study& study = reading.builder.study;
  const Modification& modification = study.modification[m];
  const std::string prefix = std::string(name_of(m)) + ".modification.";
  const std::string amount_path = prefix + std::string(of_amount.key), path = prefix + std::string(of_extent.key);
  const std::optional<DesignVariable> amount = find_variable(study, m, of_amount.parameter);
  const std::optional<DesignVariable> extent = find_variable(study, m, of_extent.parameter);
  const bool has_amount = amount.has_value() || of_amount.get(modification) != 0.0;
  if (extent.has_value() && !has_amount) {
    return reading.refuse_key("optimise.variables." + path, "has no effect while " + amount_path + " is 0: give it a value or make it a variable");
  }
  const bool has_derivative = asks_derivative(study, m, of_amount.parameter);
  if (!has_amount && !has_derivative) return;
  if (of_amount.needs_helix && study.pair.helix_angle == 0.0) {
    const std::string asked_by = amount.has_value() ? "optimise.variables." + amount_path : has_amount ? amount_path : "analyse.gradients";
    return reading.refuse_key(asked_by, "allowed is a helical pair: the lines of contact of a spur pair cut off no corner");
  }
  if (extent.has_value() && extent->lower <= 0.0) {
    return reading.refuse_key("optimise.variables." + path, "allowed is a lower bound above 0 mm: the relief is spread over it");
  }
  if (extent.has_value() || of_extent.get(modification) > 0.0) return;
  const std::string asked_by = has_amount ? (amount.has_value() ? "optimise.variables." : "") + amount_path : "analyse.gradients";
  const bool is_given = reading.find(path) != nullptr;
  const Position at = reading.where(is_given ? path : asked_by);
  reading.refuse(at, path, is_given ? reading.find(path)->node : nullptr, "set " + path + " above 0 mm: the relief's amount is spread over it");
}

/// The class of a drawing is that of gears which ISO 1328-1 covers.
void check_drawing(StudyReading& reading, Member m) {
  const Study& study = reading.builder.study;
  if (!study.drawing_class || !find_problems(study.pair).empty()) return;
  try {
    flank_tolerances(ToleranceData::of(make_gear_pair(study.pair), m), *study.drawing_class);
  } catch (const InvalidInput& problem) {
    reading.refuse_key("drawing.iso_1328_class", "a gear that ISO 1328-1 covers: " + problem.field() + " of the " + name_of(m) + " is " +
                                                     problem.value() + ", covered is " + problem.allowed());
  }
}

/// A predesigned parabola, given or at the upper end of a variable, must have a flank.
void check_parabola(StudyReading& reading, Member m) {
  const Study& study = reading.builder.study;
  if (!reading.problems.empty()) return;  // the pair may not exist
  const std::string path = std::string(name_of(m)) + ".modification.parabolic_te";
  const auto check = [&](const std::string& key, double coefficient) {
    if (coefficient == 0.0) return;
    try {
      make_conjugate_field(make_gear_pair(study.pair), m, coefficient);
    } catch (const InvalidInput& problem) {
      reading.refuse_key(key, "allowed is " + problem.allowed());
    }
  };
  check(path, study.modification[m].parabolic_te);
  if (const auto variable = find_variable(study, m, parameter_of("parabolic_te"))) {
    check("optimise.variables." + path, variable->upper);
  }
}

/// A form wheel must touch the flank in one line.
void check_process(StudyReading& reading, Member m) {
  const Study& study = reading.builder.study;
  if (!reading.problems.empty()) return;  // the pair may not exist
  try {
    ContactShift::of(make_gear_pair(study.pair), m, study.modification[m].process);
  } catch (const InvalidInput& problem) {
    reading.refuse_key(std::string(name_of(m)) + "." + problem.field(), "allowed is " + problem.allowed());
  }
}

/// What the finite elements of a gear refuse, before anything is solved.
void check_finite_elements(StudyReading& reading, Member m) {
  const Study& study = reading.builder.study;
  if (!reading.problems.empty() || !solves_finite_elements(study)) return;
  try {
    influence_table_task(compliance_task(study, make_gear_pair(study.pair)), m);
  } catch (const InvalidInput& problem) {
    reading.refuse_key(problem.field(), "allowed is " + problem.allowed());
  }
}

}  // namespace

void check_presence(StudyReading& reading) {
  for (const ExclusiveKeys& keys : exclusive_keys()) {
    if (reading.find(keys.first) == nullptr || reading.find(keys.second) == nullptr) continue;
    reading.refuse_key(keys.second, "allowed is this or " + keys.first + ", not both");
  }
  for (const SchemaKey& key : study_schema()) {
    const bool in_list = key.path.find("[].") != std::string::npos;  // checked where the list is read
    if (in_list || !is_required(key) || reading.find(key.path) != nullptr) continue;
    const bool is_replaced = std::ranges::any_of(
        exclusive_keys(), [&](const ExclusiveKeys& keys) { return keys.first == key.path && reading.find(keys.second) != nullptr; });
    if (!is_replaced) reading.refuse_key(key.path, "required: allowed is " + allowed_values(key));
  }
}

namespace {

/// Tools of a large pressure angle or dedendum are too narrow for the rounding that a rack has where none is given.
void settle_root_radius(StudyReading& reading) {
  PairData& pair = reading.builder.study.pair;
  for (const Member m : members) {
    if (reading.find(std::string(name_of(m)) + ".rack.root_radius") != nullptr) continue;
    RackProfile& rack = pair[m].rack;
    const double largest = full_tip_rounding(rack.dedendum, pair.pressure_angle);
    if (largest > 0.0) rack.root_radius = std::min(rack.root_radius, largest);
  }
}

}  // namespace

void check_pair(StudyReading& reading) {
  const bool has_problem =
      std::ranges::any_of(reading.problems, [](const StudyProblem& problem) { return problem.key.empty() || is_geometry(problem.key); });
  if (has_problem) return;
  settle_root_radius(reading);
  const PairData& pair = reading.builder.study.pair;
  if (reading.find("wheel.hand") != nullptr && reading.builder.wheel_hand == pair.pinion_hand) {
    reading.refuse_key("wheel.hand", "allowed is the opposite of pinion.hand");
  }
  check_tooth_lists(reading);
  for (const InvalidInput& problem : find_problems(pair)) {
    const bool is_pitch = problem.field() == "pair.normal_module" && reading.find(problem.field()) == nullptr;
    const Position at = reading.where(is_pitch ? "pair.normal_diametral_pitch" : problem.field());
    reading.problems.push_back({at.file, at.line, at.column, problem.field(), problem.value(), "allowed is " + problem.allowed()});
  }
}

namespace {

/// What belongs to one flank, or is known for the pair's own flanks alone.
std::optional<std::string> bound_to_own_flanks(const StudyReading& reading) {
  const Study& study = reading.builder.study;
  for (std::size_t i = 0; i < study.unit.loads.size(); ++i) {
    if (study.unit.loads[i].keeps_direction()) continue;
    return "unit.loads." + std::to_string(i) + ", a force in proportion to the torque, which would turn round with it (constant = \"yes\" keeps it)";
  }
  for (const Member m : members) {
    const std::string name = name_of(m);
    const std::string grid = name + ".modification.grid", opposite = grid + "_of_opposite_flank", of_teeth = name + ".error.grids";
    if (reading.find(grid) != nullptr && reading.find(opposite) == nullptr)
      return grid + ", measured on one flank (" + opposite + " has the other one)";
    if (reading.find(of_teeth) != nullptr) return of_teeth + ", measured on one flank";
  }
  return std::nullopt;
}

void check_other_flanks(StudyReading& reading) {
  const Study& study = reading.builder.study;
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    if (!loads_other_flanks(study, study.scenes[i])) continue;
    const std::optional<std::string> bound = bound_to_own_flanks(reading);
    if (!bound) return;
    const std::string path = "scenes." + std::to_string(i) + ".working_flank", own = name_of(study.pair.working_flank);
    reading.refuse_value(path, std::string("\"") + name_of(opposite(study.pair.working_flank)) + "\"",
                         "allowed is pair.working_flank, \"" + own + "\", with " + *bound + ": analyse the other flank in a study of its own");
  }
}

void check_scene_placements(StudyReading& reading) {
  if (!reading.problems.empty()) return;
  const Study& study = reading.builder.study;
  const GearPair pair = make_gear_pair(study.pair);
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    for (const PlacementProblem& problem : placement_problems(pair, study.scenes[i].misalignment)) {
      // A value that the study does not give itself is the median of what it sweeps.
      const std::array places{"scenes." + std::to_string(i) + "." + problem.key, problem.key, "sweep.parameters." + problem.key};
      const auto given = std::ranges::find_if(places, [&](const std::string& place) { return reading.positions.contains(place); });
      reading.refuse_value(given != places.end() ? *given : problem.key, in_words(problem.value), "allowed is " + problem.allowed);
    }
  }
}

}  // namespace

void check_flanks(StudyReading& reading) {
  for (const Member m : members) {
    for (const ModificationDescriptor& amount : modification_parameters) {
      if (!amount.extent.empty()) check_relief(reading, m, amount, *find_parameter(amount.extent));
    }
    check_parabola(reading, m);
    check_drawing(reading, m);
    check_process(reading, m);
    check_finite_elements(reading, m);
  }
  check_other_flanks(reading);
  check_scene_placements(reading);
}

}  // namespace flankwright::studies
