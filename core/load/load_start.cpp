#include "core/load/load_start.hpp"

#include <algorithm>

namespace flankwright {

namespace {

/// Positions that are extrapolated from.
constexpr std::size_t history = 3;

/// Points [begin, end) of one tooth pair's line; [core_begin, core_end) of them between A and E.
struct ToothLine {
  std::size_t begin, end, core_begin, core_end;

  bool has_core() const { return core_begin < core_end; }
};

ToothLine line_from(const std::vector<ContactPoint>& points, std::size_t begin) {
  ToothLine line{begin, begin, begin, begin};
  for (; line.end < points.size() && points[line.end].tooth == points[begin].tooth; ++line.end) {
    if (points[line.end].clearance != 0.0) continue;
    if (!line.has_core()) line.core_begin = line.end;
    line.core_end = line.end + 1;
  }
  return line;
}

/// What is counted from either end of the core, or from the line's own start where one of both has none.
void match_by_count(const ToothLine& from, const ToothLine& to, std::vector<Eigen::Index>& found) {
  const bool by_core = from.has_core() && to.has_core();
  const auto offset = [](std::size_t a, std::size_t b) { return static_cast<std::ptrdiff_t>(a) - static_cast<std::ptrdiff_t>(b); };
  const std::ptrdiff_t first = by_core ? offset(from.core_begin, to.core_begin) : offset(from.begin, to.begin);
  const std::ptrdiff_t last = by_core ? offset(from.core_end, to.core_end) : first;
  for (std::size_t i = to.begin; i < to.end; ++i) {
    const bool beyond = by_core && i >= to.core_end;
    const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(i) + (beyond ? last : first);
    if (j >= static_cast<std::ptrdiff_t>(from.begin) && j < static_cast<std::ptrdiff_t>(from.end)) found[i] = j;
  }
}

}  // namespace

std::vector<Eigen::Index> corresponding_points(const MeshPosition& from, const MeshPosition& to) {
  std::vector<Eigen::Index> found(to.points.size(), -1);
  std::size_t j = 0;
  for (std::size_t i = 0; i < to.points.size();) {
    const ToothLine here = line_from(to.points, i);
    i = here.end;
    while (j < from.points.size() && from.points[j].tooth < to.points[here.begin].tooth) ++j;
    if (j == from.points.size() || from.points[j].tooth != to.points[here.begin].tooth) continue;
    const ToothLine there = line_from(from.points, j);
    bool same_places = false;
    for (std::size_t k = here.begin, l = there.begin; k < here.end && l < there.end;) {
      const double z = to.points[k].z, other = from.points[l].z;
      if (z == other) {
        found[k] = static_cast<Eigen::Index>(l);
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
  const bool follows = earlier != nullptr && earlier->positions.size() == model.positions.size() && solved(*earlier, i) &&
                       loads_of(*earlier, i).size() == std::ssize(model.positions[i].points);
  std::size_t known = 0;
  while (known < std::min(i, history) && solved(cycle, i - 1 - known) && (!follows || solved(*earlier, i - 1 - known))) ++known;
  if (known == 0) return follows ? loads_of(*earlier, i) : Eigen::VectorXd();

  std::vector<Eigen::VectorXd> change(known);      // of the k-th position before
  std::vector<std::vector<Eigen::Index>> at(known);  // where it has point j
  for (std::size_t k = 0; k < known; ++k) {
    change[k] = loads_of(cycle, i - 1 - k);
    if (follows) change[k] -= loads_of(*earlier, i - 1 - k);
    at[k] = corresponding_points(model.positions[i - 1 - k], model.positions[i]);
  }
  // Lagrange's weights at this phase for the 1, 2 or 3 positions before.
  double weights[history][history];
  for (std::size_t count = 1; count <= known; ++count) {
    for (std::size_t k = 0; k < count; ++k) {
      double& weight = weights[count - 1][k] = 1.0;
      for (std::size_t l = 0; l < count; ++l) {
        const auto phase = [&](std::size_t back) { return model.positions[i - 1 - back].phase; };
        if (l != k) weight *= (model.positions[i].phase - phase(l)) / (phase(k) - phase(l));
      }
    }
  }
  Eigen::VectorXd start = follows ? loads_of(*earlier, i) : Eigen::VectorXd::Zero(std::ssize(model.positions[i].points));
  for (Eigen::Index j = 0; j < start.size(); ++j) {
    const auto point = static_cast<std::size_t>(j);
    std::size_t count = 0;
    while (count < known && at[count][point] >= 0) ++count;
    for (std::size_t k = 0; k < count; ++k) start[j] += weights[count - 1][k] * change[k][at[k][point]];
  }
  return start.cwiseMax(0.0);
}

}  // namespace flankwright
