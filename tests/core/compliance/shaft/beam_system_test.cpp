#include "core/compliance/shaft/beam_system.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/common/random.hpp"
#include "tests/reference/eigenvalues.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using Eigen::Vector3d;

namespace beam_cases {

constexpr double kBeamRoundOff = 1e-12;  // of the clamped beam's values, of which some closed forms are a fiftieth

const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ(), none = Vector3d::Zero();

// 1/(E I), 1/(kappa G A), 1/(G I_p), 1/(E A) of a shaft of about 40 mm.
constexpr double EI = 2.6e10, kGA = 9e7, GJ = 2e10, EA = 2.6e8, L = 300;
BeamPiece uniform_piece(double length, double shear = 1 / kGA) { return {length, 1 / EI, shear, 1 / GJ, 1 / EA}; }
BeamPiece slender(double length) { return uniform_piece(length, 0.0); }

void hold(std::vector<BeamSupport>& supports, double at, std::initializer_list<Vector3d> forces, std::initializer_list<Vector3d> moments = {},
          double compliance = 0.0) {
  for (const Vector3d& f : forces) supports.push_back({{at, f, none}, compliance});
  for (const Vector3d& m : moments) supports.push_back({{at, none, m}, compliance});
}

std::vector<BeamSupport> clamp(double at = 0.0) {
  std::vector<BeamSupport> supports;
  hold(supports, at, {x, y, z}, {x, y, z});
  return supports;
}

/// Held radially at both places, axially and against turning at the first.
std::vector<BeamSupport> two_bearings(double first = 0.0, double second = L) {
  std::vector<BeamSupport> supports;
  hold(supports, first, {x, y, z}, {z});
  hold(supports, second, {x, y});
  return supports;
}

double between(const BeamSystem& beam, const BeamLoad& one, const BeamLoad& other) {
  return beam.flexibility(std::vector{one}, std::vector{other})(0, 0);
}

Approx near(double value) { return Approx(value).epsilon(kBeamRoundOff).margin(1e-20); }

TEST_CASE("A clamped shaft bends, shears, twists and stretches as textbooks say", "[core][compliance][shaft][closed-form]") {
  const BeamSystem beam({uniform_piece(L)}, clamp(GENERATE(0.0, L)));
  const bool from_start = between(beam, {0, x, none}, {0, x, none}) < 1e-15;
  const double free = from_start ? L : 0.0, along = from_start ? 1.0 : -1.0;  // z away from the clamp
  CHECK(between(beam, {free, x, none}, {free, x, none}) == near(L * L * L / (3 * EI) + L / kGA));
  CHECK(between(beam, {free, none, y}, {free, none, y}) == near(L / EI));
  // A force along x turns the end about +y where z leads away from the clamp.
  CHECK(between(beam, {free, none, y}, {free, x, none}) == near(along * L * L / (2 * EI)));
  CHECK(between(beam, {free, none, x}, {free, y, none}) == near(-along * L * L / (2 * EI)));
  CHECK(between(beam, {free, none, z}, {free, none, z}) == near(L / GJ));
  CHECK(between(beam, {free, z, none}, {free, z, none}) == near(L / EA));
  // Half way, by the load at the end, and nothing across.
  CHECK(between(beam, {L / 2, y, none}, {free, y, none}) == near(5 * L * L * L / (48 * EI) + L / (2 * kGA)));
  CHECK(between(beam, {L / 2, none, z}, {free, none, z}) == near(L / (2 * GJ)));
  CHECK(between(beam, {free, x, none}, {free, y, none}) == 0.0);
}

TEST_CASE("A shaft on two bearings sags as a simply supported beam, overhangs included", "[core][compliance][shaft][closed-form]") {
  const BeamSystem beam({uniform_piece(L)}, two_bearings());
  for (const double a : {20.0, 150.0, 220.0}) {
    const double b = L - a;
    CAPTURE(a);
    CHECK(between(beam, {a, x, none}, {a, x, none}) == near(a * a * b * b / (3 * EI * L) + a * b / (L * kGA)));
  }
  CHECK(between(beam, {0, x, none}, {100, x, none}) == tests::about(0.0, kBeamRoundOff * L * L * L / EI));
  // A moment in the middle turns it by M L/(12 E I) and shears both halves by M/L.
  CHECK(between(beam, {L / 2, none, y}, {L / 2, none, y}) == near(L / (12 * EI) + 1 / (L * kGA)));

  // Overhang c beyond bearings a distance l apart: P c^2 (l + c)/(3 E I).
  const double c = 80, l = L - c;
  const BeamSystem overhung({slender(L)}, two_bearings(0, l));
  CHECK(between(overhung, {L, y, none}, {L, y, none}) == near(c * c * (l + c) / (3 * EI)));
}

TEST_CASE("Supports in excess share the load by their stiffness", "[core][compliance][shaft][closed-form]") {
  SECTION("two equal spans, load in the middle of one") {
    std::vector<BeamSupport> three = two_bearings();
    hold(three, L / 2, {x, y});
    const double span = L / 2;
    const BeamSystem beam({slender(L)}, three);
    CHECK(between(beam, {span / 2, x, none}, {span / 2, x, none}) == near(23 * span * span * span / (1536 * EI)));
  }
  SECTION("both ends clamped") {
    std::vector<BeamSupport> both = clamp();
    hold(both, L, {x, y}, {x, y});
    const BeamSystem beam({slender(L)}, both);
    CHECK(between(beam, {L / 2, x, none}, {L / 2, x, none}) == near(L * L * L / (192 * EI)));
  }
  SECTION("a rigid shaft on springs tips over as a lever") {
    const double k = 5e5;
    std::vector<BeamSupport> springs;
    hold(springs, 50, {x, y}, {}, 1 / k);
    hold(springs, 250, {x, y}, {}, 1 / k);
    hold(springs, 50, {z}, {z});
    const BeamSystem beam({{L, 0, 0, 0, 0}}, springs);
    // At 200: reactions 1/4 and 3/4.
    CHECK(between(beam, {200, y, none}, {200, y, none}) == near((1.0 / 16 + 9.0 / 16) / k));
    CHECK(between(beam, {50, y, none}, {200, y, none}) == near(0.25 / k));
  }
}

TEST_CASE("A support as soft as none leaves a shaft to the others", "[core][compliance][shaft]") {
  const double softness = GENERATE(1e3, 1e12, 1e100);  // mm/N, and by the shaft's length and square of it where it holds a turn
  const BeamSystem alone({uniform_piece(L)}, two_bearings());
  std::vector<BeamSupport> supports = two_bearings();
  hold(supports, 0.0, {}, {x, y}, softness);
  hold(supports, 0.3 * L, {x}, {}, softness);
  const BeamSystem beside({uniform_piece(L)}, supports);
  const BeamLoad load{0.7 * L, x + y, none};
  const double own = between(alone, load, load);
  // The soft supports take their share of the load, below own / softness.
  CHECK(between(beside, load, load) == Approx(own).epsilon(kBeamRoundOff + L * L * own / softness));
  const Eigen::MatrixXd forces = beside.reactions(std::vector{load});
  const Eigen::MatrixXd expected = alone.reactions(std::vector{load});
  CHECK((forces.topRows(expected.rows()) - expected).cwiseAbs().maxCoeff() <= kBeamRoundOff + L * L * own / softness);
}

TEST_CASE("Loads that act together are the sum of their parts", "[core][compliance][shaft]") {
  const BeamSystem beam({uniform_piece(100), slender(80), uniform_piece(120)}, two_bearings(30, 280));
  const std::vector<BeamLoad> parts{{40, {1, -2, 0.3}, none}, {90, none, {20, 5, 0}}, {150, none, {0, 0, 8}},
                                    {200, {0.2, 1, 1}, none}, {90, none, {-7, 2, 0}}, {150, none, {0, 0, -3}}};
  const Eigen::MatrixXd each = beam.flexibility(parts), together = beam.flexibility(parts, 3);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) CHECK(together(i, j) == near(each.block<3, 3>(3 * i, 3 * j).sum()));
  }
}

