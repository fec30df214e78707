#include "core/effects/mesh_effects.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "core/effects/decision.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/common/random.hpp"
#include "tests/core/effects/instruction_count.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

namespace {

/// Teeth that move each other: a tooth's points are tied to their neighbours by a share of the structure's own compliance.
class CoupledSlices final : public PairCompliance {
 public:
  explicit CoupledSlices(const GearPair& pair) : slices_(ThinSlice(pair, {}, {})) {}
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override {
    const Eigen::MatrixXd own = slices_.influence(points, axial_offset);
    return own + Eigen::MatrixXd::Constant(own.rows(), own.cols(), 0.02 * own.diagonal().minCoeff());
  }
  Eigen::MatrixXd influence_on_rigid_bodies(const std::vector<ContactPoint>& points, double axial_offset) const override {
    return 0.8 * influence(points, axial_offset);
  }
  HalfSpaceCorrections half_space_corrections() const override {
    const auto alike = std::make_shared<const HalfSpaceCorrection>(50.0, 90.0, std::vector{0.0, 1.0}, std::vector{0.1, 0.4});
    return {alike, alike};
  }

 private:
  ThinSlicePair slices_;
};

/// Moves the whole mesh alike, and tilts it with the load's moment about mid face: symmetric, positive semi-definite.
class SoftShafts final : public PairCompliance {
 public:
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double) const override {
    Eigen::VectorXd z(std::ssize(points));
    for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = points[static_cast<std::size_t>(i)].z;
    return Eigen::MatrixXd::Constant(z.size(), z.size(), 1e-6) + 1e-9 * z * z.transpose();
  }
};

/// Every effect of the loaded mesh has something to do here.
struct Scene {
  GearPair pair{make_gear_pair(data())};
  CoupledSlices structure{pair};
  SoftShafts shafts{};
  FlankCondition condition{all_kinds()};

  static PairData data() {
    PairData data = pair_cases::pair_data(20, 31, 15, 5, 40);
    data.pinion.tip_rounding = data.wheel.tip_rounding = 0.25;
    return data;
  }
  static FlankCondition all_kinds() {
    FlankCondition condition;
    condition.misalignment.mesh_misalignment = 10 * units::um;
    condition.modification.wheel.lead_crowning = 5 * units::um;
    condition.modification.wheel.process.kind = GrindingKind::GeneratingGrinding;
    condition.error.pinion.cumulative_pitch = {0.0, 3 * units::um};
    return condition;
  }
  EffectFacts facts() const {
    return {.loaded = true,
            .conditions = {condition},
            .coupled_teeth = true,
            .gear_bodies = true,
            .helical = true,
            .rounded_tips = true,
            .shafts = true,
            .whole_surface = true};
  }

  LoadedCycle run(const EffectDecisions& decisions, const MeshEffects& effects) const {
    const FlankCondition left = apply_effects(decisions, condition);
    const MeshModel model = make_mesh_model(pair, {}, {{}, equally_spaced_phases(4)}, effects,
                                            MeshPlacement::of(gap_model(decisions), left.misalignment), {.structure = &structure, .shafts = &shafts});
    return analyse_cycle(model, left, 3e5);
  }
  LoadedCycle run(const EffectDecisions& decisions) const { return run(decisions, mesh_effects(decisions)); }
};

bool bit_identical(const LoadedCycle& a, const LoadedCycle& b) {
  bool same = a.positions.size() == b.positions.size();
  for (std::size_t i = 0; same && i < a.positions.size(); ++i) {
    same = a.positions[i].load.line_load.size() == b.positions[i].load.line_load.size() &&
           a.positions[i].load.line_load == b.positions[i].load.line_load &&
           a.positions[i].load.transmission_error == b.positions[i].load.transmission_error &&
           a.positions[i].contact_stress == b.positions[i].contact_stress;
  }
  return same;
}

