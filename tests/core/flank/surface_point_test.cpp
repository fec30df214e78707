#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/flank/flank.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

namespace {

/// A smooth field with all derivatives, for want of a simpler one: A sin(k rho) cos(l z).
class Waves : public DeviationField {
 public:
  Jet at(double rho, double z) const override { return 0.01 * (sin(0.3 * Jet::variable_u(rho)) * cos(0.2 * Jet::variable_v(z))); }
};

/// Every kind of deviation at once.
Flank waved_flank(Member member) {
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  Modification m;
  m.lead_crowning = 0.02;
  m.profile_slope = 0.006;
  m.tip_relief = {0.05, 1.5, ReliefShape::Parabolic};
  m.twist = 0.01;
  m.parabolic_te = 0.004;
  m.topography = std::make_shared<Waves>();
  ManufacturingError error;
  error.helix_slope = 0.01;
  Flank flank = make_flank(pair, member, m, error);
  flank.fields.push_back(std::make_shared<Waves>());
  return flank;
}

}  // namespace

TEST_CASE("The involute helicoid is developable and curves across its straight lines alone", "[core][flank][closed-form]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  const Flank flank = make_flank(pair, member, {}, {});
  constexpr double kRoundOff = 1e-13;  // 1/mm
  for (const double rho : {12.0, 30.0, 48.0}) {
    const SurfacePoint p = surface_point(flank, rho, 4.0, 0, 0.2);
    CAPTURE(rho);
    CHECK(std::abs(p.normal.dot(p.d_rho)) <= 1e-15 * p.d_rho.norm() * 10);
    CHECK(std::abs(p.normal.dot(p.d_z)) <= 1e-15 * p.d_z.norm() * 10);
    Eigen::Matrix2d first, second;
    first << p.d_rho.dot(p.d_rho), p.d_rho.dot(p.d_z), p.d_rho.dot(p.d_z), p.d_z.dot(p.d_z);
    const double mixed = p.normal.dot(p.d_rho_z);
    second << p.normal.dot(p.d_rho_rho), mixed, mixed, p.normal.dot(p.d_z_z);
    const Eigen::Matrix2d shape = first.inverse() * second;
    CHECK(std::abs(shape.determinant()) <= kRoundOff);
    // The tooth is convex: the flank falls away from its outward normal.
    CHECK(std::abs(shape.trace() + std::cos(pair.base_helix_angle) / rho) <= kRoundOff);
  }
}

TEST_CASE("First and second derivatives of a flank with every kind of deviation agree with differences", "[core][flank]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const Flank flank = waved_flank(member);
  constexpr double kStep = 1e-3;            // mm
  constexpr double kDiscretisation = 2e-7;  // first derivatives: third derivative * step^2 / 6
  constexpr double kSecond = 1e-6;          // second: fourth * step^2 / 12, and round-off / step^2
  const auto position = [&](double rho, double z) { return surface_point(flank, rho, z, 2, 0.3).position; };
  for (const double rho : {flank.lowest_roll() + 1.0, flank.roll_at(flank.frame.pitch_radius) + 0.7, flank.highest_roll() - 1.0}) {
    for (const double z : {-15.0, 2.0, 12.0}) {
      const SurfacePoint p = surface_point(flank, rho, z, 2, 0.3);
      const Eigen::Vector3d up = position(rho + kStep, z), down = position(rho - kStep, z);
      const Eigen::Vector3d right = position(rho, z + kStep), left = position(rho, z - kStep);
      const Eigen::Vector3d mixed =
          (position(rho + kStep, z + kStep) - position(rho + kStep, z - kStep) - position(rho - kStep, z + kStep) + position(rho - kStep, z - kStep));
      CAPTURE(rho, z);
      CHECK((p.d_rho - (up - down) / (2 * kStep)).norm() <= kDiscretisation);
      CHECK((p.d_z - (right - left) / (2 * kStep)).norm() <= kDiscretisation);
      CHECK((p.d_rho_rho - (up - 2 * p.position + down) / (kStep * kStep)).norm() <= kSecond);
      CHECK((p.d_z_z - (right - 2 * p.position + left) / (kStep * kStep)).norm() <= kSecond);
      CHECK((p.d_rho_z - mixed / (4 * kStep * kStep)).norm() <= kSecond);
    }
  }
}

TEST_CASE("Fields of generation and topography add up with the modification", "[core][flank]") {
  const Flank waved = waved_flank(Member::Pinion);
  Flank plain = waved;
  std::erase_if(plain.fields, [](const auto& one) { return dynamic_cast<const Waves*>(one.get()) != nullptr; });
  const double rho = 31.0, z = -6.0;
  const double field = Waves().at(rho, z).value;
  CHECK(std::abs(waved.deviation(rho, z, 1) - plain.deviation(rho, z, 1) - 2.0 * field) <= 1e-16);
  // The rotation through a point undoes the whole of it, gradient included.
  const Point3<Dual<2>> p = flank_point(waved, Dual<2>::variable(rho, 0), Dual<2>::variable(z, 1), 1, 0.25);
  const auto through = rotation_through(waved, p, 1);
  CHECK(std::abs(through.rotation.value - 0.25) <= 1e-14);
  CHECK(through.rotation.gradient.norm() <= 1e-13);
}
