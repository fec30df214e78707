#include "core/rating/contact_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/rating/line_region.hpp"

namespace flankwright {

namespace {

void raise(LinePeak& peak, const LinePeak& other) {
  if (!(peak.value >= other.value) && !std::isnan(other.value)) peak = other;
}

void raise(ContactPeaks::Pair& peaks, const ContactPeaks::Pair& others) {
  raise(peaks.contact_stress, others.contact_stress);
  raise(peaks.line_load, others.line_load);
}

/// Values of one line between its points: line load and square of stress linear.
class Line {
 public:
  Line(const MeshPosition& at, const LoadedPosition& loaded, std::size_t begin, std::size_t end)
      : at_(at), loaded_(loaded), begin_(begin), end_(end) {}

  ContactPeaks::Pair at_point(std::size_t i) const { return peaks(at_.points[i].z, load(i), stress(i)); }

  /// Whether contact reaches a rounded tip edge.
  bool is_on_edge(std::size_t i) const { return loaded_.edge_stress.size() > 0 && loaded_.edge_stress[static_cast<Eigen::Index>(i)] > 0.0; }

  /// Nothing beyond the first and last point, and beside a tip edge that carries.
  ContactPeaks::Pair at_z(double z) const {
    for (std::size_t i = begin_; i + 1 < end_; ++i) {
      const double z0 = at_.points[i].z, z1 = at_.points[i + 1].z;
      if (z < z0 || z > z1) continue;
      if (is_on_edge(i) || is_on_edge(i + 1)) return {};
      const double t = (z - z0) / (z1 - z0);
      const auto between = [t](double a, double b) { return (1.0 - t) * a + t * b; };
      return peaks(z, between(load(i), load(i + 1)), std::sqrt(between(stress(i) * stress(i), stress(i + 1) * stress(i + 1))));
    }
    return {};
  }

 private:
  double load(std::size_t i) const { return loaded_.peak_load[static_cast<Eigen::Index>(i)]; }
  double stress(std::size_t i) const { return loaded_.contact_stress[static_cast<Eigen::Index>(i)]; }
  ContactPeaks::Pair peaks(double z, double load, double stress) const {
    const double phase = loaded_.phase - std::floor(loaded_.phase);
    const int tooth = at_.points[begin_].tooth + static_cast<int>(std::floor(loaded_.phase));
    return {{stress, phase, tooth, z}, {load, phase, tooth, z}};
  }

  const MeshPosition& at_;
  const LoadedPosition& loaded_;
  std::size_t begin_, end_;
};

/// What is sought: peaks, each with its own samples to compare. The last two only where all points are asked for.
constexpr std::array<const LinePeak& (*)(const ContactPeaks&), 6> sought{
    +[](const ContactPeaks& p) -> const LinePeak& { return p.with_spikes.contact_stress; },
    +[](const ContactPeaks& p) -> const LinePeak& { return p.with_spikes.line_load; },
    +[](const ContactPeaks& p) -> const LinePeak& { return p.without_spikes.contact_stress; },
    +[](const ContactPeaks& p) -> const LinePeak& { return p.without_spikes.line_load; },
    +[](const ContactPeaks& p) -> const LinePeak& { return p.everywhere.contact_stress; },
    +[](const ContactPeaks& p) -> const LinePeak& { return p.everywhere.line_load; }};
constexpr std::size_t sought_on_flanks = 4;

/// Peaks of the positions solved so far, by phase.
class Samples {
 public:
  Samples(const MeshAt& mesh_at, const FlankCondition& condition, double torque, const SpikeRule& rule)
      : mesh_at_(mesh_at), condition_(condition), torque_(torque), rule_(rule) {}

  void add(std::vector<double> phases) {
    std::erase_if(phases, [&](double phase) { return by_phase_.contains(phase); });
    if (phases.empty()) return;
    const MeshModel model = mesh_at_(phases);
    const LoadedCycle cycle = analyse_cycle(model, condition_, torque_);
    for (std::size_t i = 0; i < phases.size(); ++i) {
      ContactPeaks peaks;
      if (cycle.positions[i].load.usable()) peaks = peaks_at(model, model.positions[i], cycle.positions[i], rule_);
      peaks.failures = cycle.positions[i].load.usable() ? 0 : 1;
      by_phase_[phases[i]] = peaks;
    }
  }

