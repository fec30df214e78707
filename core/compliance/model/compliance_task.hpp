#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "core/compliance/model/compliance_model.hpp"
#include "core/compliance/shaft/shaft_data.hpp"

namespace flankwright {

/// The input of a pair's compliance and root stress.
struct ComplianceTask {
  GearPair pair;
  ComplianceModel model{ComplianceModel::Fitted};
  PerGear<Material> material{};
  PerGear<GearBody> body{};  ///< below the teeth
  /// Empty: rigid. A shaft tells at which end the torque leaves the gear, and its bearings hold the gear axially.
  PerGear<std::optional<ShaftData>> shaft{};
  bool root_stress{false};   ///< solved by finite elements, whatever the model
  bool rigid_bodies{false};  ///< also wanted: the same gears on rigid bodies, where the model couples teeth
  bool other_flanks{false};  ///< also wanted: the same gears on the pair's other flanks, where their bodies differ there
};

/// The task of the pair on its other flanks, which the model must solve by itself; nothing where the task does not want it, or where turned over the gears are
/// themselves: the ends of a web, and the end at which the torque leaves, change sides.
/// @throws InvalidInput  as influence_table_task()
std::optional<ComplianceTask> task_of_other_flanks(const ComplianceTask& task);

/// The run to be solved for one gear, on a coarse mesh where the model is Fitted. It has the gear's own face width,
/// body and tip, as many teeth as the pair needs (two at least, so that the loaded tooth's neighbours are supported as
/// they are), and the grid of station_grid().
/// @throws InvalidInput  "fidelity.compliance", "pair." and "pinion." or "wheel." with their field, where body and teeth cannot be meshed
InfluenceTableTask influence_table_task(const ComplianceTask& task, Member member);

/// The parameters of a gear outside the library of fits, CorrectionLibrary::unknown(), where the model is Fitted: the
/// gear then needs its own fit. Empty otherwise.
std::string unknown_to_library(const ComplianceTask& task, const InfluenceTableTask& gear);

/// The cost of a gear outside the library and the reason, one line for each such gear.
/// @throws InvalidInput  as influence_table_task()
std::vector<std::string> library_notes(const ComplianceTask& task);

/// A line for each gear that is taken as one with a shaft of less than a quarter of its reference diameter because no diameter was given: the default is at most
/// 25 modules, and the disc around a thin shaft then has a large part in the deflection of the mesh.
/// @throws InvalidInput  as influence_table_task()
std::vector<std::string> thin_shaft_notes(const ComplianceTask& task);

/// The task of a gear's own fit: the coarse task, with a face of at most widest_own_fit and, of a gear on a web or with a bore that is held, a
/// solid body on its shaft.
InfluenceTableTask task_of_fit(InfluenceTableTask coarse);

/// Runs `work` on one gear; errors name the gear's own keys.
template <typename Work>
auto with_gear_names(ComplianceModel model, Member member, Work&& work) {
  try {
    return work();
  } catch (const InvalidInput& problem) {
    const std::string gear = name_of(member);
    if (problem.field().starts_with("options")) {
      throw InvalidInput("fidelity.compliance", to_string(model), "another compliance: the " + gear + " cannot be meshed (" + problem.value() + ")");
    }
    const bool of_pair = problem.field() == "helix_angle" || problem.field() == "pressure_angle";
    const std::string table = of_pair ? "pair." : problem.field() == "poissons_ratio" ? gear + ".material." : gear + ".";
    throw InvalidInput(table + problem.field(), problem.value(), problem.allowed());
  }
}

}  // namespace flankwright
