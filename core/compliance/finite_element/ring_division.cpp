#include "core/compliance/finite_element/ring_division.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright {
namespace {

constexpr double kRoundOff = 1e-9;  // of angles from different sums [rad]

/// Largest ratio of the lengths of two neighbours that are joined. Their corner becomes the mid-side of a quadratic
/// element, whose Jacobian is positive below 3.
constexpr double kMostUnlike = 2;

bool same_angle(double a, double b) { return std::abs(std::remainder(a - b, 2 * units::pi)) < kRoundOff; }

}  // namespace

double RingDivision::angle(int index) const {
  const auto n = static_cast<int>(angles.size());
  const int turns = index >= 0 ? index / n : -((n - 1 - index) / n);
  return angles[static_cast<std::size_t>(index - turns * n)] + turns * 2 * units::pi;
}

JoinedRing join_neighbours(const RingDivision& outer, double longest, const std::vector<double>& kept) {
  const int n = outer.elements(), half = n / 2;
  int start = 0;  // the corner nearest to angle 0
  for (int i = 0; i < n; ++i) {
    if (std::abs(std::remainder(outer.angles[static_cast<std::size_t>(2 * i)], 2 * units::pi)) <
        std::abs(std::remainder(outer.angles[static_cast<std::size_t>(2 * start)], 2 * units::pi))) {
      start = i;
    }
  }
  std::vector<char> joined(outer.angles.size() / 2, 0);  // of every corner
  const auto join_outwards = [&](int side) {
    for (int i = 0; i + 1 < half; ++i) {
      const int corner = start + side * (i + 1);
      const double here = outer.angle(2 * corner), before = here - outer.angle(2 * corner - 2), after = outer.angle(2 * corner + 2) - here;
      const bool stays = std::ranges::any_of(kept, [&](double angle) { return same_angle(angle, here); });
      if (stays || before + after > longest + kRoundOff || std::max(before, after) > kMostUnlike * std::min(before, after)) continue;
      joined[static_cast<std::size_t>(((corner % n) + n) % n)] = 1;
      ++i;  // the next one has been joined
    }
  };
  join_outwards(1);
  join_outwards(-1);

  JoinedRing result;
  std::vector<int> corners;
  for (int i = 0; i < n; ++i) {
    if (joined[static_cast<std::size_t>(i)]) {
      result.joints.push_back(2 * i);
    } else {
      corners.push_back(2 * i);
    }
  }
  for (const int corner : corners) {
    const int next = corner / 2 + 1;
    const bool is_joint = joined[static_cast<std::size_t>(next % n)];
    result.division.angles.push_back(outer.angle(corner));
    result.division.angles.push_back(outer.angle(is_joint ? corner + 2 : corner + 1));
  }
  return result;
}

}  // namespace flankwright