  double value(std::size_t which, double phase) const { return sought[which](by_phase_.at(phase)).value; }

  double best(std::size_t which) const { return sought[which](over_all()).value; }

  ContactPeaks over_all() const {
    ContactPeaks all;
    for (const auto& [phase, peaks] : by_phase_) {
      raise(all.with_spikes, peaks.with_spikes);
      raise(all.without_spikes, peaks.without_spikes);
      raise(all.everywhere, peaks.everywhere);
      all.failures += peaks.failures;
    }
    all.positions = static_cast<int>(by_phase_.size());
    return all;
  }

  std::vector<double> phases() const {
    std::vector<double> list;
    for (const auto& [phase, peaks] : by_phase_) list.push_back(phase);
    return list;
  }

 private:
  const MeshAt& mesh_at_;
  const FlankCondition& condition_;
  double torque_;
  SpikeRule rule_;
  std::map<double, ContactPeaks> by_phase_;
};

/// A maximum of one of the four between two phases.
struct Bracket {
  std::size_t which;
  double low, top, high;

  double width() const { return high - low; }
  /// How much of the top it has at one end or the other: about as much as it may still rise.
  double fall(const Samples& samples) const {
    const double at_top = samples.value(which, top);
    return std::max(at_top - samples.value(which, low), at_top - samples.value(which, high));
  }
  /// Enclosed, as high as it gets, or no match for the highest any more.
  bool is_done(const Samples& samples, const PeakSearch& search) const {
    constexpr double doubt = 2.0;  // a kink may rise by more than the side ends fall: by the golden ratio, if both are straight
    const double at_top = samples.value(which, top), rise = doubt * fall(samples);
    return width() <= 2.0 * search.phase_tolerance || rise <= search.value_tolerance * at_top || at_top + rise < samples.best(which);
  }
  /// Golden section of the wider side.
  double probe() const {
    constexpr double golden = 0.3819660112501051;  // 2 - golden ratio
    return high - top > top - low ? top + golden * (high - top) : top - golden * (top - low);
  }
  void take(const Samples& samples, double x) {
    const bool higher = samples.value(which, x) > samples.value(which, top);
    if (higher) {
      (x > top ? low : high) = top;
      top = x;
    } else {
      (x > top ? high : low) = x;
    }
  }
};

/// Brackets around the samples that are no lower than both neighbours and worth the while.
std::vector<Bracket> brackets(const Samples& samples, const PeakSearch& search) {
  const std::vector<double> phases = samples.phases();
  std::vector<Bracket> found;
  for (std::size_t which = 0; which < (search.everywhere ? sought.size() : sought_on_flanks); ++which) {
    const double best = samples.best(which);
    for (std::size_t i = 1; i + 1 < phases.size(); ++i) {
      const double here = samples.value(which, phases[i]);
      const bool lower = here < samples.value(which, phases[i - 1]) || here < samples.value(which, phases[i + 1]);
      if (here >= search.worth * best && !lower) found.push_back({which, phases[i - 1], phases[i], phases[i + 1]});
    }
  }
  return found;
}

void check(const PeakSearch& search) {
  const auto positive = [](const char* field, double value) {
    if (!(value > 0.0) || !std::isfinite(value)) throw InvalidInput(field, std::to_string(value), "above 0");
  };
  positive("peak search step", search.step);
  positive("peak search tolerance", search.phase_tolerance);
  if (!(search.value_tolerance >= 0.0)) throw InvalidInput("peak search value tolerance", std::to_string(search.value_tolerance), "at least 0");
  if (!(search.spikes.line_share >= 0.0 && search.spikes.line_share <= 1.0)) {
    throw InvalidInput("spike rule line share", std::to_string(search.spikes.line_share), "0 .. 1");
  }
  if (!(search.spikes.end_distance >= 0.0)) {
    throw InvalidInput("spike rule end distance", std::to_string(search.spikes.end_distance), "at least 0 m_n");
  }
}

}  // namespace

ContactPeaks peaks_at(const MeshModel& model, const MeshPosition& at, const LoadedPosition& loaded, const SpikeRule& rule) {
  const LineRegion region(model);
  const double distance = rule.end_distance * model.pair.data.normal_module;
  ContactPeaks peaks;
  peaks.positions = 1;
  for (std::size_t begin = 0, end = 0; begin < at.points.size(); begin = end) {
    while (end < at.points.size() && at.points[end].tooth == at.points[begin].tooth) ++end;
    const Line line(at, loaded, begin, end);
    const double line_phase = at.phase + at.points[begin].tooth;
    const LineInterval whole = region.line(line_phase), counted = region.line(line_phase, distance);
    const bool long_enough = whole.end - whole.begin >= rule.line_share * region.longest - LineRegion::round_off * model.face_width;
    for (std::size_t i = begin; i < end; ++i) {
      const double z = at.points[i].z;
      raise(peaks.everywhere, line.at_point(i));
      if (line.is_on_edge(i)) continue;
      raise(peaks.with_spikes, line.at_point(i));
      if (long_enough && z >= counted.begin && z <= counted.end) raise(peaks.without_spikes, line.at_point(i));
    }
    if (!long_enough || counted.begin > counted.end) continue;
    raise(peaks.without_spikes, line.at_z(counted.begin));
    raise(peaks.without_spikes, line.at_z(counted.end));
  }
  return peaks;
}

std::vector<double> unsorted_line_events(const MeshModel& model, double line_share) {
  const LineRegion region(model);
  const double slope = std::abs(region.path.slope), part = line_share * region.longest * slope;
  // A line's phase is that of its leading end at one end of the pair's face; ends of the common face lie within it.
  const double low = region.path.phase_at(0.0, region.face_start), high = region.path.phase_at(0.0, region.face_end);
  const double leading = std::max(low, high), trailing = std::min(low, high);
  std::vector<double> events;
  for (const double phase : {0.0, region.first, region.last, region.path.region_length}) {
    events.push_back(phase - leading);
    events.push_back(phase - trailing);
  }
  events.push_back(region.first - leading + part);
  events.push_back(region.last - trailing - part);
  return events;
}

std::vector<double> line_events(const MeshModel& model, double line_share) {
  std::vector<double> events = unsorted_line_events(model, line_share);
  for (double& event : events) {
    event -= std::floor(event);
    if (event > 1.0 - LineRegion::round_off) event = 0.0;
  }
  std::ranges::sort(events);
  const auto repeated = std::ranges::unique(events, [](double a, double b) { return b - a < LineRegion::round_off; });
  events.erase(repeated.begin(), repeated.end());
  return events;
}

ContactPeaks locate_peaks(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, const PeakSearch& search) {
  check(search);
  std::vector<double> knots = line_events(mesh_at({0.0}), search.spikes.line_share);
  if (knots.front() > 0.0) knots.insert(knots.begin(), 0.0);
  knots.push_back(1.0);
  std::vector<double> phases;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const int parts = std::max(2, static_cast<int>(std::ceil((knots[i + 1] - knots[i]) / search.step)));
    for (int j = 0; j < parts; ++j) phases.push_back(knots[i] + (knots[i + 1] - knots[i]) * j / parts);
  }
  // The end of the cycle, and one position beyond either end, so that a maximum there has neighbours.
  const double after = phases[1] + 1.0, before = phases.back() - 1.0;
  phases.push_back(1.0);
  phases.push_back(after);
  phases.insert(phases.begin(), before);
  Samples samples(mesh_at, condition, pinion_torque, search.spikes);
  samples.add(phases);
  std::vector<Bracket> open = brackets(samples, search);
  while (true) {
    std::erase_if(open, [&](const Bracket& b) { return b.is_done(samples, search); });
    if (open.empty()) break;
    std::set<double> probes;
    for (const Bracket& b : open) probes.insert(b.probe());
    samples.add({probes.begin(), probes.end()});
    for (Bracket& b : open) b.take(samples, b.probe());
  }
  ContactPeaks peaks = samples.over_all();
  if (!search.everywhere) peaks.everywhere = {};
  peaks.phase_tolerance = search.phase_tolerance;
  peaks.spikes = search.spikes;
  return peaks;
}

}  // namespace flankwright
