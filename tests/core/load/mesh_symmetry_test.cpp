#include <catch2/catch.hpp>

#include "core/contact/path/path_of_contact.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using mesh_cases::largest_difference;
using mesh_cases::loads_by_point;
using mesh_cases::torque_for;
using mesh_cases::worked_condition;

/// Pairs that are mirror images of each other, or the same run backwards, carry the same loads in other places.
namespace {

/// What changes its sign with z.
void flip(PerGear<ManufacturingError>& error) {
  for (ManufacturingError* e : {&error.pinion, &error.wheel}) {
    e->helix_slope = -e->helix_slope;
    e->twist = -e->twist;
  }
}

/// The same seen in a mirror at the mid-face plane.
FlankCondition mirrored(FlankCondition c) {
  for (Modification* m : {&c.modification.pinion, &c.modification.wheel}) {
    m->lead_slope = -m->lead_slope;
    m->twist = -m->twist;
  }
  flip(c.error);
  // An axis of rotation in the mirror's plane turns the other way round.
  c.misalignment.crossing = -c.misalignment.crossing;
  c.misalignment.intersecting = -c.misalignment.intersecting;
  c.misalignment.axial_offset = -c.misalignment.axial_offset;
  c.misalignment.mesh_misalignment = -c.misalignment.mesh_misalignment;
  return c;
}

/// The same on the other flanks, seen after half a turn about the line of centres: what the gears are ground to is given, the working condition turns.
FlankCondition turned_over(FlankCondition c) {
  c.other_flanks = true;
  c.set_design(FlankCondition(c).modification);
  flip(c.error);
  // A rotation about the line of centres is the same afterwards.
  c.misalignment.intersecting = -c.misalignment.intersecting;
  c.misalignment.axial_offset = -c.misalignment.axial_offset;
  c.misalignment.mesh_misalignment = -c.misalignment.mesh_misalignment;
  return c;
}

}  // namespace

TEST_CASE("On its other flanks a pair is itself turned over end for end, with all derivatives by the design", "[core][load]") {
  constexpr double round_off = 1e-9;  // tolerance of the solver times the condition
  const double helix = GENERATE(0.0, 30.0);
  const GapModel gap = GENERATE(GapModel::PlaneOfAction, GapModel::WholeSurface);
  PairData data = mesh_cases::pair_data(18, 54, helix, 10, 120);
  data.wheel.face_width = 110;
  data.pinion.end_rounding = data.wheel.end_rounding = 0.5;
  data.wheel.tip_rounding = 0.5;
  const GearPair gears = make_gear_pair(data);
  FlankCondition own = worked_condition();
  own.misalignment.axial_offset = 2.0;
  set(own.modification.pinion, parameter_of("topography.face_3"), 3 * units::um);  // odd along the face
  own.modification.pinion.process.kind = GrindingKind::GeneratingGrinding;
  own.modification.wheel.process.kind = GrindingKind::FormGrinding;
  own.modification.wheel.lead_slope = 5 * units::um;
  const FlankCondition other = turned_over(own);
  const MeshResolution resolution{{QuadratureRule::Gauss2, 8}, {0.1, 0.45, 0.8}};
  const auto model_of = [&](const FlankCondition& condition) {
    return make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, resolution, {}, placement_of(gap, condition, nullptr, 1.0));
  };
  const MeshModel own_model = model_of(own), other_model = model_of(other);
  CHECK(other_model.pair.data.working_flank == WorkingFlank::Left);
  std::vector<MeshParameter> parameters;
  for (const char* key : {"lead_slope", "lead_crowning", "twist", "tip_relief.amount", "tip_relief.height", "topography.face_3"}) {
    parameters.push_back(GearParameter{Member::Pinion, find_parameter(key)->parameter});
    parameters.push_back(GearParameter{Member::Wheel, find_parameter(key)->parameter});
  }
  const double torque = torque_for(gears, 100.0);
  const LoadedCycle there = analyse_cycle(own_model, own, torque, parameters), here = analyse_cycle(other_model, other, torque, parameters);
  for (std::size_t i = 0; i < resolution.phases.size(); ++i) {
    CAPTURE(helix, gap == GapModel::WholeSurface, i);
    const LoadedPosition &a = there.positions[i], &b = here.positions[i];
    CHECK(b.load.transmission_error == Approx(a.load.transmission_error).epsilon(round_off));
    CHECK(b.contact_stress.maxCoeff() == Approx(a.contact_stress.maxCoeff()).epsilon(1e-7));
    CHECK(largest_difference(loads_by_point(own_model.positions[i], a), loads_by_point(other_model.positions[i], b, -1)) <= round_off * 100.0);
    CHECK((b.transmission_error_derivative - a.transmission_error_derivative).cwiseAbs().maxCoeff() <= 1e-7);
    CHECK(a.transmission_error_derivative.cwiseAbs().maxCoeff() > 0.01);
  }
}

