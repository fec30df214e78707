#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/load/cycle/contact_stress.hpp"
#include "core/rating/line_ends.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

/// A helical pair whose pinion is wider than the wheel by 1 mm at either end.
GearPair overhanging_pair(double tip_rounding = 0.0) {
  PairData data = mesh_cases::pair_data(23, 67, 28, 1.75, 28);
  data.pinion.face_width = 30;
  data.pinion.tip_rounding = data.wheel.tip_rounding = tip_rounding;
  return make_gear_pair(data);
}

/// Load on the end of the face at z = +b/2.
FlankCondition towards_the_end(double lead_slope) {
  FlankCondition condition;
  condition.modification.pinion.lead_slope = lead_slope;
  condition.modification.pinion.tip_relief = condition.modification.wheel.tip_relief = {25 * units::um, 1.5, ReliefShape::Linear};
  return condition;
}

constexpr double end_torque = 250e3;

struct EndPeak {
  double stress{0.0};
  std::size_t position{0};
  Eigen::Index point{-1};
};

EndPeak highest_stress(const LoadedCycle& cycle) {
  EndPeak peak;
  for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
    Eigen::Index point = -1;
    const double stress = cycle.positions[k].contact_stress.maxCoeff(&point);
    if (stress > peak.stress) peak = {stress, k, point};
  }
  return peak;
}

MeshModel graded(const GearPair& gears, int intervals) {
  return mesh_cases::model(gears, {{QuadratureRule::Graded, intervals}, equally_spaced_phases(16)});
}

bool at_face_end(const MeshModel& model, const EndPeak& peak) {
  return std::ranges::any_of(model.positions[peak.position].face_ends, [&](const FaceEndOfLine& end) { return end.point == peak.point; });
}

}  // namespace

TEST_CASE("Where the mate overhangs the highest stress is that of the very end of the face", "[core][load][face-end]") {
  const GearPair gears = overhanging_pair();
  const FlankCondition condition = towards_the_end(-20 * units::um);
  const MeshModel model = graded(gears, 12), fine = graded(gears, 48);
  const LoadedCycle cycle = analyse_cycle(model, condition, end_torque);
  const EndPeak peak = highest_stress(cycle);
  REQUIRE(at_face_end(model, peak));
  // Discretisation: without the end itself, 0.02 mm beyond the last point, 3 % are missing.
  CHECK(peak.stress == Approx(highest_stress(analyse_cycle(fine, condition, end_torque)).stress).epsilon(0.015));
  // The same end by the spline of the structure's deflection instead of the parabola of the contact's.
  double stress_at_end = 0.0;
  for (const LineEnd& end : line_ends(model, model.positions[peak.position], cycle.positions[peak.position], condition)) {
    stress_at_end = std::max(stress_at_end, end.contact_stress);
  }
  CHECK(peak.stress == Approx(stress_at_end).epsilon(0.01));
}

TEST_CASE("The end of a spur line has the line's own load where that is even, and its rise goes on to the end where it leans",
          "[core][load][face-end]") {
  const GearPair gears = mesh_cases::pair(24, 36, 0, 4, 20);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(4)}, MeshEffects::all_but({"free_ends"}));
  const double lead_slope = GENERATE(0.0, 10.0) * units::um;
  FlankCondition condition;
  condition.modification.pinion.lead_slope = lead_slope;
  const LoadedCycle cycle = analyse_cycle(model, condition, end_torque);
  for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
    const std::vector<LineEnd> ends = line_ends(model, model.positions[k], cycle.positions[k], condition);
    for (const FaceEndOfLine& end : model.positions[k].face_ends) {
      const double shown = cycle.positions[k].contact_stress[end.point];
      const auto same =
          std::ranges::find_if(ends, [&](const LineEnd& e) { return e.tooth == end.place.tooth && std::abs(e.z - end.place.z) < 1e-9; });
      if (same == ends.end() || !(shown > 0.0)) continue;
      CAPTURE(lead_slope, k, end.place.z);
      const auto point = static_cast<std::size_t>(end.point);
      const double load = cycle.positions[k].load.line_load[end.point];
      const double own = contact_stress(model, model.positions[k].points[point], nullptr, load).highest.pressure;
      // Discretisation: two ways of continuing what is smooth over a hundredth of the face. Where the load falls towards the end, the point has more.
      CHECK(shown == Approx(std::max(own, same->contact_stress)).epsilon(1e-3));
    }
  }
}

TEST_CASE("Stress at a face end has the slopes of differences, on a tip edge too", "[core][load][face-end][gradient]") {
  const double tip_rounding = GENERATE(0.0, 0.1);
  const GearPair gears = overhanging_pair(tip_rounding);
  const MeshModel model = graded(gears, 6);
  FlankCondition condition = towards_the_end(-20 * units::um);
  condition.modification.pinion.tip_relief.amount = condition.modification.wheel.tip_relief.amount = 5 * units::um;
  const std::vector<GearParameter> parameters{{Member::Pinion, parameter_of("lead_slope")},
                                              {Member::Pinion, parameter_of("lead_crowning")},
                                              {Member::Pinion, parameter_of("tip_relief.amount")},
                                              {Member::Wheel, parameter_of("profile_slope")}};
  const LoadedCycle cycle = analyse_cycle(model, condition, end_torque, {parameters.begin(), parameters.end()});
  constexpr double step = 1e-7;  // mm
  int compared = 0, compared_on_edges = 0;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const LoadedCycle up = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], step), end_torque);
    const LoadedCycle down = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], -step), end_torque);
    for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
      const auto loaded = [](const LoadedPosition& position) { return (position.load.line_load.array() > 0.0).eval(); };
      // Points that gain or lose contact within a step have no two-sided slope.
      if ((loaded(up.positions[k]) != loaded(down.positions[k])).any()) continue;
      for (const FaceEndOfLine& end : model.positions[k].face_ends) {
        const double stress = cycle.positions[k].contact_stress[end.point];
        if (!(stress > 0.0)) continue;
        ++compared;
        if (tip_rounding > 0.0 && cycle.positions[k].edge_stress[end.point] > 0.0) ++compared_on_edges;
        const double difference = (up.positions[k].contact_stress[end.point] - down.positions[k].contact_stress[end.point]) / (2 * step);
        CAPTURE(p, k, end.place.z, stress);
        // Discretisation of the central difference, and round-off of the stress over its step.
        CHECK(cycle.positions[k].contact_stress_derivative(end.point, static_cast<Eigen::Index>(p)) ==
              Approx(difference).epsilon(2e-6).margin(1e-12 * stress / step));
      }
    }
  }
  CHECK(compared >= 40);
  if (tip_rounding > 0.0) CHECK(compared_on_edges > 0);
}
