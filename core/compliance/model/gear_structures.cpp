#include "core/compliance/model/gear_structures.hpp"

#include "core/compliance/finite_element/solve_half_space_correction.hpp"

namespace flankwright {

namespace {

/// What the gears' teeth do in their sections.
class Sections {
 public:
  Sections(const ComplianceTask& task, const FiniteElementRuns& runs, const ComplianceBuild& build) : task_(task) {
    const auto solve = [&](std::size_t i) {
      const Member member = i == 0 ? Member::Pinion : Member::Wheel;
      fine_[member] = solved(member, fine_section());
      if (runs.root_stress_run(member).root_stress) as_table_[member] = solved(member, runs.root_stress_run(member).mesh);
    };
    run_for_each(build.for_each, 2, solve);
  }

  std::shared_ptr<const HalfSpaceCorrection> half_space(Member member) const {
    return std::make_shared<const HalfSpaceCorrection>(half_space_correction(*fine_[member], task_.pair[member]));
  }
  GearRootStress root_stress(Member member, const RootStressTable& table) const {
    auto correction = std::make_shared<const RootStressCorrection>(*fine_[member], *as_table_[member], task_.pair[member], task_.pair, table.fillet);
    return {std::make_shared<const RootStressTable>(correction->scaled(table)), correction};
  }

 private:
  std::shared_ptr<const LoadedSection> solved(Member member, const GearMeshOptions& mesh) const {
    return std::make_shared<const LoadedSection>(task_.pair[member], task_.pair, task_.material[member].poissons_ratio, mesh,
                                                 influence_table_task(task_, member).gear.body);
  }

  const ComplianceTask& task_;
  PerGear<std::shared_ptr<const LoadedSection>> fine_, as_table_;
};

}  // namespace

GearStructures build_compliance(const ComplianceTask& task, const ComplianceBuild& build) {
  GearStructures structures;
  const bool is_structural = couples_teeth(task.model);
  if (!is_structural && !task.root_stress) return structures;
  structures.finite_elements = solve_finite_elements(task, build);
  structures.notes = library_notes(task);
  const std::vector<std::string> of_bodies = thin_shaft_notes(task);
  structures.notes.insert(structures.notes.end(), of_bodies.begin(), of_bodies.end());
  if (const std::optional<ComplianceTask> there = task_of_other_flanks(task)) {
    structures.other_flanks = std::make_shared<const GearStructures>(build_compliance(*there, build));
  }
  const GearStructures known_there = structures.other_flanks ? *structures.other_flanks : GearStructures{};
  const FiniteElementRuns& runs = *structures.finite_elements;
  const Sections sections(task, runs, build);
  if (is_structural) {
    const auto structure = [&](Member member, const Material& material) {
      GearStructure result{.compliance = runs[member].table, .youngs_modulus = material.youngs_modulus, .half_space = sections.half_space(member)};
      if (const auto& rigid = runs.rigid_body[member]) result.on_rigid_body = rigid->table;
      if (task.model == ComplianceModel::Fitted) {
        auto& correction = structures.corrections[member];
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
    structures.pair = std::make_shared<const StructuralPair>(task.pair, pinion, wheel, known_there.pair);
    if (runs[Member::Pinion].rim_motion || runs[Member::Wheel].rim_motion) {
      structures.rim_motion = std::make_shared<const PairRimMotion>(
          task.pair, PerGear<PairRimMotion::Rim>{{runs[Member::Pinion].rim_motion, task.material.pinion.youngs_modulus},
                                                 {runs[Member::Wheel].rim_motion, task.material.wheel.youngs_modulus}});
    }
  }
  if (const auto& pinion = runs.root_stress_run(Member::Pinion).root_stress) {
    structures.root_stress = std::make_shared<const TabulatedRootStress>(
        task.pair, sections.root_stress(Member::Pinion, *pinion),
        sections.root_stress(Member::Wheel, *runs.root_stress_run(Member::Wheel).root_stress), known_there.root_stress);
  }
  return structures;
}

}  // namespace flankwright