EffectList registered_without(std::string_view name) {
  EffectList left = registered_effects();
  std::erase_if(left, [&](const Effect* effect) { return effect->name() == name; });
  return left;
}

/// Those that change a loaded mesh at all.
std::vector<std::string> mesh_changing() {
  std::vector<std::string> names;
  for (const Effect* effect : registered_effects()) {
    if (effect->stage() != EffectStage::Unloaded && effect->stage() != EffectStage::Roots) names.emplace_back(effect->name());
  }
  return names;
}

}  // namespace

TEST_CASE("Results do not depend on the order in which effects are registered", "[core][effects]") {
  const Scene scene;
  const EffectDecisions decisions = decide_effects(scene.facts());
  const LoadedCycle expected = scene.run(decisions);
  REQUIRE(expected.usable());
  EffectList shuffled = registered_effects();
  tests::Random random(7);
  for (int trial = 0; trial < 5; ++trial) {
    random.shuffle(shuffled);
    CHECK(bit_identical(scene.run(decisions, mesh_effects(decisions, shuffled)), expected));
  }
}

TEST_CASE("Switching every effect on by hand is what the automatic choice does where all are called for", "[core][effects]") {
  const Scene scene;
  CHECK(bit_identical(scene.run(decide_effects(scene.facts())), scene.run(chosen_effects(scene.facts(), listed_effect_names()))));
}

TEST_CASE("An effect that is off leaves no trace in the results and costs nothing", "[core][effects]") {
  const Scene scene;
  const LoadedCycle with_everything = scene.run(decide_effects(scene.facts()));
  for (const std::string& name : mesh_changing()) {
    CAPTURE(name);
    const EffectDecisions decisions = without(decide_effects(scene.facts()), name, "left out");
    const MeshEffects off = mesh_effects(decisions);
    const LoadedCycle left = scene.run(decisions, off);
    REQUIRE(left.usable());
    CHECK_FALSE(bit_identical(left, with_everything));  // the effect does something here
    CHECK(off.calls(name) == 0);
    // As if it had never been written: it is in no list, and what it has in the condition was never given.
    Scene never;
    for (const Effect* effect : registered_effects()) {
      if (effect->name() == name) effect->clear_from(never.condition);
    }
    const EffectDecisions others = decide_effects(never.facts(), registered_without(name));
    const MeshEffects of_others = mesh_effects(others, registered_without(name));
    const LoadedCycle unwritten = never.run(others, of_others);
    CHECK(bit_identical(left, unwritten));
    for (const Effect* effect : registered_effects()) CHECK(off.calls(effect->name()) == of_others.calls(effect->name()));
  }
}

// By core/effects/instruction_count_test.sh: [.] keeps it from running where nothing counts.
TEST_CASE("An effect that is off costs no instruction", "[.][core][effects][instructions]") {
  const Scene scene;
  const EffectDecisions all = decide_effects(scene.facts());
  InstructionCount counter;
  REQUIRE(counter.possible());
  const auto instructions = [&](const MeshEffects& effects) {
    const auto make = [&] {
      make_mesh_model(scene.pair, {}, {{}, equally_spaced_phases(4)}, effects, {}, {.structure = &scene.structure, .shafts = &scene.shafts});
    };
    make();  // warms up
    counter.start();
    make();
    const std::int64_t counted = counter.stop();
    REQUIRE(counted > 0);
    return static_cast<double>(counted);
  };
  const double everything = instructions(mesh_effects(all));
  constexpr double lists = 1e-5;  // a list of effects that is one shorter: about ten instructions of ten million
  for (const std::string name :
       {"shafts", "free_ends", "tip_corner", "edge_contact", "adjacent_teeth", "gear_body_compliance", "extended_contact_region"}) {
    CAPTURE(name);
    const double off = instructions(mesh_effects(without(all, name, "left out")));
    const double never = instructions(mesh_effects(all, registered_without(name)));
    CHECK(off == Approx(never).epsilon(lists));
    if (name != "gear_body_compliance") CHECK(off < everything);  // of the gear body either way is a look at another table
  }
}

