#include "core/fidelity/cycle_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/fidelity/curve_rise.hpp"
#include "core/fidelity/edge_approach.hpp"
#include "core/rating/edge_contact_start.hpp"
#include "core/rating/line_region.hpp"

namespace flankwright {

namespace {

/// Transmission error, the same turned over, contact stress, line load, stress on tip edges, their share of the load (0 without), which is
/// not sought for itself: it peaks where the stress does.
constexpr std::size_t curves = 6;
/// Behind them, how far the tip edge of either gear is pressed into its mate, see edge_approach().
constexpr std::size_t edge_approaches = curves, own_curves = curves + 2;
/// Of all curves: these, then the further readings of the search.
using Values = std::vector<double>;

Values values_of(const MeshPosition& at, const LoadedPosition& loaded, const std::vector<PositionReading>& further) {
  const double te = loaded.load.transmission_error;
  const double on_edges = loaded.edge_stress.size() > 0 ? loaded.edge_stress.maxCoeff() : 0.0;
  Values values{te,
                -te,
                loaded.contact_stress.maxCoeff(),
                loaded.peak_load.maxCoeff(),
                on_edges,
                std::fmax(0.0, loaded.tip_edge_share),
                edge_approach(at, loaded, Member::Pinion).approach,
                edge_approach(at, loaded, Member::Wheel).approach};
  for (const PositionReading& reading : further) values.push_back(reading(at, loaded));
  return values;
}

/// A curve whose extreme is sought, and what the tolerance of the search is a share of.
struct SoughtCurve {
  std::size_t curve;
  double scale;
};

/// Intervals shorter than this are not divided [base pitches]: a rise within is a jump.
constexpr double shortest = 1e-4;
/// A probe lies at one of the divisions of its interval into so many parts: not near either end, because secants of a short and a long interval are
/// not alike, and where searches of other conditions have probed as well, which have kinks at the same phases: their meshes can be used again.
constexpr int parts = 8;

class Search {
 public:
  Search(const MeshModel& model, const MeshAt& mesh_at, const FlankCondition& condition, double torque, const LoadedCycle& cycle,
         const ExtremeSearch& settings)
      : mesh_at_(mesh_at), condition_(condition), torque_(torque), settings_(settings) {
    for (std::size_t p = 0; p < cycle.positions.size(); ++p) {
      const LoadedPosition& position = cycle.positions[p];
      known_[position.phase] = values_of(model.positions[p], position, settings.further);
      even_.insert(position.phase);
      mean_deflection_ += (position.load.transmission_error - position.gap.total.minCoeff()) / static_cast<double>(cycle.positions.size());
    }
    const double variation = std::max(best(0) + best(1), quiet_share * mean_deflection_);
    sought_ = {{0, variation}, {1, variation}, {2, best(2)}, {3, best(3)}, {4, best(2)}};
    for (std::size_t i = 0; i < settings.further.size(); ++i) sought_.push_back({own_curves + i, best(own_curves + i)});
  }

  CycleExtremes run() {
    CycleExtremes found;
    std::set<double> probes(settings_.first.begin(), settings_.first.end());
    while (found.looked_at < settings_.most) {
      for (const auto& [curve, scale] : sought_) {
        const CurveRise promise = highest_promise(curve);
        if (promise.height > best(curve) + settings_.tolerance * scale) probes.insert(promise.x);
      }
      for (std::size_t c = edge_approaches; c < own_curves; ++c) {
        // Where the edge carries already, its stress is sought as well: the approach tells of tops that are much higher than what is known. An edge
        // that is about to touch within the tolerance of the search may touch at the next probe.
        constexpr double much = 0.05;
        const double near = settings_.tolerance * mean_deflection_, known = best(c);
        const CurveRise promise = highest_promise(c);
        if (promise.height > std::fmax(-near, known + much * std::fmax(near, known))) probes.insert(promise.x);
      }
      std::erase_if(probes, [this](double phase) { return known_.contains(phase); });
      if (probes.empty()) break;
      const std::vector<double> phases(probes.begin(), probes.end());
      probes.clear();
      const MeshModel mesh = mesh_at_(phases);
      const LoadedCycle cycle = analyse_cycle(mesh, condition_, torque_, {}, RootStresses::Later);
      found.looked_at += static_cast<int>(phases.size());
      if (!cycle.usable()) break;
      for (std::size_t i = 0; i < phases.size(); ++i) known_[phases[i]] = values_of(mesh.positions[i], cycle.positions[i], settings_.further);
    }
    std::set<double> phases;
    for (std::size_t c = 0; c < own_curves + settings_.further.size(); ++c) {
      const double highest = best(c);
      const bool is_approach = c >= curves && c < own_curves;
      // An edge that is about to touch is looked at with other intervals as well: they move it by less than this share of the mean deflection.
      constexpr double about = 0.01;
      if (is_approach ? !(highest <= 0.0 && highest > -about * mean_deflection_) : highest == 0.0) continue;  // 0: no tip edge is reached
      const double phase = std::ranges::find_if(known_, [&](const auto& entry) { return entry.second[c] == highest; })->first;
      if (!even_.contains(phase)) phases.insert(phase);
    }
    found.phases.assign(phases.begin(), phases.end());
    const auto rise = [&](std::size_t c) { return std::max(0.0, highest_promise(c).height - best(c)); };
    const auto unseen = [&](Figure f) -> double& { return found.unseen[static_cast<std::size_t>(f)]; };
    unseen(Figure::TePeakToPeak) = rise(0) + rise(1);
    unseen(Figure::PeakContactStress) = rise(2);
    unseen(Figure::PeakLineLoad) = rise(3);
    found.unseen_edge_stress = rise(4);
    found.unseen_edge_share = rise(5);
    const auto highest = [&](std::size_t c) { return std::fmax(best(c), highest_promise(c).height); };
    found.edge_approach = {highest(edge_approaches), highest(edge_approaches + 1)};
    for (std::size_t i = 0; i < settings_.further.size(); ++i) found.unseen_further.push_back(rise(own_curves + i));
    return found;
  }

