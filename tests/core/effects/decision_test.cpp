#include "core/effects/decision.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "core/base/error.hpp"
#include "tests/common/random.hpp"

using namespace flankwright;

namespace {

FlankCondition misaligned() {
  FlankCondition condition;
  condition.misalignment.mesh_misalignment = 10 * units::um;
  return condition;
}

FlankCondition modified() {
  FlankCondition condition;
  condition.modification.wheel.lead_crowning = 5 * units::um;
  return condition;
}

FlankCondition with_errors() {
  FlankCondition condition;
  condition.error.pinion.cumulative_pitch = {0.0, 3 * units::um};
  return condition;
}

}  // namespace

TEST_CASE("Every effect has a unique name and a reason for being on or off", "[core][effects]") {
  std::vector<std::string_view> names;
  for (const Effect* effect : registered_effects()) names.push_back(effect->name());
  CHECK(std::set<std::string_view>(names.begin(), names.end()).size() == names.size());
  for (const EffectFacts& facts : {EffectFacts{}, EffectFacts{true, true, {misaligned(), modified(), with_errors()}, true, true, true, true}}) {
    const EffectDecisions effects = decide_effects(facts);
    REQUIRE(effects.size() == names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      CHECK(effects[i].name == names[i]);
      CHECK_FALSE(effects[i].why.empty());
      CHECK(std::isnan(effects[i].seconds));
    }
  }
}

TEST_CASE("An aligned, unmodified pair without load calls for tooth contact analysis alone", "[core][effects]") {
  const auto effects = decide_effects({false, true, {FlankCondition{}}});
  for (const EffectDecision& effect : effects) CHECK(effect.on == (effect.name == "unloaded_contact"));
}

TEST_CASE("One scene that calls for an effect is enough", "[core][effects]") {
  const auto on = [](const FlankCondition& condition, std::string_view name) {
    return is_on(decide_effects({true, false, {FlankCondition{}, condition, FlankCondition{}}}), name);
  };
  CHECK(on(misaligned(), "misalignment"));
  CHECK_FALSE(on(misaligned(), "modifications"));
  CHECK_FALSE(on(misaligned(), "manufacturing_errors"));
  CHECK(on(modified(), "modifications"));
  CHECK_FALSE(on(modified(), "misalignment"));
  CHECK(on(with_errors(), "manufacturing_errors"));
  CHECK_FALSE(on(with_errors(), "modifications"));
  CHECK(on({}, "bending"));
  CHECK_FALSE(on({}, "unloaded_contact"));
}

TEST_CASE("Every modification, error and misalignment is noticed", "[core][effects]") {
  for (const ModificationDescriptor& p : modification_parameters) {
    if (p.kind == ParameterKind::Extent) continue;  // without an amount it removes nothing
    FlankCondition condition;
    set(condition.modification.pinion, p.parameter, 1 * units::um);
    CAPTURE(std::string(p.key));
    CHECK(is_on(decide_effects({true, false, {condition}}), "modifications"));
  }
  for (double ManufacturingError::*error :
       {&ManufacturingError::helix_slope, &ManufacturingError::profile_slope, &ManufacturingError::twist, &ManufacturingError::pitch_step}) {
    FlankCondition condition;
    condition.error.wheel.*error = -1 * units::um;
    CHECK(is_on(decide_effects({true, false, {condition}}), "manufacturing_errors"));
  }
  for (double Misalignment::*part :
       {&Misalignment::crossing, &Misalignment::intersecting, &Misalignment::centre_distance, &Misalignment::axial_offset,
        &Misalignment::pinion_lead_angle, &Misalignment::pinion_pressure_angle, &Misalignment::mesh_misalignment}) {
    FlankCondition condition;
    condition.misalignment.*part = -1e-4;
    CHECK(is_on(decide_effects({true, false, {condition}}), "misalignment"));
  }
}

