#include "core/compliance/model/gear_structures.hpp"

#include "core/compliance/finite_element/solve_half_space_correction.hpp"

namespace flankwright {

namespace {

HalfSpaceCorrections half_space_corrections(const ComplianceTask& task, const ComplianceBuild& build) {
  HalfSpaceCorrections corrections;
  const auto solve = [&](Member member) {
    corrections[member] =
        std::make_shared<const HalfSpaceCorrection>(solve_half_space_correction(task.pair[member], task.pair, task.material[member].poissons_ratio));
  };
  const auto solve_gear = [&](std::size_t i) { solve(i == 0 ? Member::Pinion : Member::Wheel); };
  run_for_each(build.for_each, 2, solve_gear);
  return corrections;
}

}  // namespace

GearStructures build_compliance(const ComplianceTask& task, const ComplianceBuild& build) {
  GearStructures structures;
  const bool is_structural = couples_teeth(task.model);
  if (!is_structural && !task.root_stress) return structures;
  structures.finite_elements = solve_finite_elements(task, build);
  structures.notes = library_notes(task);
  const FiniteElementRuns& runs = *structures.finite_elements;
  if (is_structural) {
    const HalfSpaceCorrections half_space = half_space_corrections(task, build);
    const auto structure = [&](Member member, const Material& material) {
      GearStructure result{.compliance = runs[member].table, .youngs_modulus = material.youngs_modulus, .half_space = half_space[member]};
      if (const auto& rigid = runs.rigid_body_run(member)) result.on_rigid_body = rigid->table;
      if (task.model == ComplianceModel::Fitted) {
        auto& correction = structures.refinements[member == Member::Pinion ? 0 : 1];
        correction = gear_correction(task, runs, member, build);
        if (!correction->unknown.empty() && correction->fit.status != FitStatus::Converged) {
          structures.notes.push_back(std::string("the ") + name_of(member) + "'s fit stopped after " + std::to_string(correction->fit.iterations) +
                                     " steps, before it converged");
        }
        result.compliance = correction->compliance;
        if (result.on_rigid_body) result.on_rigid_body = correction->completed(result.on_rigid_body);
      }
      return result;
    };
    const GearStructure pinion = structure(Member::Pinion, task.material.pinion);
    const GearStructure wheel = structure(Member::Wheel, task.material.wheel);
    structures.pair = std::make_shared<const StructuralPair>(task.pair, pinion, wheel);
    if (runs[Member::Pinion].rim_motion || runs[Member::Wheel].rim_motion) {
      structures.rim_motion = std::make_shared<const PairRimMotion>(
          task.pair, PerGear<PairRimMotion::Rim>{{runs[Member::Pinion].rim_motion, task.material.pinion.youngs_modulus},
                                                 {runs[Member::Wheel].rim_motion, task.material.wheel.youngs_modulus}});
    }
  }
  if (const auto& pinion = runs.root_stress(Member::Pinion)) {
    structures.root_stress = std::make_shared<const TabulatedRootStress>(task.pair, pinion, runs.root_stress(Member::Wheel));
  }
  return structures;
}

}  // namespace flankwright