 private:
  /// NaN where no phase has a value.
  double best(std::size_t c) const {
    double largest = not_given;
    for (const auto& [phase, values] : known_) largest = std::fmax(largest, values[c]);
    return largest;
  }

  /// Over all intervals, the cycle closed; at the division of its interval that is nearest.
  CurveRise highest_promise(std::size_t c) const {
    std::vector<CurveSample> once, curve;
    for (const auto& [phase, values] : known_) once.push_back({phase, values[c]});
    const std::size_t n = once.size();
    for (std::size_t i = 0; i < n + 7; ++i) curve.push_back({once[i % n].x + static_cast<double>(i / n), once[i % n].y});
    CurveRise highest;
    for (std::size_t i = 0; i < n; ++i) {
      const double from = curve[i + 3].x, length = curve[i + 4].x - from;
      if (length <= shortest) continue;
      CurveRise rise = rise_between(curve, i + 3);
      if (!(rise.height > highest.height)) continue;
      rise.x = from + std::clamp(std::round(parts * (rise.x - from) / length), 1.0, parts - 1.0) / parts * length;
      rise.x -= std::floor(rise.x);
      highest = rise;
    }
    return highest;
  }

  const MeshAt& mesh_at_;
  const FlankCondition& condition_;
  double torque_;
  const ExtremeSearch& settings_;
  std::map<double, Values> known_;  ///< by phase
  std::set<double> even_;           ///< phases of the cycle itself
  std::vector<SoughtCurve> sought_;
  double mean_deflection_{0.0};  ///< [mm]
};

}  // namespace

std::vector<double> tip_edge_passages(const MeshModel& model, const LoadedCycle& cycle) {
  constexpr int enough = 3;  // positions that know a piece of a curve
  const double spacing = 1.0 / static_cast<double>(cycle.positions.size());
  const LineRegion region(model);
  const double at_start = region.path.phase_at(0.0, region.face_start), at_end = region.path.phase_at(0.0, region.face_end);
  constexpr double short_passage = 4.0;  // spacings: in a longer one several positions know how far the edge is from its mate
  if (!(std::abs(at_end - at_start) < short_passage * spacing)) return {};
  const double middle = 0.5 * (region.first + region.last);
  std::vector<double> phases;
  for (const bool is_start : {true, false}) {
    const double edge = is_start ? region.first : region.last, outwards = is_start ? -1.0 : 1.0;  // phase of A, of E
    int seen = 0;
    // Of the flank within a spacing of the edge: its largest load, and when that point of the face passes the edge.
    double most = 0.0, passage = not_given;
    for (std::size_t p = 0; p < cycle.positions.size(); ++p) {
      const MeshPosition& at = model.positions[p];
      bool reaches = false;
      for (std::size_t i = 0; i < at.points.size(); ++i) {
        const ContactPoint& point = at.points[i];
        if (at.laws.empty() || !at.laws[i].edge() || (point.phase < middle) != is_start) continue;
        reaches = reaches || reaches_tip_edge(at, cycle.positions[p], i);
        const double inside = outwards * (edge - point.phase), load = cycle.positions[p].load.line_load[static_cast<Eigen::Index>(i)];
        if (inside < 0.0 || inside >= spacing || !(load > most)) continue;
        most = load;
        passage = at.phase + outwards * inside;
      }
      seen += reaches ? 1 : 0;
    }
    if (seen >= enough || std::isnan(passage)) continue;
    for (const int thirds : {1, 2, 3, 4}) {
      constexpr double grid = 0x1p-30;  // of phases: round-off does not make two meshes of one
      const double phase = grid * std::round((passage + outwards * thirds / 3.0 * spacing) / grid);
      phases.push_back(phase - std::floor(phase));
    }
  }
  return phases;
}

CycleExtremes locate_extremes(const MeshModel& model, const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque,
                              const LoadedCycle& cycle, const ExtremeSearch& search) {
  if (!cycle.usable() || cycle.positions.size() < 4 || !(cycle.force > 0.0)) return {};
  return Search(model, mesh_at, condition, pinion_torque, cycle, search).run();
}

}  // namespace flankwright
