#include "core/compliance/finite_element/ring_division.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/units.hpp"

using namespace flankwright;
using units::pi;

namespace {

/// n equal elements from an angle on.
RingDivision even(int n, double first) {
  RingDivision ring;
  for (int i = 0; i < 2 * n; ++i) ring.angles.push_back(first + pi * i / n);
  return ring;
}

bool has_corner(const RingDivision& ring, double angle) {
  for (int i = 0; i < ring.elements(); ++i) {
    if (std::abs(std::remainder(ring.angle(2 * i) - angle, 2 * pi)) < 1e-9) return true;  // round-off of sums of angles
  }
  return false;
}

double length(const RingDivision& ring, int element) { return ring.angle(2 * element + 2) - ring.angle(2 * element); }

}  // namespace

TEST_CASE("A ring's joined elements fill the turn, are as long as they may be and have the corner between for their mid-side",
          "[core][compliance][fe]") {
  const int n = GENERATE(12, 13, 40);
  const RingDivision outer = even(n, -0.7);
  const JoinedRing joined = join_neighbours(outer, 4 * pi / n, {});
  CHECK(joined.division.elements() == n - std::ssize(joined.joints));
  CHECK(joined.division.elements() <= n / 2 + 2);  // one of an odd number, and one on either side of the last, stay as they are
  double turn = 0;
  for (int i = 0; i < joined.division.elements(); ++i) {
    const double here = length(joined.division, i);
    CHECK(here <= 4 * pi / n + 1e-9);
    CHECK(std::abs(joined.division.angle(2 * i + 1) - (joined.division.angle(2 * i) + here / 2)) < 1e-9);  // even ones, joined or not
    turn += here;
  }
  CHECK(turn == Approx(2 * pi).epsilon(1e-9));  // round-off of sums of angles
  for (const int joint : joined.joints) CHECK(!has_corner(joined.division, outer.angle(joint)));
}

TEST_CASE("Elements too long together, too unlike, or parted by a corner that stays are not joined", "[core][compliance][fe]") {
  CHECK(join_neighbours(even(12, 0), 3.9 * pi / 12, {}).joints.empty());
  const RingDivision outer = even(12, 0);
  std::vector<double> corners;
  for (int i = 0; i < 12; ++i) corners.push_back(outer.angle(2 * i));
  CHECK(join_neighbours(outer, pi, corners).joints.empty());
  CHECK(has_corner(join_neighbours(outer, pi, {corners[1]}).division, corners[1] + 2 * pi));

  RingDivision unlike;  // 1 : 3, in turn
  for (int i = 0; i < 8; ++i) {
    for (const double share : {0.0, 0.125, 0.25, 0.625}) unlike.angles.push_back((i + share) * pi / 4);
  }
  CHECK(join_neighbours(unlike, pi, {}).joints.empty());
}

TEST_CASE("Rings that are alike on both sides of the first tooth stay so", "[core][compliance][fe]") {
  RingDivision outer;  // finer around angle 0
  for (double angle = -0.4; angle < 0.39; angle += 0.05) outer.angles.push_back(angle);
  const int coarse = 21;
  for (int i = 0; i < 2 * coarse; ++i) outer.angles.push_back(0.4 + (2 * pi - 0.8) * i / (2 * coarse));
  RingDivision ring = outer;
  for (const double longest : {0.2, 0.4}) ring = join_neighbours(ring, longest, {}).division;
  CHECK(ring.elements() < outer.elements());
  for (int i = 0; i < ring.elements(); ++i) CHECK(has_corner(ring, -ring.angle(2 * i)));
}
