#include "core/contact/unloaded/tooth_contact.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/peak.hpp"
#include "core/contact/unloaded/section_maximum.hpp"

namespace flankwright {

namespace {

constexpr double flat_tolerance = 1e-9;  // mm along the base tangent, see ToothContactSolver
constexpr double flat_fraction = 1.0 / 200.0;
constexpr double coarse_error = 1e-12;         // rad: bound on what SectionAccuracy::Coarse leaves
constexpr double announced_share = 1.0 / 4.0;  // of an interval of the face with a maximum: halved to this, hollow flanks only
constexpr double hidden_share = 1.0 / 64.0;    // of an interval of the face that hides a maximum: halved to this
constexpr double angle_round_off = 1e-15;      // rad: wheel angles closer than this are the same
// Along the face [mm], [rad], [mm].
constexpr PeakTolerance face_tolerance{1e-7, 1e-16, 1e-6};

/// The maximisation over the face for one tooth pair and pinion angle.
class FaceSearch {
 public:
  FaceSearch(const FlankAssembly& assembly, const SearchDensity& density, int tooth, double phi1)
      : assembly_(assembly), density_(density), condition_(assembly, tooth, phi1), search_(condition_, density.cells) {}

  SectionMaximum solve() const;
  ContactKind kind_of(const SectionMaximum& best) const;

 private:
  std::vector<double> section_heights() const;
  void reveal_hidden_maxima(std::vector<SectionMaximum>& sections, double highest) const;
  SectionMaximum ascend(const SectionMaximum& from, const SectionMaximum& next) const;
  SectionMaximum off_the_edge(const SectionMaximum& edge) const;
  bool is_flat_around(const SectionMaximum& best) const;
  double flat_step() const { return flat_fraction * assembly_.pinion.face.width(); }
  /// The angle still rises beyond a face end; a flat valley that merely reaches the end is no edge contact.
  bool is_held_by_face_end(const SectionMaximum& s) const {
    const auto rises_beyond = [&](const FaceRange& face, double z) {
      const double end = face.end_near(z);
      return std::abs(end - z) <= end_round_off * face.half() && s.slope_z * (end - face.middle()) > 0.0;
    };
    return s.held_by_wheel_end || rises_beyond(assembly_.pinion.face, s.at.z) || rises_beyond(assembly_.wheel.face, s.at.wheel_z);
  }

  static constexpr double end_round_off = 1e-9;  // half face widths within which a point is on the end

