#include <catch2/catch.hpp>

#include "core/compliance/local/hertz_line.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

TEST_CASE("A contact softens by each gear's own ends, wherever the mate ends", "[core][effects]") {
  PairData data = mesh_cases::pair_data(20, 31, 12, 5, 30);
  data.wheel.face_width = 44;
  const GearPair gears = make_gear_pair(data);
  MeshPlacement placement;
  placement.misalignment.axial_offset = 4;
  const Material pinion{206000, 0.3}, wheel{110000, 0.34};
  const MeshModel model = make_mesh_model(gears, {pinion, wheel}, {{QuadratureRule::Gauss2, 6}, {0.8}}, {}, placement);
  REQUIRE(model.axial_offset == 4);
  for (std::size_t i = 0; i < model.positions[0].points.size(); ++i) {
    const ContactPoint& p = model.positions[0].points[i];
    // The acute end of a gear is the obtuse end of its mate.
    const double cosine = std::cos(gears.base_helix_angle), lean = -gears.acute_end(Member::Pinion) * gears.base_helix_angle;
    const ContactLaw expected(ContactSide::of(pinion, p.pinion_depth, p.pinion_tip_distance, {(15 + p.z) / cosine, (15 - p.z) / cosine}, lean),
                              ContactSide::of(wheel, p.wheel_depth, p.wheel_tip_distance, {(22 + p.z - 4) / cosine, (22 - p.z + 4) / cosine}, -lean),
                              p.relative_radius, contact_modulus(pinion, wheel));
    CAPTURE(p.z);
    CHECK(model.positions[0].laws[i].deflection(300) == Approx(expected.deflection(300)).epsilon(1e-14));  // round-off
  }
}

TEST_CASE("Even teeth of an aligned spur pair carry less at their free ends", "[core][effects]") {
  const GearPair gears = mesh_cases::pair(18, 54, 0, 10, 40);
  const double phase = (gears.pitch_point - gears.path_start) / gears.transverse_base_pitch + PathOfContact::extension;
  const auto loads = [&](const MeshEffects& effects) {
    const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 10}, {phase}}, effects);
    const LoadedCycle cycle = analyse_cycle(model, {}, mesh_cases::torque_for(gears, 600));
    REQUIRE(cycle.usable());
    return std::pair(mesh_cases::loads_by_point(model.positions[0], cycle.positions[0]),
                     mesh_cases::loads_by_point(model.positions[0], cycle.positions[0], -1));
  };
  const auto [with, mirrored] = loads({});
  const auto without = loads(MeshEffects::all_but({"free_ends"})).first;
  double last = 0, first = 0;
  for (const auto& [place, load] : with) {
    if (without.at(place) == 0) continue;  // of the pairs before and after
    CAPTURE(place.first, place.second);
    CHECK(load == Approx(mirrored.at(place)).epsilon(1e-9));  // a spur pair is its own mirror image
    CHECK(without.at(place) == Approx(600).epsilon(1e-9));    // independent slices know of no ends
    if (place.second < 0) CHECK(load > last);
    if (first == 0) first = load;
    last = load;
  }
  CHECK(first < 0.97 * 600);
  CHECK(first > 0.8 * 600);
}
