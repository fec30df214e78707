// Analyses a misaligned helical pair and optimises its flanks by the libraries core and optimize alone, without a study file.
// Lengths are in mm, angles in rad, torques in N mm.
#include <cstdio>
#include <string>

#include "core/compliance/model/gear_structures.hpp"
#include "core/fidelity/resolved_analysis.hpp"
#include "optimize/design/two_level.hpp"

int main() {
  using namespace flankwright;
  PairData data;
  data.normal_module = 3;
  data.helix_angle = 20 * units::deg;
  data.pinion.teeth = 21;
  data.wheel.teeth = 54;
  data.pinion.face_width = data.wheel.face_width = 30;
  const GearPair pair = make_gear_pair(data);
  const double torque = 150e3;

  // The default compliance: finite elements of both gears, completed by the library of fits.
  const GearStructures structures = build_compliance({.pair = pair});

  // One torque and one misalignment, as many points and positions as the figures need.
  FlankCondition misaligned;
  misaligned.misalignment.mesh_misalignment = 20 * units::um;
  const auto mesh_for = [&](const MeshResolution& resolution) {
    return make_mesh_model(pair, {}, resolution, {}, {}, {.structure = structures.pair.get()});
  };
  const ResolvedAnalysis analysis = analyse_resolved(mesh_for, misaligned, torque);
  const CycleSummary& shown = analysis.resolved.summary;
  std::printf("20 um misaligned: transmission error %.2f um peak to peak, contact stress %.0f MPa\n", shown.te_peak_to_peak / units::um,
              shown.peak_contact_stress);

  // Lead crowning and tip relief of the pinion, for the least transmission error in the worst of three misalignments, contact stress bounded.
  DesignTask task;
  task.pair = pair;
  task.structure = structures.pair;
  task.resolution = analysis.resolution;
  for (const double misalignment : {0.0, -20.0, 20.0}) {
    task.scenes.push_back({std::to_string(misalignment), 1.0, torque, {}});
    task.scenes.back().condition.misalignment.mesh_misalignment = misalignment * units::um;
  }
  task.modification.pinion.tip_relief.height = 1.5;
  task.variables = {{"lead crowning", Member::Pinion, parameter_of("lead_crowning"), 0.0, 40 * units::um},
                    {"tip relief", Member::Pinion, parameter_of("tip_relief.amount"), 0.0, 40 * units::um}};
  task.objective = {{Output::TePeakToPeak, 0, 1.0, "te_peak_to_peak"}};
  task.constraints = {{{Output::PeakContactStress, 0, 1.0, "peak_contact_stress"}, 1300.0}};
  DesignProblem problem(task);
  DesignOptions options;
  options.solver.name = "nlopt:slsqp";
  const DesignResult design = optimise_by_two_levels(problem, options).design;
  for (const DesignReport* report : {&design.before, &design.after}) {
    std::printf("%s: lead crowning %.1f um, tip relief %.1f um, transmission error up to %.2f um, contact stress up to %.0f MPa\n",
                report == &design.before ? "before" : "after", report->variables[0] / units::um, report->variables[1] / units::um, report->objective,
                report->constraint_values[0]);
  }
}
