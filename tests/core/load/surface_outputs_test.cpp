#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/rating/line_ends.hpp"
#include "core/rating/load_factors.hpp"
#include "core/load/solve/load_solver.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/core/load/synthetic_root_stress.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using mesh_cases::steel;
using mesh_cases::torque_for;
using units::um;

/// What is read off a cycle, by either gap.

namespace {

/// Without the extended region, before whose start the two gaps turn different gears to meet (SurfaceGap).
MeshModel mesh_by(GapModel gap, const GearPair& gears, const MeshResolution& resolution, const Misalignment& misalignment,
                  const PairRootStress* roots = nullptr) {
  return make_mesh_model(gears, {steel, steel}, resolution, MeshEffects::all_but({"extended_contact_region"}), MeshPlacement::of(gap, misalignment),
                         {.root_stress = roots});
}

ContactPeaks peaks_by(GapModel gap, const GearPair& gears, const FlankCondition& condition, double torque) {
  const MeshAt mesh_at = [&](const std::vector<double>& phases) {
    return mesh_by(gap, gears, {{QuadratureRule::Graded, 4}, phases}, condition.misalignment);
  };
  return locate_peaks(mesh_at, condition, torque, {.step = 1.0 / 8});
}

LoadFactors factors_by(GapModel gap, const GearPair& gears, const FlankCondition& condition, double torque) {
  const auto of = [&](const FlankCondition& part) { return peaks_by(gap, gears, part, torque); };
  const ContactPeaks perfect = of(perfect_part(condition)), whole = of(condition);
  return load_factors(perfect, of(lead_part(condition)), perfect, whole);
}

}  // namespace

TEST_CASE("Rating, line ends and root stress of aligned flanks are the same by either gap", "[core][load][line-ends][load-factors]") {
  // Gaps agree to 1e-12 mm of deflections of 1e-2; places on the profile, which curvature and compliance follow, to 1e-7 mm of lengths from
  // 1 mm on. What is removed along the face alone opens a section by cos(beta_b) of itself in either.
  // Where a line ends on a tip edge what is removed, some 3 um, takes the touching place beyond the edge by as much: gaps there differ by its square
  // over twice the curvature of some 5 mm, 1e-6 mm, of contact deflections of 5e-4 mm.
  constexpr double kPlaces = 1e-6, kTipEdge = 2e-3;
  const double helix = GENERATE(0.0, 25.0);
  const GearPair gears = mesh_cases::pair(23, 41, helix, 4, 30);
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 5 * um;
  condition.modification.wheel.lead_slope = 3 * um;
  condition.misalignment.mesh_misalignment = 7 * um;
  const double torque = torque_for(gears, 150);
  const mesh_cases::SyntheticRootStress roots(gears);
  const MeshResolution resolution{{QuadratureRule::Graded, 4}, equally_spaced_phases(5)};
  const MeshModel plane = mesh_by(GapModel::PlaneOfAction, gears, resolution, condition.misalignment, &roots);
  const MeshModel surface = mesh_by(GapModel::WholeSurface, gears, resolution, condition.misalignment, &roots);
  const LoadedCycle by_plane = analyse_cycle(plane, condition, torque), by_surface = analyse_cycle(surface, condition, torque);
  for (std::size_t i = 0; i < by_plane.positions.size(); ++i) {
    CAPTURE(helix, i);
    const auto ends = line_ends(plane, plane.positions[i], by_plane.positions[i], condition);
    const auto same = line_ends(surface, surface.positions[i], by_surface.positions[i], condition);
    REQUIRE(ends.size() == same.size());
    REQUIRE(!ends.empty());
    for (std::size_t k = 0; k < ends.size(); ++k) {
      CHECK(same[k].tooth == ends[k].tooth);
      CHECK(same[k].z == tests::about(ends[k].z, 1e-9));
      const double kEnd = std::abs(std::abs(ends[k].z) - 15) < 1e-6 ? kPlaces : kTipEdge;
      CHECK(same[k].line_load == Approx(ends[k].line_load).epsilon(kEnd).margin(kEnd * 150));
      CHECK(same[k].structural_deflection == Approx(ends[k].structural_deflection).epsilon(kPlaces));
      CHECK(same[k].contact_stress == Approx(ends[k].contact_stress).epsilon(kEnd).margin(1e-3));
    }
    for (const Member member : {Member::Pinion, Member::Wheel}) {
      const RootStressPeak root = root_stress_peak(plane.positions[i], by_plane.positions[i], member);
      const RootStressPeak same_root = root_stress_peak(surface.positions[i], by_surface.positions[i], member);
      CHECK(same_root.stress == Approx(root.stress).epsilon(kPlaces));
      CHECK(same_root.station.tooth == root.station.tooth);
    }
    CHECK(by_surface.positions[i].stiffness == Approx(by_plane.positions[i].stiffness).epsilon(kPlaces));
  }
  const LoadFactors rated = factors_by(GapModel::PlaneOfAction, gears, condition, torque);
  const LoadFactors same = factors_by(GapModel::WholeSurface, gears, condition, torque);
  CHECK(same.without_spikes.lead == Approx(rated.without_spikes.lead).epsilon(kPlaces));
  CHECK(same.with_spikes.lead == Approx(rated.with_spikes.lead).epsilon(kPlaces));
  CHECK(same.without_spikes.combined == Approx(rated.without_spikes.combined).epsilon(kPlaces));
  CHECK(rated.without_spikes.lead > 1.02);
}

