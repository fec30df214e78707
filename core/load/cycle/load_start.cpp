#include "core/load/cycle/load_start.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

/// Largest step to extrapolate over, as a multiple of the one before.
constexpr double farthest = 2.0;

/// Points [begin, end) of one tooth pair's line; [core_begin, core_end) of them between A and E, where the clearance is 0. Where none is
/// the core is an empty one at the end that comes nearest to it.
struct ToothLine {
  std::ptrdiff_t begin, core_begin, core_end, end;
};

ToothLine line_from(const std::vector<ContactPoint>& points, std::size_t begin) {
  const auto first = points.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto end = std::find_if(first, points.end(), [&](const ContactPoint& p) { return p.tooth != first->tooth; });
  const auto in_core = [](const ContactPoint& p) { return p.clearance == 0.0; };
  auto core_begin = std::find_if(first, end, in_core);
  auto core_end = std::find_if_not(core_begin, end, in_core);
  if (core_begin == end && first->clearance < (end - 1)->clearance) core_begin = core_end = first;
  return {first - points.begin(), core_begin - points.begin(), core_end - points.begin(), end - points.begin()};
}

/// Matches what is before A, between A and E and beyond by counting from A or E.
void match_by_count(const ToothLine& from, const ToothLine& to, std::vector<Eigen::Index>& found) {
  const auto match = [&](std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t offset, std::ptrdiff_t least, std::ptrdiff_t limit) {
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      if (i + offset >= least && i + offset < limit) found[static_cast<std::size_t>(i)] = i + offset;
    }
  };
  const std::ptrdiff_t first = from.core_begin - to.core_begin, last = from.core_end - to.core_end;
  match(to.begin, to.core_begin, first, from.begin, from.core_begin);
  match(to.core_begin, to.core_end, first, from.core_begin, from.core_end);
  match(to.core_end, to.end, last, from.core_end, from.end);
}

}  // namespace

std::vector<Eigen::Index> corresponding_points(const MeshPosition& from, const MeshPosition& to) {
  std::vector<Eigen::Index> found(to.points.size(), -1);
  std::size_t j = 0;
  for (std::size_t i = 0; i < to.points.size();) {
    const ToothLine here = line_from(to.points, i);
    i = static_cast<std::size_t>(here.end);
    const int tooth = to.points[i - 1].tooth;
    while (j < from.points.size() && from.points[j].tooth < tooth) ++j;
    if (j == from.points.size() || from.points[j].tooth != tooth) continue;
    const ToothLine there = line_from(from.points, j);
    bool same_places = false;
    for (std::ptrdiff_t k = here.begin, l = there.begin; k < here.end && l < there.end;) {
      const double z = to.points[static_cast<std::size_t>(k)].z, other = from.points[static_cast<std::size_t>(l)].z;
      if (z == other) {
        found[static_cast<std::size_t>(k)] = l;
        same_places = true;
      }
      k += z <= other;
      l += other <= z;
    }
    if (!same_places) match_by_count(there, here, found);
  }
  return found;
}

Eigen::VectorXd starting_loads(const MeshModel& model, const LoadedCycle& cycle, std::size_t i, const LoadedCycle* earlier) {
  const auto loads_of = [](const LoadedCycle& of, std::size_t k) -> const Eigen::VectorXd& { return of.positions[k].load.line_load; };
  const auto solved = [](const LoadedCycle& of, std::size_t k) { return of.positions[k].load.usable(); };
  const Eigen::Index n = std::ssize(model.positions[i].points);
  const bool follows =
      earlier != nullptr && earlier->positions.size() == model.positions.size() && solved(*earlier, i) && loads_of(*earlier, i).size() == n;
  const auto known = [&](std::size_t back) { return i >= back && solved(cycle, i - back) && (!follows || solved(*earlier, i - back)); };
  if (!known(1)) return follows ? loads_of(*earlier, i) : Eigen::VectorXd();

  // Loads, or their change, of so many positions before, at the points of this one; quiet NaN where it has no such
  // point.
  const auto carried = [&](std::size_t back) {
    Eigen::VectorXd change = loads_of(cycle, i - back);
    if (follows) change -= loads_of(*earlier, i - back);
    const std::vector<Eigen::Index> at = corresponding_points(model.positions[i - back], model.positions[i]);
    return Eigen::VectorXd::NullaryExpr(n,
                                        [&](Eigen::Index j) {
                                          const Eigen::Index k = at[static_cast<std::size_t>(j)];
                                          return k < 0 ? not_given : change[k];
                                        })
        .eval();
  };
  const Eigen::VectorXd last = carried(1);
  const Eigen::VectorXd before = known(2) ? carried(2) : last;
  const auto phase = [&](std::size_t back) { return model.positions[i - back].phase; };
  const double between = known(2) ? phase(1) - phase(2) : 0.0;
  const double further = between > 0.0 ? std::clamp((phase(0) - phase(1)) / between, -farthest, farthest) : 0.0;
  Eigen::VectorXd start = follows ? loads_of(*earlier, i) : Eigen::VectorXd::Zero(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    if (std::isnan(last[j])) continue;
    start[j] += last[j] + (std::isnan(before[j]) ? 0.0 : further * (last[j] - before[j]));
  }
  return start.cwiseMax(0.0);
}

}  // namespace flankwright
