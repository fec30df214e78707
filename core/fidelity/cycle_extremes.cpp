#include "core/fidelity/cycle_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/fidelity/curve_rise.hpp"
#include "core/fidelity/edge_approach.hpp"
#include "core/gear/both_gears.hpp"
#include "core/rating/edge_contact_start.hpp"
#include "core/rating/line_region.hpp"

namespace flankwright {

namespace {

/// Intervals shorter than this are not divided [base pitches]: a rise within is a jump.
constexpr double shortest = 1e-4;
/// A probe lies at one of the divisions of its interval into so many parts: not near either end, because secants of a short and a long interval are
/// not alike, and where searches of other conditions have probed as well, which have kinks at the same phases: their meshes can be used again.
constexpr int parts = 8;

/// A phase within one pitch, without the round-off that would make two meshes of one.
double in_pitch(double phase) {
  constexpr double grid = 0x1p-30;
  const double rounded = grid * std::round(phase / grid);
  return rounded - std::floor(rounded);
}

/// The samples of one reading.
class Curve {
 public:
  /// Of the whole mesh: it repeats with every base pitch.
  Curve() = default;
  /// Of one tooth pair, by the phase of its line. What several pairs have would hide the one that is about to have more.
  /// @param outside  before its line enters, and after it has left
  static Curve of_pair(double outside) {
    Curve curve;
    curve.outside_ = outside;
    curve.repeats_ = false;
    return curve;
  }

  /// @param x      of the line of the pair, or `phase`
  /// @param phase  of the mesh position
  void add(double x, double phase, double value) { samples_[x] = {phase, value}; }

  /// NaN where no sample has a value.
  double best() const {
    double largest = not_given;
    for (const auto& [x, sample] : samples_) largest = std::fmax(largest, sample.value);
    return largest;
  }

  double phase_of_best() const {
    const double largest = best();
    return std::ranges::find_if(samples_, [&](const auto& entry) { return entry.second.value == largest; })->second.phase;
  }

  /// Over all intervals; within one pitch, at the division of its interval that is nearest.
  /// @param spacing  of the positions of the cycle
  CurveRise highest_promise(double spacing) const {
    const std::vector<CurveSample> curve = with_ends(spacing);
    CurveRise highest;
    for (std::size_t left = 3; left + 4 < curve.size(); ++left) {
      const double from = curve[left].x, length = curve[left + 1].x - from;
      if (length <= shortest) continue;
      const CurveRise rise = rise_between(curve, left);
      if (!(rise.height > highest.height)) continue;
      const double way = std::clamp(std::round(parts * (rise.x - from) / length), 1.0, parts - 1.0) / parts;
      highest = {rise.height, in_pitch(from + way * length)};
    }
    return highest;
  }

 private:
  struct Sample {
    double phase, value;
  };

  /// With the samples beyond either end that rise_between() asks for.
  std::vector<CurveSample> with_ends(double spacing) const {
    std::vector<CurveSample> curve;
    for (const auto& [x, sample] : samples_) curve.push_back({x, sample.value});
    const std::vector<CurveSample> own = curve;
    const std::size_t n = own.size();
    if (repeats_) {
      for (std::size_t i = 0; i < 7; ++i) curve.push_back({own[i % n].x + 1.0 + static_cast<double>(i / n), own[i % n].y});
      return curve;
    }
    for (const int i : {1, 2, 3, 4}) {
      curve.insert(curve.begin(), {own.front().x - i * spacing, outside_});
      curve.push_back({own.back().x + i * spacing, outside_});
    }
    return curve;
  }

  std::map<double, Sample> samples_;
  double outside_{not_given};
  bool repeats_{true};
};

/// A curve whose extreme is sought.
struct SoughtCurve {
  const Curve* curve;
  double scale;  ///< what the tolerance of the search is a share of
};

/// Of one tooth pair at one position, see Search.
struct PairReadings {
  double stress{0.0}, load{0.0}, on_edges{0.0};
  std::vector<double> further;
};

/// By tooth pair.
std::map<int, PairReadings> pair_readings(const MeshPosition& at, const LoadedPosition& loaded, const std::vector<PointReading>& further) {
  std::map<int, PairReadings> pairs;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    const auto point = static_cast<Eigen::Index>(i);
    PairReadings& pair = pairs[at.points[i].tooth];
    pair.stress = std::max(pair.stress, loaded.contact_stress[point]);
    pair.load = std::max(pair.load, loaded.peak_load[point]);
    if (loaded.edge_stress.size() > 0) pair.on_edges = std::max(pair.on_edges, loaded.edge_stress[point]);
    pair.further.resize(further.size(), 0.0);
    for (std::size_t r = 0; r < further.size(); ++r) pair.further[r] = std::fmax(pair.further[r], further[r](loaded_point(at, loaded, point)));
  }
  return pairs;
}

class Search {
 public:
  Search(const MeshModel& model, const MeshAt& mesh_at, const FlankCondition& condition, double torque, const LoadedCycle& cycle,
         const ExtremeSearch& settings)
      : mesh_at_(mesh_at),
        condition_(condition),
        torque_(torque),
        settings_(settings),
        spacing_(1.0 / static_cast<double>(cycle.positions.size())),
        further_(settings.further.size(), Curve::of_pair(0.0)) {
    for (std::size_t p = 0; p < cycle.positions.size(); ++p) {
      const LoadedPosition& position = cycle.positions[p];
      add(model.positions[p], position);
      even_.insert(position.phase);
      mean_deflection_ += spacing_ * position.approach_of_teeth();
    }
    const double variation = std::max(te_.best() + turned_te_.best(), quiet_share * mean_deflection_);
    // The share of the load on edges is not sought for itself: it peaks where the stress does.
    sought_ = {{&te_, variation}, {&turned_te_, variation}, {&stress_, stress_.best()}, {&load_, load_.best()}, {&edge_stress_, stress_.best()}};
    for (const Curve& curve : further_) sought_.push_back({&curve, curve.best()});
  }