TEST_CASE("Grinding is an effect where it twists the lead of a helical gear", "[core][effects][grinding]") {
  const auto call = [](bool helical, GrindingKind kind, double compensation, const FlankCondition& of) {
    FlankCondition condition = of;
    condition.modification.wheel.process = {kind, compensation};
    return is_on(decide_effects({.loaded = true, .conditions = {FlankCondition{}, condition}, .helical = helical}), "natural_twist");
  };
  for (const GrindingKind kind : {GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding}) {
    CHECK(call(true, kind, 0.0, modified()));
    CHECK(call(true, kind, 0.9, modified()));
    CHECK_FALSE(call(true, kind, 1.0, modified()));
    CHECK_FALSE(call(false, kind, 0.0, modified()));
    CHECK_FALSE(call(true, kind, 0.0, misaligned()));
  }
  CHECK_FALSE(call(true, GrindingKind::None, 0.0, modified()));
  CHECK_FALSE(call(true, GrindingKind::Topological, 0.0, modified()));
  // Off, the modification stays as drawn.
  FlankCondition ground = modified();
  ground.modification.wheel.process.kind = GrindingKind::FormGrinding;
  const EffectFacts facts{.loaded = true, .conditions = {ground}, .helical = true};
  CHECK(apply_effects(decide_effects(facts), ground) == ground);
  CHECK(apply_effects(without(decide_effects(facts), "natural_twist", "left out"), ground) == modified());
  CHECK(apply_effects(without(decide_effects(facts), "modifications", "left out"), ground) == FlankCondition{});
}

TEST_CASE("Effects chosen by hand are exactly those named", "[core][effects]") {
  const EffectFacts facts{true, false, {misaligned()}};
  const auto effects = chosen_effects(facts, {"bending", "modifications"});
  for (const EffectDecision& effect : effects) {
    CHECK(effect.on == (effect.name == "bending" || effect.name == "modifications"));
  }
  for (const EffectDecision& effect : chosen_effects(facts, {})) CHECK_FALSE(effect.on);
  // What a torque of zero asks for is not a matter of choice.
  CHECK(is_on(chosen_effects({false, true, {}}, {}), "unloaded_contact"));
}

TEST_CASE("An effect that does not exist is refused by its name", "[core][effects][input]") {
  try {
    chosen_effects({}, {"bending", "wobble"});
    FAIL("accepted");
  } catch (const InvalidInput& error) {
    CHECK(error.field() == "fidelity.effects");
    CHECK(error.value() == "wobble");
  }
  CHECK_FALSE(is_on(decide_effects({}), "wobble"));
}

TEST_CASE("An effect that needs another is off where that is", "[core][effects]") {
  const EffectFacts facts{true, false, {}, true};
  const EffectDecisions chosen = chosen_effects(facts, {"bending", "tip_corner"});
  CHECK(is_on(chosen, "bending"));
  CHECK_FALSE(is_on(chosen, "tip_corner"));
  for (const EffectDecision& effect : chosen) {
    if (effect.name == "tip_corner") CHECK(effect.why == "named in the study's list, but nothing without hertzian_contact, which is not");
  }
  const EffectDecisions rest = without(decide_effects(facts), "bending", "left out");
  CHECK_FALSE(is_on(rest, "bending"));
  CHECK_FALSE(is_on(rest, "adjacent_teeth"));
  CHECK(is_on(rest, "tip_corner"));
}

TEST_CASE("A list of effects neither switches whole-surface contact on nor off", "[core][effects]") {
  for (const bool whole_surface : {false, true}) {
    const EffectFacts facts{.loaded = true, .whole_surface = whole_surface};
    const EffectDecisions chosen = chosen_effects(facts, {"bending"});
    CHECK(gap_model(chosen) == (whole_surface ? GapModel::WholeSurface : GapModel::PlaneOfAction));
    CHECK(gap_model(decide_effects({.unloaded = true, .whole_surface = whole_surface})) == GapModel::PlaneOfAction);
  }
}

TEST_CASE("Decisions about effects do not depend on the order of their registration", "[core][effects]") {
  EffectList shuffled = registered_effects();
  tests::Random random(1);
  const EffectFacts facts{true, true, {misaligned(), modified()}, true};
  for (int trial = 0; trial < 10; ++trial) {
    random.shuffle(shuffled);
    const EffectDecisions decisions = decide_effects(facts, shuffled), expected = decide_effects(facts);
    REQUIRE(decisions.size() == expected.size());
    for (std::size_t i = 0; i < decisions.size(); ++i) {
      CHECK(decisions[i].name == expected[i].name);
      CHECK(decisions[i].on == expected[i].on);
      CHECK(decisions[i].why == expected[i].why);
    }
  }
}
