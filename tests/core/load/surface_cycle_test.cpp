#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/contact/unloaded/tooth_contact.hpp"
#include "core/rating/line_ends.hpp"
#include "core/load/cycle/mesh_motion.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;
using mesh_cases::steel;
using mesh_cases::torque_for;
using units::arcmin;
using units::pi;
using units::um;

namespace {

MeshModel surface_model(const GearPair& gears, const MeshResolution& resolution, const Misalignment& misalignment = {},
                        const MeshEffects& effects = {}) {
  return make_mesh_model(gears, {steel, steel}, resolution, effects, MeshPlacement::of(GapModel::WholeSurface, misalignment));
}

/// Crowned, relieved and skewed: contact at maxima, on tips and at face ends.
FlankCondition surface_condition() {
  FlankCondition c;
  c.modification.pinion.lead_crowning = 6 * um;
  c.modification.pinion.tip_relief = {30 * um, 2.1, ReliefShape::Parabolic};
  c.modification.wheel.addendum_crowning = 15 * um;
  c.modification.wheel.profile_slope = -5 * um;
  c.error.wheel.helix_slope = 4 * um;
  c.error.pinion.pitch_step = 2 * um;
  c.misalignment.crossing = 2 * arcmin;
  c.misalignment.intersecting = -3 * arcmin;
  c.misalignment.centre_distance = 0.08;
  return c;
}

}  // namespace

TEST_CASE("As the load vanishes the loaded transmission error becomes the unloaded one", "[core][load][independent]") {
  const double helix = GENERATE(0.0, 20.0);
  const GearPair gears = mesh_cases::pair(23, 41, helix, 4, 30);
  FlankCondition condition = surface_condition();
  const bool edges = GENERATE(false, true);
  if (edges) {
    // Hollow leads and a pitch error that brings the next tooth in by its tip edge.
    condition.modification.pinion = condition.modification.wheel = {};
    condition.modification.pinion.lead_crowning = -5 * um;
    condition.error.pinion.pitch_step = 40 * um;
  }
  const FlankAssembly scene = assemble_flanks(gears, condition);
  const PathOfContact path(gears);
  constexpr int kIntervals = 300;
  const std::vector<double> phases{0.02, 0.21, 0.4, 0.63, 0.87};
  const MeshModel model = surface_model(gears, {{QuadratureRule::Midpoint, kIntervals}, phases}, condition.misalignment);
  const LoadedCycle cycle = analyse_cycle(model, condition, 1e-4);  // N mm
  REQUIRE(cycle.usable());
  bool on_an_edge = false;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const double phi1 = path.pinion_angle_at(phases[i], gears);
    ToothContact first;
    for (int tooth = -4; tooth <= 4; ++tooth) {
      const ToothContact contact = find_tooth_contact(scene, tooth, phi1);
      if (contact.exists() && !(contact.transmission_error <= first.transmission_error)) first = contact;
    }
    const double unloaded = -first.transmission_error * gears.wheel.base_radius * std::cos(gears.base_helix_angle);
    const double loaded = cycle.positions[i].load.transmission_error;
    on_an_edge = on_an_edge || first.kind != ContactKind::Surface;
    CAPTURE(helix, phases[i], to_string(first.kind), loaded / um, unloaded / um);
    // discretisation: the nearest point lies half an interval off, where the gap slopes by no more than 2 um/mm
    const double kDiscretisation = 2e-3 * 0.5 * gears.face_width / kIntervals;
    CHECK(loaded >= unloaded - 1e-11);  // round-off: no point is nearer than first contact
    CHECK(loaded <= unloaded + kDiscretisation);
  }
  CHECK(on_an_edge);
}

TEST_CASE("Aligned and unmodified flanks carry load alike by either gap", "[core][load]") {
  const double helix = GENERATE(0.0, 25.0);
  const GearPair gears = mesh_cases::pair(23, 41, helix, 4, 30);
  const MeshResolution resolution{{QuadratureRule::Gauss2, 6}, equally_spaced_phases(6)};
  const MeshEffects effects = MeshEffects::all_but({"extended_contact_region"});
  const double torque = torque_for(gears, 150);
  const LoadedCycle plane = analyse_cycle(mesh_cases::model(gears, resolution, effects), {}, torque);
  const LoadedCycle surface = analyse_cycle(surface_model(gears, resolution, {}, effects), {}, torque);
  for (std::size_t i = 0; i < plane.positions.size(); ++i) {
    constexpr double kRoundOff = 1e-6;  // places on the profile are known to the root of round-off
    const Eigen::VectorXd &a = plane.positions[i].load.line_load, &b = surface.positions[i].load.line_load;
    REQUIRE(a.size() == b.size());
    CHECK((a - b).cwiseAbs().maxCoeff() <= kRoundOff * a.maxCoeff());
  }
}

TEST_CASE("Aligned and unmodified flanks have no error, on the tip edges neither", "[core][load]") {
  const GearPair gears = mesh_cases::pair(23, 41, 20, 4, 30);
  const MeshModel model = surface_model(gears, {{QuadratureRule::Gauss2, 6}, equally_spaced_phases(4)});
  const LoadedCycle cycle = analyse_cycle(model, {}, torque_for(gears, 150));
  int on_edges = 0;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    constexpr double kRoundOff = 1e-12;  // mm
    CHECK(cycle.positions[i].gap.error.cwiseAbs().maxCoeff() <= kRoundOff);
    for (const ContactPoint& point : model.positions[i].points) on_edges += point.clearance > 0.0 ? 1 : 0;
  }
  CHECK(on_edges > 10);
}