TEST_CASE("The time of an effect is summed over all copies of a choice", "[core][effects]") {
  const Scene scene;
  const EffectDecisions decisions = decide_effects(scene.facts());
  const MeshEffects effects = mesh_effects(decisions);
  scene.run(decisions, effects);
  scene.run(decisions, effects);
  for (const char* name : {"bending", "shafts", "hertzian_contact", "free_ends", "tip_corner", "whole_surface_gap", "extended_contact_region"}) {
    CAPTURE(name);
    const bool is_of_structure = std::string_view(name) == "bending" || std::string_view(name) == "shafts";
    const auto calls = effects.calls(name);  // four positions, twice; what places points and makes laws also at the face ends of lines
    CHECK((is_of_structure ? calls == 8 : calls > 8));
    CHECK(calls % 2 == 0);
    CHECK(effects.seconds(name) > 0.0);
  }
  CHECK(effects.calls("misalignment") == 0);  // acts on the condition alone
  CHECK(effects.calls("no such effect") == 0);
}

TEST_CASE("A new effect is one class and no other code", "[core][effects]") {
  // The rim of a webbed wheel tilts on its web: a moment about mid face turns it.
  class WebbedWheelBody final : public Effect {
   public:
    std::string_view name() const override { return "webbed_wheel_body"; }
    EffectStage stage() const override { return EffectStage::Structure; }
    EffectCall called_for(const EffectFacts& facts) const override { return {facts.loaded, facts.loaded ? "a web carries the rim" : "no load"}; }
    void act(MeshBuilder& builder) const override {
      Eigen::VectorXd arm(std::ssize(builder.points));
      for (Eigen::Index i = 0; i < arm.size(); ++i) arm[i] = builder.points[static_cast<std::size_t>(i)].z;
      builder.influence += 1e-8 * arm * arm.transpose();
    }
  };
  const WebbedWheelBody webbed;
  EffectList effects = registered_effects();
  effects.push_back(&webbed);
  Scene scene;
  scene.condition = {};
  EffectFacts facts = scene.facts();
  facts.whole_surface = false;
  const EffectDecisions decisions = decide_effects(facts, effects);
  REQUIRE(is_on(decisions, "webbed_wheel_body"));
  const LoadedCycle soft = scene.run(decisions, mesh_effects(decisions, effects)), stiff = scene.run(decide_effects(facts));
  REQUIRE(soft.usable());
  for (std::size_t i = 0; i < soft.positions.size(); ++i) {
    CHECK(soft.positions[i].load.transmission_error > stiff.positions[i].load.transmission_error);
  }
  // It tilts until the load's moment is less.
  const auto moment = [](const LoadedPosition& at, const LoadedCycle& cycle, const Scene& of) {
    const MeshModel model = make_mesh_model(of.pair, {}, {{}, {at.phase}});
    double sum = 0.0;
    for (std::size_t i = 0; i < model.positions[0].points.size(); ++i) {
      const ContactPoint& point = model.positions[0].points[i];
      sum += point.z * point.weight * at.load.line_load[static_cast<Eigen::Index>(i)];
    }
    return std::abs(sum) / cycle.force;
  };
  CHECK(moment(soft.positions[1], soft, scene) < moment(stiff.positions[1], stiff, scene));
}

TEST_CASE("Effects that give nothing way are refused and unknown ones as well", "[core][effects][input]") {
  CHECK_FALSE(MeshEffects::all_but({"bending", "hertzian_contact"}).make_compliant());
  CHECK_FALSE(MeshEffects::all_but({"bending"}).has("adjacent_teeth"));
  CHECK(MeshEffects::all_but({"bending"}).has("tip_corner"));
  CHECK_THROWS_AS(MeshEffects::all_but({"wobble"}), InvalidInput);
}
