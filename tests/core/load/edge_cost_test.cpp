#include <catch2/catch.hpp>

#include "core/compliance/thin_slice/thin_slice.hpp"
#include "core/load/cycle/cycle_gradient.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/core/effects/instruction_count.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

/// The main study's pair, with roundings of both tips [mm].
GearPair main_pair(double rounding) {
  PairData data = mesh_cases::pair_data(18, 54, 30, 10, 120);
  data.pinion.tip_rounding = data.wheel.tip_rounding = rounding;
  return make_gear_pair(data);
}

/// Its mesh as a search has it, see studies/README.md. Only the cycle is counted, not the structure that it needs.
MeshModel main_mesh(double rounding, const MeshEffects& effects) {
  return mesh_cases::model(main_pair(rounding), {{QuadratureRule::Graded, 6}, equally_spaced_phases(32)}, effects);
}

FlankCondition main_condition(double relief) {
  FlankCondition condition;
  Modification& pinion = condition.modification.pinion;
  pinion.lead_crowning = 6 * units::um;
  pinion.lead_slope = 1 * units::um;
  set(pinion, parameter_of("profile_crowning"), 4 * units::um);
  pinion.tip_relief = {relief, 4.0, ReliefShape::Linear};
  condition.modification.wheel.tip_relief = {relief, 4.0, ReliefShape::Linear};
  condition.misalignment.mesh_misalignment = 16 * units::um;
  return condition;
}

}  // namespace

// By core/effects/instruction_count_test.sh: [.] keeps it from running where nothing counts.
TEST_CASE("Edges cost a cycle with its gradients little where they carry, and next to nothing where they do not", "[.][instructions]") {
  InstructionCount counter;
  REQUIRE(counter.possible());
  const std::vector<MeshParameter> parameters{
      GearParameter{Member::Pinion, parameter_of("lead_crowning")}, GearParameter{Member::Pinion, parameter_of("lead_slope")},
      GearParameter{Member::Pinion, parameter_of("tip_relief.amount")}, GearParameter{Member::Pinion, parameter_of("profile_crowning")}};
  constexpr double torque = 1014.868 * units::newton_metre;
  struct Cost {
    double instructions, on_edges;
  };
  const auto cost = [&](double rounding, double relief, const MeshEffects& effects = {}) {
    const MeshModel model = main_mesh(rounding, effects);
    const FlankCondition condition = main_condition(relief);
    const auto run = [&] {
      const LoadedCycle cycle = analyse_cycle(model, condition, torque, parameters);
      const CycleSummary summary = summarise(model, cycle);
      summary_gradient(model, cycle, summary);
      return summary.tip_edge_share;
    };
    run();  // warms up
    counter.start();
    const double share = run();
    return Cost{static_cast<double>(counter.stop()), share};
  };
  for (const double relief : {0.0, 30 * units::um}) {
    const Cost without = cost(0.5, relief, MeshEffects::all_but({"edge_contact"})), rounded = cost(0.5, relief), sharp = cost(0.0, relief);
    CAPTURE(relief, without.instructions, rounded.instructions / without.instructions, sharp.instructions / without.instructions, rounded.on_edges);
    CHECK((rounded.on_edges > 0.0) == (relief == 0.0));
    // Rounded 1.271 and 1.020 measured, sharp 1.076 and 1.005.
    CHECK(rounded.instructions <= (relief == 0.0 ? 1.40 : 1.07) * without.instructions);
    CHECK(sharp.instructions <= (relief == 0.0 ? 1.40 : 1.07) * without.instructions);
  }
}
