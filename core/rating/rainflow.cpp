#include "core/rating/rainflow.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

/// First and last value, and those where the direction changes.
std::vector<double> turning_points(const std::vector<double>& values) {
  std::vector<double> points;
  for (const double value : values) {
    if (!points.empty() && value == points.back()) continue;
    const std::size_t n = points.size();
    const bool goes_on = n >= 2 && (points[n - 1] > points[n - 2]) == (value > points[n - 1]);
    if (goes_on) points.pop_back();
    points.push_back(value);
  }
  return points;
}

RainflowCycle cycle_between(double a, double b, double count) { return {std::abs(a - b), 0.5 * (a + b), count}; }

}  // namespace

std::vector<RainflowCycle> rainflow(const std::vector<double>& values) {
  std::vector<RainflowCycle> cycles;
  std::vector<double> open;  // turning points that belong to no cycle yet, from `first` on
  std::size_t first = 0;
  for (const double point : turning_points(values)) {
    open.push_back(point);
    while (open.size() - first >= 3) {
      const std::size_t n = open.size();
      const double X = std::abs(open[n - 1] - open[n - 2]), Y = std::abs(open[n - 2] - open[n - 3]);
      if (X < Y) break;
      if (n - first == 3) {  // Y contains the start
        cycles.push_back(cycle_between(open[n - 3], open[n - 2], 0.5));
        ++first;
      } else {
        cycles.push_back(cycle_between(open[n - 3], open[n - 2], 1.0));
        open.erase(open.end() - 3, open.end() - 1);
      }
    }
  }
  for (std::size_t i = first; i + 1 < open.size(); ++i) cycles.push_back(cycle_between(open[i], open[i + 1], 0.5));
  return cycles;
}

std::vector<RainflowCycle> repeating_rainflow(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto largest = std::ranges::max_element(values);
  std::vector<double> round(largest, values.end());
  round.insert(round.end(), values.begin(), largest + 1);
  return rainflow(round);
}

}  // namespace flankwright