TEST_CASE("Points of the whole surface follow the misalignment and stay while modifications change", "[core][load]") {
  const GearPair gears = mesh_cases::pair(23, 41, 20, 4, 30);
  const Misalignment apart{.centre_distance = 0.3};
  const MeshResolution resolution{{}, {0.9}};
  const MeshModel aligned = surface_model(gears, resolution), misaligned = surface_model(gears, resolution, apart);
  const std::vector<ContactPoint>&a = aligned.positions[0].points, &b = misaligned.positions[0].points;
  REQUIRE(a.size() == b.size());
  // Further apart, contact lies at a larger pressure angle: the same pinion angle touches elsewhere on the profile.
  double moved = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    moved = std::max(moved, std::abs(a[i].pinion_radius - b[i].pinion_radius));
    CHECK(a[i].z == b[i].z);
  }
  CHECK(moved > 0.05);
  // Two conditions that differ in modifications share a placement; in the plane of action, whatever moves no point.
  CHECK(MeshPlacement::of(GapModel::PlaneOfAction, apart) == MeshPlacement{});
  CHECK(MeshPlacement::of(GapModel::WholeSurface, apart) != MeshPlacement::of(GapModel::WholeSurface, {}));
}

TEST_CASE("The ends of lines carry what the whole surface leaves there", "[core][load][line-ends]") {
  // Far apart and skewed both gaps differ by half a micrometre: only the one that the points have continues their loads to the end,
  // where these do not drop for a free end.
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  FlankCondition condition;
  condition.misalignment.crossing = 2 * arcmin;
  condition.misalignment.centre_distance = 1.2;
  const double phase = (gears.pitch_point - gears.path_start) / gears.transverse_base_pitch + PathOfContact::extension;
  const MeshModel model =
      surface_model(gears, {{QuadratureRule::Midpoint, 40}, {phase}}, condition.misalignment, MeshEffects::all_but({"free_ends"}));
  const LoadedPosition loaded = analyse_cycle(model, condition, torque_for(gears, 300)).positions[0];
  const std::vector<ContactPoint>& points = model.positions[0].points;
  const Eigen::VectorXd &w = loaded.load.line_load, plane = plane_of_action_gap(gears, points, condition).total;
  CHECK((loaded.gap.total - plane).cwiseAbs().minCoeff() > 0.5 * um);
  int compared = 0;
  for (const LineEnd& end : line_ends(model, model.positions[0], loaded, condition)) {
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      const bool is_last = std::abs(points[k].z - end.z) < 0.4 && points[k].tooth == end.tooth;  // half an interval: 0.375 mm
      if (!is_last) continue;
      const double onwards = 1.5 * w[i] - 0.5 * w[end.z < 0.0 ? i + 1 : i - 1];
      CAPTURE(end.tooth, end.z, w[i], end.line_load);
      CHECK(std::abs(end.line_load - onwards) <= 0.01 * w.maxCoeff());  // discretisation: curvature of w over an interval
      ++compared;
    }
  }
  CHECK(compared > 0);
}

TEST_CASE("Gradients over the whole surface agree with central differences", "[core][load]") {
  const GearPair gears = mesh_cases::pair(23, 41, 20, 4, 30);
  FlankCondition condition = surface_condition();
  condition.modification.pinion.parabolic_te = 2e-4;
  condition.modification.pinion.process.kind = GENERATE(GrindingKind::None, GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding);
  condition.modification.pinion.process.twist_compensation = 0.25;
  const MeshPlaced placed = [&](const MeshPlacement& at) {
    return surface_model(gears, {{QuadratureRule::Gauss2, 5}, {0.15, 0.48, 0.83}}, at.misalignment);
  };
  const double torque = torque_for(gears, 200);
  const std::vector<MeshParameter> parameters{GearParameter{Member::Pinion, parameter_of("lead_crowning")},
                                              GearParameter{Member::Pinion, parameter_of("tip_relief.amount")},
                                              GearParameter{Member::Pinion, parameter_of("tip_relief.height")},
                                              GearParameter{Member::Pinion, parameter_of("parabolic_te")},
                                              GearParameter{Member::Pinion, parameter_of("twist_compensation")},
                                              GearParameter{Member::Wheel, parameter_of("addendum_crowning")},
                                              GearParameter{Member::Wheel, parameter_of("profile_slope")},
                                              &Misalignment::crossing,
                                              &Misalignment::intersecting,
                                              &Misalignment::centre_distance,
                                              &Misalignment::pinion_lead_angle,
                                              &Misalignment::mesh_misalignment};
  const auto mesh = [&](const FlankCondition& c) { return placed(MeshPlacement::of(GapModel::WholeSurface, c.misalignment)); };
  const MeshModel model = with_perturbed_meshes(mesh(condition), placed, parameters);
  const LoadedCycle cycle = analyse_cycle(model, condition, torque, parameters);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto shifted = [&](double by) {
      FlankCondition c = condition;
      if (const auto* gear = std::get_if<GearParameter>(&parameters[p])) {
        Modification& m = c.modification[gear->member];
        set(m, gear->parameter, get(m, gear->parameter) + by);
      } else {
        c.misalignment.*std::get<MisalignmentParameter>(parameters[p]) += by;
      }
      return analyse_cycle(mesh(c), c, torque);
    };
    const double step = 2e-6;  // mm, rad, 1/rad, or a fraction
    const LoadedCycle up = shifted(step), down = shifted(-step);
    for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
      const double by_differences = (up.positions[i].load.transmission_error - down.positions[i].load.transmission_error) / (2 * step);
      const double exact = cycle.positions[i].transmission_error_derivative[static_cast<Eigen::Index>(p)];
      CAPTURE(p, i, exact, by_differences);
      // discretisation: the step's square times the third derivative; round-off of f_t, 1e-13 mm, over the step
      CHECK(std::abs(exact - by_differences) <= 2e-5 * std::abs(exact) + 1e-7);
    }
  }
}
