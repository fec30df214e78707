#include "core/compliance/model/gear_structures.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "core/gear/gear_pair.hpp"
#include "tests/core/gear/pair_cases.hpp"

using namespace flankwright;

namespace {

/// Two equal narrow spur gears: one small finite-element run.
ComplianceTask twins(ComplianceModel model) {
  PairData data = pair_cases::pair_data(12, 12, 0, 4, 4);
  data.pinion.profile_shift = data.wheel.profile_shift = 0.3;
  return {.pair = make_gear_pair(data), .model = model};
}

/// Keeps runs in memory.
class MemoryStore final : public ComplianceStore {
 public:
  std::optional<Kept<InfluenceTableRun>> find(const InfluenceTableTask& task) override {
    for (const auto& [known, run] : runs) {
      if (alike_but_for_size(known, task)) return Kept<InfluenceTableRun>{run, "memory"};
    }
    return std::nullopt;
  }
  std::string keep(const InfluenceTableTask& task, const InfluenceTableRun& run) override {
    runs.emplace_back(task, run);
    return "memory";
  }
  std::optional<Kept<CorrectionEntry>> find_fit(const InfluenceTableTask&, const std::vector<double>&) override { return std::nullopt; }
  std::string keep_fit(const InfluenceTableTask&, const std::vector<double>&, const CorrectionEntry&) override { return ""; }

  std::vector<std::pair<InfluenceTableTask, InfluenceTableRun>> runs;
};

double deflection(const GearStructures& built, Member member) {
  const auto& structure = dynamic_cast<const StructuralPair&>(*built.pair);
  const std::vector<FlankStation> station{{0, 0.5, 0.4}};
  return structure[member].compliance->evaluate(station)(0, 0);
}

}  // namespace

TEST_CASE("A wheel on a shaft that is thin by default is named, one whose shaft is given is not", "[compliance]") {
  ComplianceTask task{.pair = make_gear_pair(pair_cases::pair_data(20, 120, 0, 20, 20)), .model = ComplianceModel::Fitted};
  const std::vector<std::string> notes = thin_shaft_notes(task);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes.front(), Catch::StartsWith("the wheel ") && Catch::Contains("wheel.body.shaft_diameter"));
  task.body.wheel.shaft_diameter = 0.2 * task.pair.wheel.tip_radius;
  CHECK(thin_shaft_notes(task).empty());
  task.body.wheel.shaft_diameter = GearBody{}.shaft_diameter;
  task.model = ComplianceModel::ThinSlice;
  CHECK(thin_shaft_notes(task).empty());
}

TEST_CASE("A pair's compliance is built without a store, and the same with one", "[compliance][fe]") {
  const ComplianceTask task = twins(ComplianceModel::Fe);
  const GearStructures alone = build_compliance(task);
  REQUIRE(alone.finite_elements);
  CHECK(!alone.root_stress);
  CHECK((*alone.finite_elements)[Member::Pinion].table == (*alone.finite_elements)[Member::Wheel].table);  // equal gears are solved once
  CHECK((*alone.finite_elements)[Member::Pinion].file.empty());

  MemoryStore store;
  std::vector<std::string> told;
  ComplianceBuild build{.store = &store};
  build.progress = [&](const std::string& label, int, int, const std::string&) { told.push_back(label); };
  const GearStructures made = build_compliance(task, build);
  CHECK(store.runs.size() == 1);
  REQUIRE(!told.empty());
  CHECK(told.front() == "solving both gears' finite elements");
  told.clear();
  const GearStructures found = build_compliance(task, build);
  CHECK(told.empty());
  CHECK((*found.finite_elements)[Member::Wheel].from_cache);
  CHECK((*found.finite_elements)[Member::Wheel].file == "memory");
  for (const GearStructures* built : {&made, &found}) CHECK(deflection(*built, Member::Wheel) == deflection(alone, Member::Wheel));
}

TEST_CASE("On the other flanks a gear whose ends differ is solved as it stands there", "[compliance][fe][other-flank]") {
  // A helical pair whose pinion's torque leaves at one end, on a shaft: the other flanks' acute end is the other one.
  PairData data = pair_cases::pair_data(12, 12, 20, 4, 6);
  data.pinion.profile_shift = data.wheel.profile_shift = 0.3;
  ShaftData shaft;
  shaft.sections = {{40, 12}};
  shaft.bearings = {{.position = 2, .axial_stiffness = std::numeric_limits<double>::infinity()}, {.position = 38}};
  shaft.gear_position = 20;
  shaft.torque_position = 0;
  ComplianceTask task{.pair = make_gear_pair(data), .model = ComplianceModel::Fe, .root_stress = true, .other_flanks = true};
  CHECK_FALSE(task_of_other_flanks(task));  // solid, and held alike at both ends
  task.shaft.pinion = shaft;
  REQUIRE(task_of_other_flanks(task));
  const GearStructures both = build_compliance(task);
  REQUIRE(both.other_flanks);
  data.working_flank = WorkingFlank::Left;
  const GearStructures alone =
      build_compliance({.pair = make_gear_pair(data), .model = ComplianceModel::Fe, .shaft = task.shaft, .root_stress = true});
  const GearPair left = make_gear_pair(data);
  const std::vector<ContactPoint> points = contact_points(left, PathOfContact(left), {QuadratureRule::Gauss2, 3}, 0.7, false, -3, 3);
  const Eigen::MatrixXd there = both.pair->on_other_flanks()->influence(points, 0.0), here = alone.pair->influence(points, 0.0);
  CHECK((there - here).cwiseAbs().maxCoeff() <= 1e-12 * here.cwiseAbs().maxCoeff());  // round-off
  const auto stress = [&](const PairRootStress& model) { return model.influence(points, 0.0).components_of(0).rowwise().sum().norm(); };
  CHECK(stress(*both.root_stress->on_other_flanks()) == Approx(stress(*alone.root_stress)).epsilon(1e-12));
  // Turned over without it the torque would leave at the other end.
  const Eigen::MatrixXd turned = StructuralPair(task.pair, dynamic_cast<const StructuralPair&>(*both.pair)[Member::Pinion],
                                                dynamic_cast<const StructuralPair&>(*both.pair)[Member::Wheel])
                                     .on_other_flanks()
                                     ->influence(points, 0.0);
  CHECK((turned - here).cwiseAbs().maxCoeff() > 1e-4 * here.cwiseAbs().maxCoeff());
}

TEST_CASE("Data that no compliance can be built from are refused under the names of the gears", "[compliance][fe]") {
  CHECK(!build_compliance(twins(ComplianceModel::ThinSlice)).finite_elements);
  const auto refused = [](const ComplianceTask& task, const ComplianceBuild& build = {}) {
    try {
      build_compliance(task, build);
    } catch (const InvalidInput& problem) {
      return problem.field() + ": " + problem.allowed();
    }
    return std::string();
  };
  ComplianceTask task = twins(ComplianceModel::Fe);
  task.body.wheel.shaft_diameter = 60;  // more than the root circle
  CHECK_THAT(refused(task), Catch::Contains("wheel.") && Catch::Contains("shaft_diameter"));
  const std::string memory = refused(twins(ComplianceModel::Fe), {.memory_limit = 1e6});
  CHECK_THAT(memory, Catch::Contains("fidelity.compliance: another compliance: the pinion's finite elements cannot be solved") &&
                         Catch::Contains("unknowns"));
}