  const FlankAssembly& assembly_;
  const SearchDensity& density_;
  ContactCondition condition_;
  SectionSearch search_;
};

/// Sections over the face that both gears cover: density_.sections where undisturbed flanks would touch inside both profiles, and a
/// third as many on either side of that, where edges may touch.
std::vector<double> FaceSearch::section_heights() const {
  // A tilted wheel reaches a little beyond its width.
  const double tilt = assembly_.wheel_axes.col(2).head<2>().norm();
  const double beyond = tilt * (assembly_.wheel_centre.head<2>().norm() + assembly_.pinion.tip_radius), centre = assembly_.wheel_centre.z();
  const FaceRange &pinion = assembly_.pinion.face, &wheel = assembly_.wheel.face;
  double lo = std::max(pinion.begin, centre + wheel.begin - beyond), hi = std::min(pinion.end, centre + wheel.end + beyond);
  const double rate = condition_.roll_rate();
  // Teeth that wind around their gear meet the mate again a turn later, as another pair: half a turn to either side is this one's.
  const double half_turn = units::pi * std::min(assembly_.pinion.base_radius, assembly_.wheel.base_radius);
  const double from_middle = condition_.undisturbed_roll(0.0) - 0.5 * (condition_.lowest_undisturbed_roll() + condition_.highest_undisturbed_roll());
  if (rate != 0.0) {
    const double middle = -from_middle / rate, half_way = half_turn / std::abs(rate);
    lo = std::max(lo, middle - half_way);
    hi = std::min(hi, middle + half_way);
  }
  if (!(lo < hi)) return {};
  double first = lo, last = hi;  // of the line of contact
  if (rate != 0.0) {
    const double start = (condition_.lowest_undisturbed_roll() - condition_.undisturbed_roll(0.0)) / rate;
    const double end = (condition_.highest_undisturbed_roll() - condition_.undisturbed_roll(0.0)) / rate;
    first = std::clamp(std::min(start, end), lo, hi);
    last = std::clamp(std::max(start, end), lo, hi);
  }
  const int beside = (density_.sections + 1) / 3;
  std::vector<double> heights;
  const auto append = [&](double from, double to, int intervals) {
    for (int i = 0; i < intervals; ++i) heights.push_back(from + i * (to - from) / intervals);
  };
  if (lo < first) append(lo, first, beside);
  if (first < last) append(first, last, density_.sections - 1);
  if (last < hi) append(last, hi, beside);
  heights.push_back(hi);
  return heights;
}

SectionMaximum FaceSearch::solve() const {
  std::vector<SectionMaximum> coarse;
  double highest = -std::numeric_limits<double>::infinity();
  for (const double z : section_heights()) {
    coarse.push_back(search_.at(z, coarse.empty() ? SectionMaximum{} : coarse.back(), SectionAccuracy::Coarse));
    highest = std::max(highest, coarse.back().phi2);
  }
  reveal_hidden_maxima(coarse, highest);
  const int count = static_cast<int>(coarse.size());
  // In a flat valley the middle one of those that are equally high represents all.
  std::vector<const SectionMaximum*> level;
  for (const SectionMaximum& s : coarse) {
    if (s.exists && s.phi2 >= highest - angle_round_off) level.push_back(&s);
  }
  if (level.empty()) return {};
  SectionMaximum top;
  // Hollow flanks (metal added at the ends) have several maxima: seek every one, from below where both sides exist. A
  // slope that is round-off over the span marks a maximum, or a flat valley, by itself.
  const auto inside = [&](int i) { return i >= 0 && i < count; };
  const auto exists = [&](int i) { return inside(i) && coarse[i].exists; };
  const auto rises = [&](int i, int step) { return inside(i + step) && coarse[i].slope_z * (coarse[i + step].z - coarse[i].z) > angle_round_off; };
  for (int i = 0; i < count; ++i) {
    if (!coarse[i].exists) continue;
    for (const int step : {1, -1}) {
      const int next = i + step;
      if (!rises(i, step)) continue;
      if (exists(next) && (coarse[next].slope_z * step > 0.0 || (step < 0 && rises(next, 1)))) continue;  // same climb, or done
      const SectionMaximum maximum = ascend(coarse[i], coarse[next]);
      if (maximum.phi2 > top.phi2) top = maximum;
    }
  }
  const SectionMaximum& middle = *level[level.size() / 2];
  if (!top.exists || middle.phi2 >= top.phi2 - angle_round_off) {
    const SectionMaximum settled = search_.at(middle.z, middle, SectionAccuracy::Full);
    if (!top.exists || settled.phi2 >= top.phi2 - angle_round_off) top = settled;
  }
  return top.bound == SectionBound::None ? top : off_the_edge(top);
}

/// Where a flat valley begins at an edge, a point inside represents it.
SectionMaximum FaceSearch::off_the_edge(const SectionMaximum& edge) const {
  for (const double side : {-1.0, 1.0}) {
    const double z = edge.at.z + side * flat_step();
    if (!assembly_.pinion.face.holds(z)) continue;
    SectionMaximum inside = search_.at(z, edge, SectionAccuracy::Coarse);
    if (!inside.exists || inside.phi2 < edge.phi2 - coarse_error) continue;
    inside = search_.at(z, inside, SectionAccuracy::Full);
    if (inside.exists && inside.bound == SectionBound::None && inside.phi2 >= edge.phi2 - angle_round_off) return inside;
  }
  return edge;
}

/// Halves intervals of the face in which a maximum that the slopes at both ends do not show, or a second one, could
/// exceed the highest angle known. Kinks only bend the section maxima downwards, so with hollow curvature c they stay
/// below
///
///     f(a) + f'(a) x + c x^2/2     and     f(b) - f'(b)(h - x) + c (h - x)^2/2,      x from a to b = a + h
void FaceSearch::reveal_hidden_maxima(std::vector<SectionMaximum>& sections, double highest) const {
  const double longest = assembly_.pinion.face.width() / (density_.sections - 1);
  const double c = density_.hollow_curvature / assembly_.wheel.base_radius;
  for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
    while (true) {
      const SectionMaximum &a = sections[i], &b = sections[i + 1];
      const double h = b.z - a.z;
      const bool announced = a.slope_z > 0.0 && b.slope_z < 0.0;
      if (!a.exists || !b.exists || (announced && c == 0.0)) break;
      if (!(h > longest * (announced ? announced_share : hidden_share))) break;
      // The bounds differ by a straight line: where they meet, the lower of them is highest.
      const double slope = a.slope_z - b.slope_z + c * h;
      if (slope == 0.0) break;  // nowhere
      const double meet = (b.phi2 - a.phi2 - b.slope_z * h + 0.5 * c * h * h) / slope;
      if (!(meet > 0.0 && meet < h)) break;
      if (a.phi2 + a.slope_z * meet + 0.5 * c * meet * meet <= highest + coarse_error) break;
      const SectionMaximum middle = search_.at(0.5 * (a.z + b.z), a, SectionAccuracy::Coarse);
      highest = std::max(highest, middle.phi2);
      sections.insert(sections.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
    }
  }
}

/// The maximum between a section and the next one uphill, or the end of the flank before that.
SectionMaximum FaceSearch::ascend(const SectionMaximum& from, const SectionMaximum& next) const {
  // Past the end of a flank counts as downhill.
  const auto downhill = [&](SectionMaximum s) {
    if (!s.exists) s.slope_z = -from.slope_z;
    return s;
  };
  const auto evaluate = [&](double z, const SectionMaximum* last) {
    return downhill(search_.at(z, last && last->exists ? *last : from, SectionAccuracy::Full));
  };
  const bool upwards = from.slope_z > 0.0;
  const SectionMaximum end = downhill(next);
  const SectionMaximum &rising = upwards ? from : end, &falling = upwards ? end : from;
  const double fall = rising.slope_z - falling.slope_z;
  double guess = rising.z + (falling.z - rising.z) * rising.slope_z / fall;
  if (end.exists && from.bound != end.bound && condition_.roll_rate() != 0.0) {
    // Up to where the free maximum runs into the bound the slope changes little, from there on fast.
    const SectionMaximum &free = from.bound == SectionBound::None ? from : end, &held = &free == &from ? end : from;
    guess = std::clamp(free.z + (held.at.rho - free.at.rho) / condition_.roll_rate(), rising.z, falling.z);
  }
  const Peak<SectionMaximum> peak =
      find_peak<SectionMaximum>(evaluate, rising.z, falling.z, guess, fall / (falling.z - rising.z), face_tolerance, rising, falling);
  SectionMaximum top = peak.top;
  if (top.z == from.z || top.z == end.z) top = evaluate(top.z, &top);  // those were coarse
  if (peak.rising->exists && peak.falling->exists) {
    // On a kink along the face (start of an end relief) both sides hold their share, as in a section.
    if (const auto share = peak.share_of_falling()) {
      top.slope_phi1 = (1.0 - *share) * peak.rising->slope_phi1 + *share * peak.falling->slope_phi1;
    }
  }
  if (top.phi2 >= from.phi2) return top;
  // A maximum almost on the section that it started from, or one that only seemed lower there.
  const SectionMaximum start = search_.at(from.z, from, SectionAccuracy::Full);
  return top.phi2 >= start.phi2 ? top : start;
}

bool FaceSearch::is_flat_around(const SectionMaximum& best) const {
  for (const double side : {-1.0, 1.0}) {
    const double z = best.at.z + side * flat_step();
    if (!assembly_.pinion.face.holds(z)) continue;
    const SectionMaximum neighbour = search_.at(z, best, SectionAccuracy::Coarse);
    if (neighbour.at.on_wheel_end) continue;  // beyond the wheel's face it is the end's point again
    if (neighbour.exists && neighbour.bound == best.bound && (best.phi2 - neighbour.phi2) * assembly_.wheel.base_radius <= flat_tolerance) {
      return true;
    }
  }
  return false;
}

ContactKind FaceSearch::kind_of(const SectionMaximum& best) const {
  const bool flat = is_flat_around(best);
  const bool on_face_end = !flat && is_held_by_face_end(best);
  if (best.bound != SectionBound::None && on_face_end) return ContactKind::Corner;
  switch (best.bound) {
    case SectionBound::PinionRoot:
      return ContactKind::PinionRoot;
    case SectionBound::PinionTip:
      return ContactKind::PinionTip;
    case SectionBound::WheelRoot:
      return ContactKind::WheelRoot;
    case SectionBound::WheelTip:
      return ContactKind::WheelTip;
    case SectionBound::None:
      break;
  }
  if (flat) return ContactKind::Line;
  return on_face_end ? ContactKind::FaceEnd : ContactKind::Surface;
}

}  // namespace

ToothContact ToothContactSolver::find(int tooth, double phi1) const {
  ToothContact contact;
  contact.tooth = tooth;
  contact.phi1 = phi1;
  const FaceSearch problem(assembly_, density_, tooth, phi1);
  const SectionMaximum best = problem.solve();
  if (!best.exists) return contact;
  contact.kind = problem.kind_of(best);
  contact.phi2 = best.phi2;
  contact.transmission_error = best.phi2 - assembly_.speed_ratio() * phi1;
  contact.slope = best.slope_phi1 - assembly_.speed_ratio();
  contact.pinion_radius = std::hypot(assembly_.pinion.base_radius, best.at.rho);
  contact.pinion_z = best.at.z;
  contact.wheel_radius = best.at.wheel_radius;
  contact.wheel_z = best.at.wheel_z;
  return contact;
}

ToothContact find_tooth_contact(const FlankAssembly& assembly, int tooth, double phi1) { return ToothContactSolver(assembly).find(tooth, phi1); }

const char* to_string(ContactKind kind) {
  switch (kind) {
    case ContactKind::None:
      return "none";
    case ContactKind::Line:
      return "line";
    case ContactKind::Surface:
      return "surface";
    case ContactKind::PinionTip:
      return "pinion_tip";
    case ContactKind::WheelTip:
      return "wheel_tip";
    case ContactKind::PinionRoot:
      return "pinion_root";
    case ContactKind::WheelRoot:
      return "wheel_root";
    case ContactKind::FaceEnd:
      return "face_end";
    case ContactKind::Corner:
      return "corner";
  }
  __builtin_unreachable();
}

}  // namespace flankwright
