#include "tests/core/gear/pair_cases.hpp"
#include "tests/optimize/design_tasks.hpp"

#include "tests/core/load/synthetic_root_stress.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::design_tasks {

namespace {

DesignVariable variable(const std::string& name, ModificationParameter parameter, double lower_um, double upper_um) {
  return {"pinion.modification." + name, Member::Pinion, parameter, lower_um * units::um, upper_um * units::um};
}

void add_scenes(DesignTask& task, double torque, const std::vector<double>& misalignments_um) {
  for (double misalignment : misalignments_um) {
    DesignScene scene;
    scene.name = "F = " + std::to_string(misalignment) + " um";
    scene.torque = torque * units::newton_metre;
    scene.condition.misalignment.mesh_misalignment = misalignment * units::um;
    task.scenes.push_back(scene);
  }
}

}  // namespace

DesignTask helical(const std::vector<double>& misalignments_um, int positions) {
  DesignTask task;
  task.pair = pair_cases::pair(18, 54, 30, 10.0, 120.0);
  task.material.pinion = task.material.wheel = {209000.0, 0.3};
  task.resolution = {{QuadratureRule::Gauss2, 5}, equally_spaced_phases(positions)};
  task.root_stress = std::make_shared<const mesh_cases::SyntheticRootStress>(task.pair);
  add_scenes(task, 1014.868, misalignments_um);
  task.variables = {variable("lead_crowning", parameter_of("lead_crowning"), 0.0, 40.0),
                    variable("lead_slope", parameter_of("lead_slope"), -20.0, 20.0),
                    variable("profile_crowning", parameter_of("profile_crowning"), 0.0, 30.0)};
  task.objective = {term(Output::PeakContactStress)};
  return task;
}

DesignTask spur(const std::vector<double>& misalignments_um) {
  DesignTask task;
  task.pair = pair_cases::pair(24, 36, 0, 4.0, 40.0);
  task.resolution = {{QuadratureRule::Gauss2, 8}, equally_spaced_phases(8)};
  add_scenes(task, 300.0, misalignments_um);
  task.variables = {variable("lead_crowning", parameter_of("lead_crowning"), 0.0, 40.0),
                    variable("lead_slope", parameter_of("lead_slope"), -20.0, 20.0)};
  task.objective = {term(Output::PeakContactStress)};
  return task;
}

DesignTask relieved_spur() {
  DesignTask task = spur({0.0});
  PairData data = task.pair.data;
  data.pinion.tip_rounding = data.wheel.tip_rounding = 0.2;
  task.pair = make_gear_pair(data);
  task.resolution = {{QuadratureRule::Graded, 8}, equally_spaced_phases(16)};
  task.variables.clear();
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    task.modification[m].tip_relief = {0.0, 2.0, ReliefShape::Linear};
    task.variables.push_back(
        {std::string(name_of(m)) + ".modification.tip_relief.amount", m, parameter_of("tip_relief.amount"), 0.0, 60 * units::um});
  }
  return task;
}

ObjectiveTerm term(Output output, int harmonic, double weight) {
  ObjectiveTerm term{.output = output, .harmonic = harmonic, .weight = weight, .name = {}};
  term.name = term.own_name();
  return term;
}

std::vector<ObjectiveTerm> all_outputs() {
  return {term(Output::PeakContactStress),     term(Output::TePeakToPeak), term(Output::TeHarmonic, 1), term(Output::TeHarmonic, 2),
          term(Output::TeHarmonic, 3),         term(Output::LoadFactor),   term(Output::PeakLineLoad),  term(Output::PeakRootStress),
          term(Output::EffectiveContactRatio), term(Output::EdgeLoad)};
}

Eigen::VectorXd random_design(int variables, tests::Random32& random) { return random.vector(variables, 0.05, 0.95); }

}  // namespace flankwright::design_tasks
