#include "core/compliance/shaft/beam_system.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace flankwright;
using Eigen::Vector3d;

namespace {

constexpr double unit_round_off = 1e-9;  // closed forms against closed forms, of a 1 kN load on a 400 mm shaft
constexpr double unit_E = 206000, unit_I = 6.0e5, unit_A = 2800, unit_G = 79231, unit_kappa = 0.9;

BeamPiece unit_piece(double length, bool with_shear) {
  return {length, 1 / (unit_E * unit_I), with_shear ? 1 / (unit_kappa * unit_G * unit_A) : 0.0, 1 / (unit_G * 2 * unit_I), 1 / (unit_E * unit_A)};
}

BeamLoad force_y(double z, double size = 1.0, int beam = 0) { return {z, size * Vector3d::UnitY(), Vector3d::Zero(), beam}; }
BeamLoad moment_x(double z, double size = 1.0) { return {z, Vector3d::Zero(), size * Vector3d::UnitX()}; }

/// Rigid across x and y at these places, and what holds the rest.
std::vector<BeamSupport> unit_supports(std::initializer_list<double> places, int beam = 0) {
  std::vector<BeamSupport> all;
  for (const double z : places) {
    all.push_back({{z, Vector3d::UnitX(), Vector3d::Zero(), beam}});
    all.push_back({{z, Vector3d::UnitY(), Vector3d::Zero(), beam}});
  }
  all.push_back({{0, Vector3d::UnitZ(), Vector3d::Zero(), beam}});
  all.push_back({{0, Vector3d::Zero(), Vector3d::UnitZ(), beam}});
  return all;
}

double moved(const BeamSystem& beam, const BeamLoad& at, const BeamLoad& load) { return beam.flexibility(std::vector{at}, std::vector{load})(0, 0); }

}  // namespace

TEST_CASE("A cantilever deflects and slopes as in closed form, with its part of shear", "[core][compliance][shaft][closed-form]") {
  const double L = 400, F = 1000;
  std::vector<BeamSupport> clamp = unit_supports({0});
  clamp.push_back({moment_x(0)});
  clamp.push_back({{0, Vector3d::Zero(), Vector3d::UnitY()}});
  for (const bool with_shear : {false, true}) {
    const BeamSystem beam({unit_piece(150, with_shear), unit_piece(250, with_shear)}, clamp);
    const double shear = with_shear ? F * L / (unit_kappa * unit_G * unit_A) : 0.0;
    CHECK(moved(beam, force_y(L), force_y(L, F)) == Approx(F * L * L * L / (3 * unit_E * unit_I) + shear).epsilon(unit_round_off));
    // A force along y turns the end about -x.
    CHECK(moved(beam, moment_x(L), force_y(L, F)) == Approx(-F * L * L / (2 * unit_E * unit_I)).epsilon(unit_round_off));
  }
}

TEST_CASE("A shaft on two supports with an overhang deflects as in closed form", "[core][compliance][shaft][closed-form]") {
  const double L = 300, a = 100, F = 1000;
  for (const bool with_shear : {false, true}) {
    const BeamSystem beam({unit_piece(L, with_shear), unit_piece(a, with_shear)}, unit_supports({0, L}));
    // Bending F a^2 (L + a)/(3 E I) at the overhanging load; shear of the force F on a and of F a/L on L.
    const double shear = with_shear ? (F * a + F * a / L * a) / (unit_kappa * unit_G * unit_A) : 0.0;
    CHECK(moved(beam, force_y(L + a), force_y(L + a, F)) == Approx(F * a * a * (L + a) / (3 * unit_E * unit_I) + shear).epsilon(unit_round_off));
    const Eigen::VectorXd reactions = beam.reactions(std::vector{force_y(L + a, F)}).col(0);
    CHECK(reactions[1] == Approx(F * a / L).epsilon(unit_round_off));
    CHECK(reactions[3] == Approx(-F * (L + a) / L).epsilon(unit_round_off));
  }
}

TEST_CASE("A shaft on three bearings shares its load as in closed form", "[core][compliance][shaft][closed-form]") {
  // Two equal fields, the load in the middle of the first: 13/32, 22/32 and -3/32 of it [three-moment equation].
  const double L = 200, F = 1000;
  const BeamSystem beam({unit_piece(2 * L, false)}, unit_supports({0, L, 2 * L}));
  const Eigen::VectorXd reactions = -beam.reactions(std::vector{force_y(L / 2, F)}).col(0);
  CHECK(reactions[1] == Approx(13.0 / 32 * F).epsilon(unit_round_off));
  CHECK(reactions[3] == Approx(22.0 / 32 * F).epsilon(unit_round_off));
  CHECK(reactions[5] == Approx(-3.0 / 32 * F).epsilon(unit_round_off));
}