TEST_CASE("Outputs of misaligned flanks differ between the two gap models as the gaps do", "[core][load][line-ends][load-factors]") {
  const GearPair gears = mesh_cases::pair(23, 41, 25, 4, 30);
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 5 * um;
  condition.misalignment.intersecting = 20 * units::arcmin;
  condition.misalignment.centre_distance = 0.3;
  const double torque = torque_for(gears, 300);
  const MeshModel model = mesh_by(GapModel::WholeSurface, gears, {{QuadratureRule::Graded, 5}, equally_spaced_phases(4)}, condition.misalignment);
  const LoadedCycle cycle = analyse_cycle(model, condition, torque);
  double spread = 0, stiffest = 0, ends_apart = 0;
  for (std::size_t p = 0; p < model.positions.size(); ++p) {
    // The same points, compliance and laws, with the gap that the plane of action has.
    const MeshPosition& at = model.positions[p];
    LoadedPosition plane = cycle.positions[p];
    plane.gap = plane_of_action_gap(gears, at.points, condition);
    plane.load = solve_load_distribution({at.influence, at.weight, plane.gap.total, at.laws, cycle.force});
    const LoadedPosition& surface = cycle.positions[p];
    const Eigen::VectorXd apart = surface.gap.total - plane.gap.total;
    const double rise = surface.load.transmission_error - plane.load.transmission_error;
    // f_t rises with every gap, and with all of them together by as much.
    CHECK(rise >= apart.minCoeff() - 1e-12);
    CHECK(rise <= apart.maxCoeff() + 1e-12);
    const double of_position = apart.maxCoeff() - apart.minCoeff();
    spread = std::max(spread, of_position);
    for (Eigen::Index i = 0; i < apart.size(); ++i) {
      // Slices that know their own load only: dw (q + c') = df - dg, and c' falls as the load rises.
      const double load = surface.load.line_load[i], other = plane.load.line_load[i], most = std::max(load, other);
      if (most == 0) continue;
      const double stiffness = 1 / (at.influence(i, i) * at.weight[i] + at.laws[static_cast<std::size_t>(i)].slope(most));
      CHECK(std::abs(load - other) <= of_position * stiffness * (1 + 1e-9));
      stiffest = std::max(stiffest, stiffness);
    }
    const auto ends = line_ends(model, at, surface, condition);
    MeshModel in_plane = model;
    in_plane.placement.gap = GapModel::PlaneOfAction;  // the gap at the ends; the effects place them as before
    const auto others = line_ends(in_plane, at, plane, condition);
    REQUIRE(ends.size() == others.size());
    for (std::size_t k = 0; k < ends.size(); ++k) ends_apart = std::max(ends_apart, std::abs(ends[k].line_load - others[k].line_load));
  }
  CAPTURE(spread / um, stiffest * um, ends_apart);
  CHECK(spread > 0.2 * um);
  // Carried outwards by a spline through a line's points: some times what they differ by.
  CHECK(ends_apart > 0.02 * spread * stiffest);
  CHECK(ends_apart < 3 * spread * stiffest);
  const double by_surface = factors_by(GapModel::WholeSurface, gears, condition, torque).without_spikes.lead;
  const double by_plane = factors_by(GapModel::PlaneOfAction, gears, condition, torque).without_spikes.lead;
  // K is the ratio of peak loads, about 300 N/mm and more; curvature moves with the places, by 0.3 mm of some 10.
  CAPTURE(by_surface, by_plane);
  CHECK(by_surface != by_plane);
  CHECK(std::abs(by_surface / by_plane - 1) < spread * stiffest / 300 + 0.03);
}
