#include "core/rating/iso_stress_numbers.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/local/hertz_line.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

TEST_CASE("The contact stress number of a spur pair is Hertz's stress at the pitch point", "[core][rating][iso-stress]") {
  // Without Z_eps the whole normal force is on one line of the face width.
  const GearPair gears = mesh_cases::pair(20, 60, 0, 5, 40);
  const double torque = 4e5;
  const IsoStressNumbers numbers = iso_stress_numbers(gears, {mesh_cases::steel, mesh_cases::steel}, torque, 40.0);
  const double load = torque / gears.pinion.base_radius / 40.0;
  const double radius = gears.pitch_point * (gears.path_length - gears.pitch_point) / gears.path_length;
  const double hertz = hertz_line(load, radius, contact_modulus(mesh_cases::steel, mesh_cases::steel)).peak_pressure;
  CHECK(numbers.contact / numbers.Z_eps == Approx(hertz).epsilon(1e-12));  // round-off
  CHECK(numbers.Z_E == Approx(189.8).epsilon(1e-3));                       // ISO 6336-2, table 1: steel on steel
  CHECK(numbers.Z_H == Approx(2.495).epsilon(1e-3));                       // figure 1: x = 0, beta = 0
  CHECK(numbers.Z_eps == Approx(std::sqrt((4.0 - gears.transverse_contact_ratio) / 3.0)).epsilon(1e-12));
}

TEST_CASE("The inner point of single contact is found where the path of contact has it", "[core][rating][iso-stress]") {
  const GearPair gears = mesh_cases::pair(17, 40, 0, 5, 40);
  const IsoStressNumbers numbers = iso_stress_numbers(gears, {mesh_cases::steel, mesh_cases::steel}, 4e5, 40.0);
  // Hertz's stress goes with 1/sqrt(rho_1 rho_2); B of the pinion lies one base pitch before E, D of the wheel one after A.
  const auto product = [&](double rho) { return rho * (gears.path_length - rho); };
  const double at_C = product(gears.pitch_point);
  CHECK(numbers.single_pair.pinion == Approx(std::max(1.0, std::sqrt(at_C / product(gears.path_end - gears.transverse_base_pitch)))).epsilon(1e-12));
  CHECK(numbers.single_pair.wheel == Approx(std::max(1.0, std::sqrt(at_C / product(gears.path_start + gears.transverse_base_pitch)))).epsilon(1e-12));
  CHECK(numbers.single_pair.pinion > 1.0);
}

TEST_CASE("Tooth form and stress correction have the size that diagrams of ISO 53 racks show", "[core][rating][iso-stress]") {
  // Model: products Y_FS = Y_Fa Y_Sa of ISO 6336-3's diagrams are for load at the tip; at the outer point of single contact teeth of 20 .. 60 have
  // Y_F of 1.2 .. 1.8 and Y_S of 1.7 .. 2.2.
  PairData data = mesh_cases::pair_data(20, 60, 0, 5, 40);
  data.pinion.rack.root_radius = data.wheel.rack.root_radius = 0.38;
  const IsoStressNumbers numbers = iso_stress_numbers(make_gear_pair(data), {mesh_cases::steel, mesh_cases::steel}, 4e5, 40.0);
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    CHECK(numbers.Y_F[m] > 1.2);
    CHECK(numbers.Y_F[m] < 1.8);
    CHECK(numbers.Y_S[m] > 1.7);
    CHECK(numbers.Y_S[m] < 2.2);
  }
  CHECK(numbers.Y_F.pinion > numbers.Y_F.wheel);                                                        // more teeth are stouter at the root
  CHECK(numbers.root_stress(Member::Pinion, 1.5) == Approx(1.5 * numbers.root.pinion).epsilon(1e-12));  // round-off
  CHECK(numbers.contact_stress(Member::Pinion, 1.44) == Approx(1.2 * numbers.single_pair.pinion * numbers.contact).epsilon(1e-12));  // round-off
}

TEST_CASE("Stress numbers are linear in the load, contact in its root", "[core][rating][iso-stress]") {
  constexpr double round_off = 1e-12;
  // Twice the load, twice the stress; half the face, twice the stress: nominal stress is linear.
  const GearPair gears = mesh_cases::pair(20, 60, 15, 5, 40);
  const PerGear<Material> steel{mesh_cases::steel, mesh_cases::steel};
  const IsoStressNumbers one = iso_stress_numbers(gears, steel, 4e5, 40.0), two = iso_stress_numbers(gears, steel, 8e5, 40.0),
                         narrow = iso_stress_numbers(gears, steel, 4e5, 20.0);
  CHECK(two.root.pinion == Approx(2.0 * one.root.pinion).epsilon(round_off));
  CHECK(narrow.root.wheel == Approx(2.0 * one.root.wheel).epsilon(round_off));
  CHECK(two.contact == Approx(std::sqrt(2.0) * one.contact).epsilon(round_off));
  CHECK(root_face_load_factor(gears, 40.0, 1.0) == 1.0);
  CHECK(root_face_load_factor(gears, 1e6, 1.5) == Approx(1.5).epsilon(1e-4));  // a wide face: N_F = 1
  CHECK(root_face_load_factor(gears, 1.0, 1.5) == Approx(std::pow(1.5, 9.0 / 13.0)).epsilon(round_off));
}

TEST_CASE("A thin rim raises the root stress of its gear by the rim thickness factor", "[core][rating][iso-stress]") {
  const GearPair gears = mesh_cases::pair(20, 60, 0, 5, 40);
  const PerGear<Material> steel{mesh_cases::steel, mesh_cases::steel};
  const double depth = gears.wheel.tip_radius - gears.wheel.root_radius;
  CHECK(rim_thickness_factor(gears.wheel, not_given) == 1.0);
  CHECK(rim_thickness_factor(gears.wheel, 3.0 * depth) == 1.0);
  // Both pieces meet at 1.2 to the digits that the standard prints.
  CHECK(rim_thickness_factor(gears.wheel, (1.2 - 1e-9) * depth) == Approx(1.0).epsilon(1e-3));
  CHECK(rim_thickness_factor(gears.wheel, depth * 2.0 / 3.0) == Approx(1.6 * std::log(2.242 * 1.5)).epsilon(1e-12));
  const IsoStressNumbers solid = iso_stress_numbers(gears, steel, 4e5, 40.0);
  const IsoStressNumbers rim = iso_stress_numbers(gears, steel, 4e5, 40.0, {not_given, depth * 2.0 / 3.0});
  CHECK(rim.root.pinion == solid.root.pinion);
  CHECK(rim.root.wheel == Approx(rim.Y_B.wheel * solid.root.wheel).epsilon(1e-12));
  CHECK(rim.contact == solid.contact);
}
