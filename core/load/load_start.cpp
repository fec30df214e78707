#include "core/load/load_start.hpp"

#include <algorithm>

namespace flankwright {

namespace {

/// Positions that are extrapolated from.
constexpr std::size_t history = 3;

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