  CycleExtremes run() {
    CycleExtremes found;
    std::set<double> probes(settings_.first.begin(), settings_.first.end());
    while (found.looked_at < settings_.most) {
      for (const auto& [curve, scale] : sought_) {
        const CurveRise promise = curve->highest_promise(spacing_);
        if (promise.height > curve->best() + settings_.tolerance * scale) probes.insert(promise.x);
      }
      for (const Member m : both_gears) {
        const Curve& approach = edge_approach_[m];
        // Where the edge carries already, its stress is sought as well: the approach tells of tops that are much higher than what is known. An edge
        // that is about to touch within the tolerance of the search may touch at the next probe.
        constexpr double much = 0.05;
        const double near = settings_.tolerance * mean_deflection_, known = approach.best();
        const CurveRise promise = approach.highest_promise(spacing_);
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
      for (std::size_t i = 0; i < phases.size(); ++i) add(mesh.positions[i], cycle.positions[i]);
    }
    found.phases = phases_of_extremes();
    const auto rise = [&](const Curve& curve) { return std::max(0.0, curve.highest_promise(spacing_).height - curve.best()); };
    const auto unseen = [&](Figure f) -> double& { return found.unseen[static_cast<std::size_t>(f)]; };
    unseen(Figure::TePeakToPeak) = rise(te_) + rise(turned_te_);
    unseen(Figure::PeakContactStress) = rise(stress_);
    unseen(Figure::PeakLineLoad) = rise(load_);
    found.unseen_edge_stress = rise(edge_stress_);
    found.unseen_edge_share = rise(edge_share_);
    for (const Member m : both_gears) {
      const Curve& approach = edge_approach_[m];
      found.edge_approach[m] = std::fmax(approach.best(), approach.highest_promise(spacing_).height);
    }
    for (const Curve& curve : further_) found.unseen_further.push_back(rise(curve));
    return found;
  }

 private:
  void add(const MeshPosition& at, const LoadedPosition& loaded) {
    const double phase = loaded.phase, te = loaded.load.transmission_error;
    known_.insert(phase);
    te_.add(phase, phase, te);
    turned_te_.add(phase, phase, -te);
    edge_share_.add(phase, phase, std::fmax(0.0, loaded.tip_edge_share));
    for (const auto& [tooth, pair] : pair_readings(at, loaded, settings_.further)) {
      const double x = phase + tooth;
      stress_.add(x, phase, pair.stress);
      load_.add(x, phase, pair.load);
      edge_stress_.add(x, phase, pair.on_edges);
      for (std::size_t r = 0; r < further_.size(); ++r) further_[r].add(x, phase, pair.further[r]);
      for (const Member m : both_gears) edge_approach_[m].add(x, phase, edge_approach(at, loaded, m, tooth).approach);
    }
  }

  /// Those of the extremes that lie between the positions of the cycle.
  std::vector<double> phases_of_extremes() const {
    std::set<double> phases;
    const auto take = [&](const Curve& curve) {
      const double phase = curve.phase_of_best();
      if (!even_.contains(phase)) phases.insert(phase);
    };
    for (const Curve* curve : {&te_, &turned_te_, &stress_, &load_}) take(*curve);
    for (const Curve& curve : further_) take(curve);
    for (const Curve* curve : {&edge_stress_, &edge_share_}) {
      if (curve->best() > 0.0) take(*curve);
    }
    for (const Member m : both_gears) {
      const Curve& approach = edge_approach_[m];
      // An edge that is about to touch is looked at with other intervals as well: they move it by less than this share of the mean deflection.
      constexpr double about = 0.01;
      const double nearest = approach.best();
      if (nearest <= 0.0 && nearest > -about * mean_deflection_) take(approach);
    }
    return {phases.begin(), phases.end()};
  }

  const MeshAt& mesh_at_;
  const FlankCondition& condition_;
  double torque_;
  const ExtremeSearch& settings_;
  double spacing_;                 ///< of the cycle's positions [base pitches]
  double mean_deflection_{0.0};    ///< [mm]
  std::set<double> known_, even_;  ///< phases of all positions that were solved, and of the cycle itself
  Curve te_, turned_te_, edge_share_;
  Curve stress_{Curve::of_pair(0.0)}, load_{Curve::of_pair(0.0)}, edge_stress_{Curve::of_pair(0.0)};
  PerGear<Curve> edge_approach_{Curve::of_pair(not_given), Curve::of_pair(not_given)};
  std::vector<Curve> further_;
  std::vector<SoughtCurve> sought_;
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
      phases.push_back(in_pitch(passage + outwards * thirds / 3.0 * spacing));
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