TEST_CASE("Any shaft's flexibility is symmetric, does no negative work and does not depend on where it is cut", "[core][compliance][shaft]") {
  tests::Random32 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<BeamPiece> pieces, cut;
    double length = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double s = std::pow(10.0, random(-1.0, 1.0));
      const BeamPiece one{random(10, 120), s * s / EI, s / kGA, s * s / GJ, s / EA};
      pieces.push_back(one);
      for (double share : {0.3, 0.7}) {
        cut.push_back(one);
        cut.back().length *= share;
      }
      length += one.length;
    }
    std::vector<BeamSupport> supports;
    hold(supports, random(0, 0.3 * length), {x, y}, {}, random(0, 1e-6));
    hold(supports, random(0.35 * length, 0.6 * length), {x, y, z}, {x, y}, random(1e-9, 1e-6));
    hold(supports, random(0.65 * length, length), {x, y}, {z});
    const BeamSystem beam(pieces, supports), same(cut, supports);
    std::vector<BeamLoad> loads;
    for (int i = 0; i < 20; ++i) {
      const auto any = [&](double size) { return Vector3d(random(-size, size), random(-size, size), random(-size, size)); };
      loads.push_back({random(0, length), any(1), any(100)});
    }
    const Eigen::MatrixXd K = beam.flexibility(loads);
    CHECK(K == K.transpose());
    const Eigen::MatrixXd raw = beam.flexibility(loads, loads);
    const Eigen::VectorXd values = symmetric_eigenvalues(K);
    CHECK((raw - raw.transpose()).norm() < 1e-11 * K.norm());        // round-off
    CHECK(values.minCoeff() > -1e-11 * values.maxCoeff());           // round-off
    CHECK((same.flexibility(loads) - K).norm() < 1e-11 * K.norm());  // round-off
  }
}

}  // namespace beam_cases
