#include "core/fidelity/cycle_extremes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace flankwright {

namespace {

constexpr std::size_t curves = 4;  ///< transmission error, the same turned over, contact stress, line load
using Values = std::array<double, curves>;

Values values_of(const LoadedPosition& position) {
  const double te = position.load.transmission_error;
  return {te, -te, position.contact_stress.maxCoeff(), position.load.line_load.maxCoeff()};
}

/// The possible rise of a curve within an interval, and its phase [base pitches].
struct Promise {
  double height{-std::numeric_limits<double>::infinity()}, phase{not_given};
};

/// Intervals shorter than this are not divided [base pitches]: a rise within is a jump.
constexpr double shortest = 1e-4;
/// A probe lies at one of the divisions of its interval into so many parts: not near either end, because secants of a short and a long interval are
/// not alike, and where searches of other conditions have probed as well, which have kinks at the same phases: their meshes can be used again.
constexpr int parts = 8;

using Sample = std::pair<double, double>;  ///< phase and value

/// The top of the parabola through three samples, value and phase; nothing above them where it opens upwards.
std::pair<double, double> vertex(const Sample& a, const Sample& b, const Sample& c) {
  const double before = (b.second - a.second) / (b.first - a.first), after = (c.second - b.second) / (c.first - b.first);
  const double curvature = 2.0 * (after - before) / (c.first - a.first);
  if (!(curvature < 0.0)) return {-std::numeric_limits<double>::infinity(), b.first};
  const double slope = before + 0.5 * curvature * (b.first - a.first), step = -slope / curvature;  // at b
  return {b.second + 0.5 * slope * step, b.first + step};
}

class Search {
 public:
  Search(const MeshAt& mesh_at, const FlankCondition& condition, double torque, const LoadedCycle& cycle, const ExtremeSearch& settings)
      : mesh_at_(mesh_at), condition_(condition), torque_(torque), settings_(settings) {
    double approach = 0.0;
    for (const LoadedPosition& position : cycle.positions) {
      known_[position.phase] = values_of(position);
      even_.insert(position.phase);
      approach += (position.load.transmission_error - position.gap.total.minCoeff()) / static_cast<double>(cycle.positions.size());
    }
    const double variation = std::max(best(0) + best(1), quiet_share * approach);
    slack_ = {settings.tolerance * variation, settings.tolerance * variation, settings.tolerance * best(2), settings.tolerance * best(3)};
  }

  CycleExtremes run() {
    CycleExtremes found;
    while (found.looked_at < settings_.most) {
      std::set<double> probes;
      for (std::size_t c = 0; c < curves; ++c) {
        const Promise promise = highest_promise(c);
        if (promise.height > best(c) + slack_[c]) probes.insert(promise.phase);
      }
      if (probes.empty()) break;
      const std::vector<double> phases(probes.begin(), probes.end());
      const MeshModel mesh = mesh_at_(phases);
      const LoadedCycle cycle = analyse_cycle(mesh, condition_, torque_, {}, {}, RootStresses::Later);
      found.looked_at += static_cast<int>(phases.size());
      if (!cycle.usable()) break;
      for (std::size_t i = 0; i < phases.size(); ++i) known_[phases[i]] = values_of(cycle.positions[i]);
    }
    std::set<double> phases;
    for (std::size_t c = 0; c < curves; ++c) {
      const double phase = std::ranges::max_element(known_, {}, [c](const auto& entry) { return entry.second[c]; })->first;
      if (!even_.contains(phase)) phases.insert(phase);
    }
    found.phases.assign(phases.begin(), phases.end());
    const auto rise = [&](std::size_t c) { return std::max(0.0, highest_promise(c).height - best(c)); };
    const auto unseen = [&](Figure f) -> double& { return found.unseen[static_cast<std::size_t>(f)]; };
    unseen(Figure::TePeakToPeak) = rise(0) + rise(1);
    unseen(Figure::PeakContactStress) = rise(2);
    unseen(Figure::PeakLineLoad) = rise(3);
    return found;
  }

 private:
  double best(std::size_t c) const {
    return std::ranges::max_element(known_, {}, [c](const auto& entry) { return entry.second[c]; })->second[c];
  }

  /// Over all intervals, the cycle closed.
  Promise highest_promise(std::size_t c) const {
    std::vector<double> x, y;
    for (const auto& [phase, values] : known_) {
      x.push_back(phase);
      y.push_back(values[c]);
    }
    const std::size_t n = x.size();
    const auto at = [&](std::size_t i) { return Sample(x[i % n] + static_cast<double>(i / n), y[i % n]); };
    Promise highest;
    const auto rise_towards = [&](std::size_t far, std::size_t middle, std::size_t near) {
      const auto [x0, y0] = at(far);
      const auto [x1, y1] = at(middle);
      const auto [x2, y2] = at(near);
      const double before = (y1 - y0) / std::abs(x1 - x0), last = (y2 - y1) / std::abs(x2 - x1);
      return std::max(last, last + (last - before) * (x2 - x1) / (x2 - x0));
    };
    for (std::size_t i = 0; i < n; ++i) {
      const auto [xa, ya] = at(i + 2);
      const auto [xb, yb] = at(i + 3);
      const double length = xb - xa;
      if (length <= shortest) continue;
      const double from_left = rise_towards(i, i + 1, i + 2), from_right = rise_towards(i + 5, i + 4, i + 3);  // into the interval where > 0
      double t = 0.5, height = std::max(ya, yb);
      if (from_left > 0.0 && from_right > 0.0) {
        t = std::clamp((yb + from_right * length - ya) / ((from_left + from_right) * length), 0.0, 1.0);
        height = std::min(ya + from_left * t * length, yb + from_right * (1.0 - t) * length);
      } else if (from_left > 0.0 && yb < ya) {
        height = ya + from_left * length;
      } else if (from_right > 0.0 && ya < yb) {
        height = yb + from_right * length;
      }
      for (const auto& [top, at_top] : {vertex(at(i + 1), at(i + 2), at(i + 3)), vertex(at(i + 2), at(i + 3), at(i + 4))}) {
        if (!(top > height && at_top > xa && at_top < xb)) continue;
        height = top;
        t = (at_top - xa) / length;
      }
      if (!(height > highest.height)) continue;
      double phase = xa + std::clamp(std::round(parts * t), 1.0, parts - 1.0) / parts * length;
      if (phase >= 1.0) phase -= 1.0;
      highest = {height, phase};
    }
    return highest;
  }

  const MeshAt& mesh_at_;
  const FlankCondition& condition_;
  double torque_;
  const ExtremeSearch& settings_;
  std::map<double, Values> known_;  ///< by phase
  std::set<double> even_;           ///< phases of the cycle itself
  Values slack_{};
};

}  // namespace

CycleExtremes locate_extremes(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, const LoadedCycle& cycle,
                              const ExtremeSearch& search) {
  if (!cycle.usable() || cycle.positions.size() < 4 || !(cycle.force > 0.0)) return {};
  return Search(mesh_at, condition, pinion_torque, cycle, search).run();
}

}  // namespace flankwright
