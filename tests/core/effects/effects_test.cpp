#include "core/effects/effects.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "core/base/error.hpp"
#include "core/load/mesh_cycle.hpp"

using namespace flankwright;

namespace {

FlankCondition misaligned() {
  FlankCondition condition;
  condition.misalignment.mesh_misalignment = 10 * units::um;
  return condition;
}

FlankCondition modified() {
  FlankCondition condition;
  condition.wheel_modification.lead_crowning = 5 * units::um;
  return condition;
}

FlankCondition with_errors() {
  FlankCondition condition;
  condition.pinion_error.cumulative_pitch = {0.0, 3 * units::um};
  return condition;
}

/// A short cycle with what the effects leave on.
LoadedCycle run(const std::vector<Effect>& effects, const FlankCondition& condition) {
  PairData data;
  data.normal_module = 5;
  data.helix_angle = 15 * units::deg;
  data.pinion.teeth = 20;
  data.wheel.teeth = 31;
  data.pinion.face_width = data.wheel.face_width = 40;
  const MeshModel model =
      make_mesh_model(make_gear_pair(data), {}, {}, {{}, equally_spaced_phases(4)}, mesh_effects(effects));
  return analyse_cycle(model, apply_effects(effects, condition), 3e5);
}

bool bit_identical(const LoadedCycle& a, const LoadedCycle& b) {
  bool same = a.positions.size() == b.positions.size();
  for (std::size_t i = 0; same && i < a.positions.size(); ++i) {
    same = a.positions[i].load.line_load == b.positions[i].load.line_load &&
           a.positions[i].load.transmission_error == b.positions[i].load.transmission_error &&
           a.positions[i].contact_stress == b.positions[i].contact_stress;
  }
  return same;
}

std::vector<std::string> all_names_but(const std::string& left_out) {
  std::vector<std::string> names;
  for (std::string_view name : effect_names()) {
    if (name != left_out) names.emplace_back(name);
  }
  return names;
}

}  // namespace

TEST_CASE("Every effect has a name of its own and says why it is on or off", "[core][effects]") {
  const auto names = effect_names();
  CHECK(std::set<std::string_view>(names.begin(), names.end()).size() == names.size());
  for (const EffectFacts& facts : {EffectFacts{}, EffectFacts{true, true, {misaligned(), modified(), with_errors()}}}) {
    const std::vector<Effect> effects = decide_effects(facts);
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
  for (const Effect& effect : effects) CHECK(effect.on == (effect.name == "unloaded_contact"));
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
  for (const NamedModificationParameter& p : modification_parameters) {
    if (p.parameter == ModificationParameter::TipReliefHeight ||
        p.parameter == ModificationParameter::RootReliefHeight ||
        p.parameter == ModificationParameter::EndReliefLength) {
      continue;  // an extent without an amount removes nothing
    }
    FlankCondition condition;
    set(condition.pinion_modification, p.parameter, 1 * units::um);
    CAPTURE(std::string(p.name));
    CHECK(is_on(decide_effects({true, false, {condition}}), "modifications"));
  }
  for (double ManufacturingError::*error : {&ManufacturingError::helix_slope, &ManufacturingError::profile_slope,
                                            &ManufacturingError::twist, &ManufacturingError::pitch_step}) {
    FlankCondition condition;
    condition.wheel_error.*error = -1 * units::um;
    CHECK(is_on(decide_effects({true, false, {condition}}), "manufacturing_errors"));
  }
  for (double Misalignment::*part :
       {&Misalignment::crossing, &Misalignment::intersecting, &Misalignment::centre_distance,
        &Misalignment::axial_offset, &Misalignment::pinion_lead_angle, &Misalignment::pinion_pressure_angle,
        &Misalignment::mesh_misalignment}) {
    FlankCondition condition;
    condition.misalignment.*part = -1e-4;
    CHECK(is_on(decide_effects({true, false, {condition}}), "misalignment"));
  }
}

TEST_CASE("Effects chosen by hand are exactly those named", "[core][effects]") {
  const EffectFacts facts{true, false, {misaligned()}};
  const auto effects = chosen_effects(facts, {"bending", "modifications"});
  for (const Effect& effect : effects) {
    CHECK(effect.on == (effect.name == "bending" || effect.name == "modifications"));
  }
  for (const Effect& effect : chosen_effects(facts, {})) CHECK_FALSE(effect.on);
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

TEST_CASE("Switching every effect on by hand is what the automatic choice does where all are called for",
          "[core][effects]") {
  FlankCondition all = misaligned();
  all.wheel_modification = modified().wheel_modification;
  all.pinion_error = with_errors().pinion_error;
  const EffectFacts facts{true, false, {all}};
  CHECK(bit_identical(run(decide_effects(facts), all), run(chosen_effects(facts, all_names_but("")), all)));
}

TEST_CASE("What is switched off leaves no trace in the results", "[core][effects]") {
  FlankCondition all = misaligned();
  all.wheel_modification = modified().wheel_modification;
  all.pinion_error = with_errors().pinion_error;
  const EffectFacts facts{true, false, {all}};
  const LoadedCycle with_everything = run(decide_effects(facts), all);
  REQUIRE(with_everything.usable());
  const auto check = [&](const std::string& name, const FlankCondition& without) {
    CAPTURE(name);
    const LoadedCycle off = run(chosen_effects(facts, all_names_but(name)), all);
    REQUIRE(off.usable());
    CHECK(bit_identical(off, run(decide_effects({true, false, {without}}), without)));
    CHECK_FALSE(bit_identical(off, with_everything));  // the effect did something
  };
  FlankCondition without = all;
  without.misalignment = {};
  check("misalignment", without);
  without = all;
  without.wheel_modification = {};
  check("modifications", without);
  without = all;
  without.pinion_error = {};
  check("manufacturing_errors", without);
}

TEST_CASE("Effects of the mesh reach the mesh model one by one", "[core][effects]") {
  const EffectFacts facts{true, false, {}};
  const auto left_out = [&](const char* name) { return mesh_effects(chosen_effects(facts, all_names_but(name))); };
  CHECK_FALSE(left_out("bending").bending);
  CHECK_FALSE(left_out("hertzian_contact").hertzian_contact);
  CHECK_FALSE(left_out("tip_corner").tip_corner);
  CHECK_FALSE(left_out("extended_contact_region").extended_contact_region);
  for (const char* name : {"bending", "hertzian_contact", "tip_corner", "extended_contact_region"}) {
    const MeshEffects e = left_out(name);
    CHECK(int{e.bending} + int{e.hertzian_contact} + int{e.tip_corner} + int{e.extended_contact_region} == 3);
  }
}
