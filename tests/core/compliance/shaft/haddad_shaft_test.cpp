#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/units.hpp"
#include "core/compliance/shaft/beam_system.hpp"

/// C. D. Haddad, The elastic analysis of load distribution in wide-faced helical gears, Ph.D. thesis, University of Newcastle
/// upon Tyne, 1991, appendix 2C: a shaft of two diameters on two supports, the gear's face 0 .. b, z counted from it. All
/// formulas are his; loads are a force and a moment in one plane, his F cos(beta_b) and M_f.
namespace haddad_2c {

using namespace flankwright;
using Eigen::Vector3d;

constexpr double E = 209000, nu = 0.3, G = E / (2 * (1 + nu));
constexpr double l1 = 70, b = 120, l4 = 50, l = l1 + b + l4;
constexpr double d1 = 90, d2 = 160;
constexpr double kRoundOff = 1e-11;

double I(double d) { return units::pi * std::pow(d, 4) / 64; }       // 2C.27, 2C.28
double J(double d) { return units::pi * std::pow(d, 4) / 32; }       // 2C.4, 2C.5
double slope(double d) { return 16 / (3 * units::pi * G * d * d); }  // 2C.8b, per unit of shear force

BeamPiece piece(double length, double d) { return {length, 1 / (E * I(d)), slope(d), 1 / (G * J(d)), 0.0}; }

BeamSystem on_two_supports(bool with_shear) {
  std::vector<BeamPiece> pieces{piece(l1, d1), piece(b, d2), piece(l4, d1)};
  for (BeamPiece& p : pieces) (with_shear ? p.bending : p.shear) = 0.0;
  std::vector<BeamSupport> supports;
  for (const Vector3d& across : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY())}) {
    for (double at : {0.0, l}) supports.push_back({{at, across, Vector3d::Zero()}, 0.0});
  }
  supports.push_back({{0.0, Vector3d::UnitZ(), Vector3d::Zero()}, 0.0});
  supports.push_back({{0.0, Vector3d::Zero(), Vector3d::UnitZ()}, 0.0});  // the torque leaves at the first end
  return {pieces, supports};
}

/// Deflection at z under a unit force at z_f and the moment M_f there.
double beam_deflection(const BeamSystem& beam, double z, double z_f, double M_f) {
  const BeamLoad here{l1 + z, Vector3d::UnitX(), Vector3d::Zero()};
  const BeamLoad load{l1 + z_f, Vector3d::UnitX(), -M_f * Vector3d::UnitY()};  // raises the first end's reaction
  return beam.flexibility(std::vector{here}, std::vector{load})(0, 0);
}

struct Reactions {
  double F1, F2;
};
Reactions reactions(double z_f, double M_f) {
  const double F1 = ((l - z_f - l1) + M_f) / l;  // 2C.10
  return {F1, 1 - F1};                           // 2C.11
}

/// Eqs 2C.24 to 2C.26, upwards positive there. The last but one term of 2C.26 reads F_2 l_3^2/2 (2 l_4 + l_3) in print, which has one
/// power of l_3 too many for the support to stay in place; l_3 l_4 is meant.
double bending(double z, double z_f, double M_f) {
  const auto [F1, F2] = reactions(z_f, M_f);
  const double l2 = z_f, l3 = b - z_f, I1 = I(d1), I2 = I(d2);
  const double theta = -(F2 * std::pow(l4, 3) / 3 + F1 * l1 * l1 / 6 * (3 * l - 2 * l1)) / (l * E * I1) -
                       (F1 * l2 / 2 * (2 * l1 + l2) * (l3 + l4) + F1 * l2 * l2 / 6 * (3 * l1 + l2) + F2 * l3 * l4 / 2 * (2 * l4 + l3) +
                        F2 * l3 * l3 / 6 * (3 * l4 + 2 * l3)) /
                           (l * E * I2);
  double d = F1 * l1 * l1 / (6 * E * I1) * (3 * z + l1) + theta * (z + l1);
  if (z <= z_f) return d + F1 / (6 * E * I2) * z * z * (z + 3 * l1);
  d += F1 / (6 * E * I2) * (3 * l2 * (z - l2) * (2 * l1 + l2) + l2 * l2 * (l2 + 3 * l1));
  return d + F2 / (6 * E * I2) * std::pow(z - l2, 2) * (3 * l3 + 3 * l4 + l2 - z);
}

/// Eqs 2C.12 to 2C.23.
double shear(double z, double z_f, double M_f) {
  const auto [F1, F2] = reactions(z_f, M_f);
  const double g1 = slope(d1) * F1, g2 = slope(d2) * F1, g3 = -slope(d2) * F2, g4 = -slope(d1) * F2;
  const double at_right = g1 * l1 + g2 * z_f + g3 * (b - z_f) + g4 * l4, theta = -at_right / l;
  return z <= z_f ? g1 * l1 + g2 * z + theta * (z + l1) : g1 * l1 + g2 * z_f + g3 * (z - z_f) + theta * (z + l1);
}

TEST_CASE("Shaft bending and shear are those of Haddad's appendix 2C", "[core][compliance][shaft][reference]") {
  const BeamSystem bends = on_two_supports(false), shears = on_two_supports(true);
  for (const double z_f : {0.0, 37.0, 60.0, 120.0}) {
    for (const double M_f : {0.0, 25.0}) {
      for (const double z : {0.0, 20.0, 60.0, 95.0, 120.0}) {
        CAPTURE(z, z_f, M_f);
        CHECK(beam_deflection(bends, z, z_f, M_f) == Approx(-bending(z, z_f, M_f)).epsilon(kRoundOff));
        CHECK(beam_deflection(shears, z, z_f, 0.0) == Approx(shear(z, z_f, 0.0)).epsilon(kRoundOff));
        // A moment makes a couple of reactions but no shear jump: 2C.23's F_2 beyond the load is then F_1 - 1 as well.
        CHECK(beam_deflection(shears, z, z_f, M_f) == Approx(shear(z, z_f, M_f)).epsilon(kRoundOff));
      }
    }
  }
}

TEST_CASE("Shaft torsion is that of Haddad's appendix 2C, by one force and by a uniform load", "[core][compliance][shaft][reference]") {
  const BeamSystem beam = on_two_supports(false);
  const auto torque_at = [](double z) { return BeamLoad{l1 + z, Vector3d::Zero(), Vector3d::UnitZ()}; };
  for (const double z : {0.0, 30.0, 60.0, 90.0, 120.0}) {
    const double z_f = 60;
    const double turn = beam.flexibility(std::vector{torque_at(z)}, std::vector{torque_at(z_f)})(0, 0);
    CHECK(turn == Approx((l1 / J(d1) + std::min(z, z_f) / J(d2)) / G).epsilon(kRoundOff));  // 2C.2, 2C.3
    std::vector<BeamLoad> uniform;
    for (double at = 5; at < b; at += 10) uniform.push_back(torque_at(at));  // exact: z is at a border
    const double mean = beam.flexibility(std::vector{torque_at(z)}, uniform).mean();
    CHECK(mean == Approx((l1 / J(d1) + z * (2 * b - z) / (2 * b * J(d2))) / G).epsilon(kRoundOff));
  }
}

}  // namespace haddad_2c