TEST_CASE("A mirrored spur pair carries mirrored loads", "[core][load]") {
  constexpr double kRoundOff = 1e-9;  // tolerance of the solver times the condition
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Gauss2, 8}, equally_spaced_phases(8)});
  const LoadedCycle there = analyse_cycle(model, worked_condition(), torque_for(gears, 100.0));
  const LoadedCycle mirror = analyse_cycle(model, mirrored(worked_condition()), torque_for(gears, 100.0));
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(mirror.positions[i].load.transmission_error == Approx(there.positions[i].load.transmission_error).epsilon(kRoundOff));
    CHECK(largest_difference(loads_by_point(model.positions[i], there.positions[i]), loads_by_point(model.positions[i], mirror.positions[i], -1)) <=
          kRoundOff * 100.0);
  }
}

TEST_CASE("A helical pair of the other hand is the mirror image of the first", "[core][load]") {
  constexpr double kRoundOff = 1e-9;
  const GearPair right = mesh_cases::pair(18, 54, 30, 10, 120);
  PairData data = right.data;
  data.pinion_hand = Hand::Left;
  const GearPair left = make_gear_pair(data);
  const MeshResolution resolution{{QuadratureRule::Gauss2, 10}, equally_spaced_phases(6)};
  const MeshModel right_model = mesh_cases::model(right, resolution), left_model = mesh_cases::model(left, resolution);
  const double torque = torque_for(right, 100.0);
  const LoadedCycle there = analyse_cycle(right_model, worked_condition(), torque);
  const LoadedCycle mirror = analyse_cycle(left_model, mirrored(worked_condition()), torque);
  const LoadedCycle same = analyse_cycle(left_model, worked_condition(), torque);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(mirror.positions[i].load.transmission_error == Approx(there.positions[i].load.transmission_error).epsilon(kRoundOff));
    const auto loads = loads_by_point(right_model.positions[i], there.positions[i]);
    CHECK(largest_difference(loads, loads_by_point(left_model.positions[i], mirror.positions[i], -1)) <= kRoundOff * 100.0);
    // And only the mirrored condition does: the test can fail.
    CHECK(largest_difference(loads, loads_by_point(left_model.positions[i], same.positions[i], -1)) > 1.0);
  }
}

TEST_CASE("A helical pair driven on its other flank is the same as a pair of the other hand", "[core][load]") {
  constexpr double kRoundOff = 1e-9;
  // Seen in a mirror that holds both axes, the coast side of a right-hand pinion is the drive side of a left-hand one;
  // of the misalignments only rotation about the line of centres changes its sign there.
  PairData data = mesh_cases::pair_data(18, 54, 30, 10, 120);
  data.working_flank = WorkingFlank::Left;
  const GearPair coast = make_gear_pair(data);
  data.working_flank = WorkingFlank::Right;
  data.pinion_hand = Hand::Left;
  const GearPair drive = make_gear_pair(data);
  FlankCondition reflected = worked_condition();
  reflected.misalignment.crossing = -reflected.misalignment.crossing;
  const MeshResolution resolution{{}, {0.2, 0.6}};
  const MeshModel coast_model = mesh_cases::model(coast, resolution), drive_model = mesh_cases::model(drive, resolution);
  const double torque = torque_for(coast, 100.0);
  const LoadedCycle a = analyse_cycle(coast_model, worked_condition(), torque);
  const LoadedCycle b = analyse_cycle(drive_model, reflected, torque);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(a.positions[i].load.transmission_error == Approx(b.positions[i].load.transmission_error).epsilon(kRoundOff));
    CHECK(largest_difference(loads_by_point(coast_model.positions[i], a.positions[i]), loads_by_point(drive_model.positions[i], b.positions[i])) <=
          kRoundOff * 100.0);
  }
}

TEST_CASE("Equal gears in perfect mesh run the same forwards and backwards", "[core][load]") {
  constexpr double kRoundOff = 1e-9;
  const double helix = GENERATE(0.0, 25.0);
  const GearPair gears = mesh_cases::pair(28, 28, helix, 3, 25);
  const PathOfContact path(gears);
  std::vector<double> forwards = {0.07, 0.31, 0.55, 0.98}, backwards;
  for (double phase : forwards) backwards.push_back(path.last_line_phase() - phase);
  const MeshModel there = mesh_cases::model(gears, {{QuadratureRule::Gauss2, 10}, forwards});
  const MeshModel back = mesh_cases::model(gears, {{QuadratureRule::Gauss2, 10}, backwards});
  const double torque = torque_for(gears, 200.0);
  const LoadedCycle a = analyse_cycle(there, {}, torque), b = analyse_cycle(back, {}, torque);
  for (std::size_t i = 0; i < forwards.size(); ++i) {
    CAPTURE(helix, forwards[i]);
    CHECK(a.positions[i].load.transmission_error == Approx(b.positions[i].load.transmission_error).epsilon(kRoundOff));
    CHECK(largest_difference(loads_by_point(there.positions[i], a.positions[i]), loads_by_point(back.positions[i], b.positions[i], -1, -1)) <=
          kRoundOff * 200.0);
  }
}