TEST_CASE("A bearing between two shafts carries what a spring between two beams does", "[core][compliance][shaft][closed-form]") {
  const double L = 300, F = 1000, k = 2e5, c = L * L * L / (48 * unit_E * unit_I);
  std::vector<BeamSupport> supports = unit_supports({0, L}, 0);
  for (const BeamSupport& of_other : unit_supports({0, L}, 1)) supports.push_back(of_other);
  for (const Vector3d& across : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY())}) {
    supports.push_back({{L / 2, across, Vector3d::Zero(), 0}, 1 / k, BeamLoad{L / 2, across, Vector3d::Zero(), 1}});
  }
  const std::vector<BeamPiece> beam{unit_piece(L, false)};
  const BeamSystem both({beam, beam}, supports);
  // Two equal beams, joined at their middles by a spring: c (F - s) = c s + s/k.
  const double s = F * c / (2 * c + 1 / k);
  CHECK(moved(both, force_y(L / 2), force_y(L / 2, F)) == Approx(c * (F - s)).epsilon(unit_round_off));
  CHECK(moved(both, force_y(L / 2, 1.0, 1), force_y(L / 2, F)) == Approx(c * s).epsilon(unit_round_off));
  CHECK(both.reactions(std::vector{force_y(L / 2, F)})(std::ssize(supports) - 1, 0) == Approx(-s).epsilon(unit_round_off));
}

TEST_CASE("A housing adds its compliance between the seats", "[core][compliance][shaft][closed-form]") {
  // Forces at the supports of a statically determinate shaft are known: what the housing adds is s'H s.
  const double L = 300, F = 1000;
  const std::vector<BeamSupport> supports = unit_supports({0, L});
  Eigen::MatrixXd housing = Eigen::MatrixXd::Zero(6, 6);
  housing(1, 1) = 3e-6;
  housing(3, 3) = 5e-6;
  housing(1, 3) = housing(3, 1) = -1e-6;
  const BeamSystem rigid_seats(std::vector{unit_piece(L, true)}, supports),
      seats(std::vector<std::vector<BeamPiece>>{{unit_piece(L, true)}}, supports, housing);
  const double z = 100, left = (L - z) / L, right = z / L;
  const double added = F * (left * left * 3e-6 + right * right * 5e-6 - 2 * left * right * 1e-6);
  CHECK(moved(seats, force_y(z), force_y(z, F)) - moved(rigid_seats, force_y(z), force_y(z, F)) == Approx(added).epsilon(1e-8));
}

TEST_CASE("A displacement forced on supports moves the beam as their forces say", "[core][compliance][shaft]") {
  const double L = 400;
  const BeamSystem beam({unit_piece(L, true)}, unit_supports({0, L / 2, L}));
  // The middle support is pushed by v: the beam follows it there, with N v as the force.
  const double v = 0.02;
  const Eigen::MatrixXd stiffness = beam.prestrain_stiffness();
  CHECK(-beam.reactions(std::vector{force_y(L / 2)})(3, 0) * v == Approx(v).epsilon(unit_round_off));
  const double field = L / 2, bending = field * field * field / (6 * unit_E * unit_I), shear = field / (2 * unit_kappa * unit_G * unit_A);
  CHECK(stiffness(3, 3) == Approx(1 / (bending + shear)).epsilon(unit_round_off));  // two fields side by side
  CHECK(stiffness(1, 3) == Approx(-0.5 * stiffness(3, 3)).epsilon(unit_round_off));
}

TEST_CASE("A shaft that can move is found, with the motion that it can make", "[core][compliance][shaft]") {
  std::vector<BeamSupport> held = unit_supports({0, 100});
  CHECK_FALSE(find_loose_motion({200}, held));
  std::vector<BeamSupport> slides = held;
  slides.erase(slides.begin() + 4);
  CHECK(std::abs(find_loose_motion({200}, slides)->translation.z()) == 1.0);
  std::vector<BeamSupport> turns = held;
  turns.pop_back();
  CHECK(std::abs(find_loose_motion({200}, turns)->turn.z()) == 1.0);
  CHECK(find_loose_motion({200}, unit_supports({0})));
  CHECK(find_loose_motion({200, 200}, held)->beam == 1);
}
