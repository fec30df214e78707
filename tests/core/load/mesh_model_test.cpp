#include "core/load/cycle/mesh_model.hpp"

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

TEST_CASE("A mesh model holds one weight, law and influence for every contact point", "[core][load]") {
  constexpr double kRoundOff = 1e-14;
  const double helix = GENERATE(0.0, 30.0);
  const GearPair gears = mesh_cases::pair(18, 54, helix, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(4)});
  REQUIRE(model.positions.size() == 4);
  CHECK(model.face_width == Approx(120.0).epsilon(kRoundOff));
  for (const MeshPosition& at : model.positions) {
    const auto n = static_cast<Eigen::Index>(at.points.size());
    REQUIRE(n > 0);
    REQUIRE(at.weight.size() == n);
    REQUIRE(at.laws.size() == at.points.size());
    REQUIRE(at.influence.rows() == n);
    CHECK(at.weight.minCoeff() > 0.0);
    CHECK(at.influence.isApprox(at.influence.transpose(), 0.0));  // Maxwell, by construction
    CHECK(at.influence.diagonal().minCoeff() > 0.0);
    // Each slice yields under its own line load as the thin slice says: between its value at the tip of one gear and at
    // the root of the other all pairs are a few times ISO's.
    for (Eigen::Index i = 0; i < n; ++i) {
      const double slice = at.influence(i, i) * at.weight[i];  // mm per N/mm
      const double iso = units::um / model.iso.normal_section;
      CHECK(slice > 0.2 * iso);
      CHECK(slice < 5.0 * iso);
    }
  }
}

TEST_CASE("Doubling the intervals halves the slices and not the structure", "[core][load]") {
  constexpr double kModel = 1e-12;  // round-off: a uniformly loaded aligned spur tooth is equally stiff in any number of slices
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const auto stiffness = [&](int intervals) {
    const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Gauss2, intervals}, {0.9}}, MeshEffects::all_but({"hertzian_contact"}));
    const MeshPosition& at = model.positions[0];
    return at.influence.diagonal().cwiseInverse().sum();
  };
  CHECK(stiffness(20) == Approx(stiffness(5)).epsilon(kModel));
}

TEST_CASE("The normal force is that of the torque at the base circle and the base helix", "[core][load][closed-form]") {
  constexpr double kRoundOff = 1e-14;
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, {1.0}});
  // F_t = T/r, over cos(alpha_n) cos(beta): the textbook's route by the reference circle.
  const double torque = 1e6;  // N mm
  const double by_reference = torque / gears.pinion.reference_radius / (std::cos(20 * units::deg) * std::cos(30 * units::deg));
  CHECK(model.normal_force(torque) == Approx(by_reference).epsilon(kRoundOff));
}

TEST_CASE("The mean line load is that over the lines of many positions", "[core][load]") {
  const double helix = GENERATE(0.0, 30.0);
  const GearPair gears = mesh_cases::pair(18, 54, helix, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 8}, equally_spaced_phases(200)});
  double length = 0.0;
  for (const MeshPosition& at : model.positions) {
    for (const ContactPoint& point : at.points) length += point.clearance == 0.0 ? point.weight : 0.0;
  }
  length /= static_cast<double>(model.positions.size());
  CHECK(model.mean_line_load(1000.0) == Approx(1000.0 / length).epsilon(0.005));  // discretisation: a line ends within a position
}

TEST_CASE("An axial offset leaves the common face only", "[core][load]") {
  constexpr double kRoundOff = 1e-14;
  PairData data = mesh_cases::pair_data(20, 40, 0, 4, 30);
  data.wheel.face_width = 26;
  const GearPair gears = make_gear_pair(data);
  const double offset = GENERATE(0.0, 5.0, -5.0);
  const MeshPlacement shifted = MeshPlacement::of(GapModel::PlaneOfAction, {.axial_offset = offset});
  const MeshModel model = make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{}, {1.0}}, {}, shifted);
  const double end = std::min(15.0, offset + 13.0), start = std::max(-15.0, offset - 13.0);
  CHECK(model.face_width == Approx(end - start).epsilon(kRoundOff));
  for (const ContactPoint& point : model.positions[0].points) {
    CHECK(point.z > start);
    CHECK(point.z < end);
  }
}

TEST_CASE("Effects that are switched off leave their part of the model out", "[core][load]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshResolution resolution{{}, {0.4}};
  CHECK(mesh_cases::model(gears, resolution, MeshEffects::all_but({"bending"})).positions[0].influence.isZero(0.0));
  CHECK(mesh_cases::model(gears, resolution, MeshEffects::all_but({"hertzian_contact"})).positions[0].laws.empty());

  const MeshModel whole = mesh_cases::model(gears, resolution);
  const MeshModel theoretical = mesh_cases::model(gears, resolution, MeshEffects::all_but({"extended_contact_region"}));
  CHECK(theoretical.positions[0].points.size() < whole.positions[0].points.size());
  for (const ContactPoint& point : theoretical.positions[0].points) CHECK(point.clearance == 0.0);

  // Tips only ever soften the contact.
  const MeshModel blunt = mesh_cases::model(gears, resolution, MeshEffects::all_but({"tip_corner"}));
  bool softer_somewhere = false;
  for (std::size_t i = 0; i < whole.positions[0].laws.size(); ++i) {
    const double with = whole.positions[0].laws[i].deflection(300.0), without = blunt.positions[0].laws[i].deflection(300.0);
    CHECK(with >= without);
    softer_somewhere = softer_somewhere || with > 1.01 * without;
  }
  CHECK(softer_somewhere);
}

TEST_CASE("A mesh model that cannot be built is refused", "[core][load][input]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  CHECK_THROWS_AS(mesh_cases::model(gears, {{}, {}}), InvalidInput);
  CHECK_THROWS_AS(mesh_cases::model(gears, {{QuadratureRule::Gauss2, 0}, {0.5}}), InvalidInput);
  CHECK_THROWS_AS(mesh_cases::model(gears, {{}, {0.5}}, MeshEffects::all_but({"bending", "hertzian_contact"})), InvalidInput);
  const MeshPlacement apart = MeshPlacement::of(GapModel::PlaneOfAction, {.axial_offset = 30.0});
  CHECK_THROWS_AS(make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{}, {0.5}}, {}, apart), InvalidInput);
  CHECK_THROWS_AS(make_mesh_model(gears, {{-1.0, 0.3}, mesh_cases::steel}, {{}, {0.5}}), InvalidInput);
}

TEST_CASE("Positions made in another order are the same to the bit", "[core][load][determinism]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshResolution resolution{{QuadratureRule::Graded, 6}, equally_spaced_phases(7)};
  std::size_t made = 0;
  const ForEachIndex backwards = [&](std::size_t count, const std::function<void(std::size_t)>& work) {
    for (std::size_t i = count; i > 0; --i, ++made) work(i - 1);
  };
  const MeshModel one = mesh_cases::model(gears, resolution);
  const MeshModel other = make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, resolution, {}, {}, {}, backwards);
  REQUIRE(made == resolution.phases.size());
  REQUIRE(other.positions.size() == one.positions.size());
  for (std::size_t i = 0; i < one.positions.size(); ++i) {
    CHECK(other.positions[i].phase == resolution.phases[i]);
    CHECK(other.positions[i].weight == one.positions[i].weight);
    CHECK(other.positions[i].influence == one.positions[i].influence);
  }
}
