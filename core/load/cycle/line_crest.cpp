#include "core/load/cycle/line_crest.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/root.hpp"
#include "core/base/smooth_interpolation.hpp"
#include "core/contact/gap/flank_touch_search.hpp"
#include "core/contact/path/path_of_contact.hpp"

namespace flankwright {

namespace {

/// The place of a start is enclosed to this part of the distance between two points.
constexpr double enclosed = 1e-13;
/// Derivatives along the line are one-sided differences over this part of it, on the side without relief.
constexpr double along = 1e-3;
/// How far beside a start the gap's slopes are taken, on the side without relief, as a part of the distance between two points.
constexpr double beside_start = 1e-9;
/// Derivatives of distances by extents and by a twist compensation are central differences over this [mm; -]: distances are linear in them.
constexpr double extent_step = 1e-3;
/// Likewise by numbers of a misalignment [mm or rad]: places slide in proportion to them.
constexpr double misalignment_step = 1e-4;

/// A position's lines, with the flanks' starts on them.
class Lines {
 public:
  explicit Lines(const LoadedLines& lines) : lines_(lines), path_(lines.model.pair) {
    if (!lines.at.outside.empty()) lines.at.outside.add_to(outside_ = Eigen::VectorXd::Zero(lines.line_load.size()), lines.force);
  }

  /// A line's points.
  struct Line {
    std::size_t begin, end;
    std::vector<double> z;
  };
  Line line_from(std::size_t begin) const {
    Line line{begin, begin, {}};
    for (const std::vector<ContactPoint>& points = lines_.at.points; line.end < points.size() && points[line.end].tooth == points[begin].tooth;
         ++line.end) {
      line.z.push_back(points[line.end].z);
    }
    return line;
  }
  Line line_of(std::size_t point) const {
    while (point > 0 && lines_.at.points[point - 1].tooth == lines_.at.points[point].tooth) --point;
    return line_from(point);
  }

  /// How far a gear's places are slid at a point and the next, see FlankTouch::slid.
  using Slid = std::array<double, 2>;
  Slid slid(Member gear, std::size_t point) const { return {lines_.gap.touches[point].slid[gear], lines_.gap.touches[point + 1].slid[gear]}; }

  /// Distances beyond the starts of a gear between a point and the next, at this part of the way.
  std::array<double, ReliefStarts::count> beyond(Member gear, const ReliefStarts& starts, std::size_t point, double way) const {
    return beyond(gear, starts, point, way, slid(gear, point));
  }
  std::array<double, ReliefStarts::count> beyond(Member gear, const ReliefStarts& starts, std::size_t point, double way, const Slid& slid) const {
    const auto between = [way](double a, double b) { return a + way * (b - a); };
    const double roll = between(roll_at(gear, point, slid[0]), roll_at(gear, point + 1, slid[1]));
    return beyond_at(gear, starts, roll, between(lines_.at.points[point].z, lines_.at.points[point + 1].z));
  }
  /// The same at a point.
  std::array<double, ReliefStarts::count> beyond(Member gear, const ReliefStarts& starts, std::size_t point) const {
    return beyond_at(gear, starts, roll_at(gear, point, lines_.gap.touches[point].slid[gear]), lines_.at.points[point].z);
  }

  /// A crest's place, a little on the side without relief: what moves the start opens the gap on the other side alone.
  ContactPoint beside(const LineCrest& crest) const {
    const auto point = static_cast<std::size_t>(crest.before);
    const std::vector<ContactPoint>& points = lines_.at.points;
    const double z = std::lerp(points[point].z, points[point + 1].z, crest.way + (crest.rises ? -beside_start : beside_start));
    return contact_point(lines_.model.pair, path_, lines_.at.phase, points[point].tooth, z, true).value_or(crest.place);
  }

  /// The crest at a place of a line between a point and the next, but for its start; nothing where no contact can be.
  std::optional<LineCrest> crest(const Line& line, const ToothGap& gap, std::size_t point, double way) const {
    const std::size_t k = point - line.begin;
    const double z = line.z[k] + way * (line.z[k + 1] - line.z[k]);
    const auto place = contact_point(lines_.model.pair, path_, lines_.at.phase, lines_.at.points[point].tooth, z, true);
    if (!place) return std::nullopt;
    const InterpolationWeights weights = smooth_interpolation(line.z, k, z);
    LineCrest crest{.place = *place, .before = static_cast<Eigen::Index>(point), .way = way, .count = weights.count};
    double smooth = 0.0;
    for (std::size_t j = 0; j < weights.count; ++j) {
      const auto i = static_cast<Eigen::Index>(line.begin + weights.first + j);
      crest.from[j] = {i, weights.weight[j]};
      smooth += weights.weight[j] * (lines_.structural[i] + (outside_.size() > 0 ? outside_[i] : 0.0));
      crest.seen_load += weights.weight[j] * lines_.line_load[i];
    }
    const double other = way * loaded(point + 1), one = (1.0 - way) * loaded(point), sum = one + other;
    crest.approach_shares[0] = sum > 0.0 ? one / sum : loaded(point);
    crest.approach_shares[1] = 1.0 - crest.approach_shares[0];
    crest.deflection = -smooth - gap.at(*place);
    for (std::size_t j = 0; j < 2; ++j) {
      if (crest.approach_shares[j] > 0.0) crest.deflection += crest.approach_shares[j] * approach(point + j);
    }
    crest.compliance = compliance_between(line, k);
    return crest;
  }

 private:
  double loaded(std::size_t i) const { return lines_.line_load[static_cast<Eigen::Index>(i)] > 0.0 ? 1.0 : 0.0; }
  /// c + s + g of a loaded point
  double approach(std::size_t i) const {
    const auto row = static_cast<Eigen::Index>(i);
    return lines_.laws[i].deflection(lines_.line_load[row]) + lines_.structural[row] + lines_.gap.total[row];
  }
  double radius_of(std::size_t i, Member gear) const {
    const ContactPoint& point = lines_.at.points[i];
    return gear == Member::Pinion ? point.pinion_radius : point.wheel_radius;
  }
  /// Roll length of a point's place on a gear, slid along the profile.
  double roll_at(Member gear, std::size_t i, double slid) const {
    const double base = lines_.model.pair[gear].base_radius, radius = radius_of(i, gear), along_profile = gear == Member::Wheel ? 1.0 : -1.0;
    return std::sqrt(std::max(0.0, (radius - base) * (radius + base) + 2.0 * along_profile * base * slid));
  }
  std::array<double, ReliefStarts::count> beyond_at(Member gear, const ReliefStarts& starts, double roll, double z) const {
    const double base = lines_.model.pair[gear].base_radius;
    return starts.beyond(std::sqrt(base * base + roll * roll), gear == Member::Wheel ? z - lines_.model.placement.misalignment.axial_offset : z);
  }

  /// kappa between point k of a line and the next.
  double compliance_between(const Line& line, std::size_t k) const {
    const auto influence = [&](std::size_t i, std::size_t j) {
      return lines_.at.influence(static_cast<Eigen::Index>(line.begin + i), static_cast<Eigen::Index>(line.begin + j));
    };
    const auto own_influence = [&](std::size_t i) {
      const auto row = static_cast<Eigen::Index>(line.begin + i);
      const Eigen::VectorXd& taken_back = lines_.at.even_load_compliance;
      return influence(i, i) + (taken_back.size() > 0 ? taken_back[row] / lines_.at.weight[row] : 0.0);
    };
    const double own = 0.5 * (own_influence(k) + own_influence(k + 1));
    if (!lines_.model.couples_points) return own * 0.5 * lines_.at.weight.segment<2>(static_cast<Eigen::Index>(line.begin + k)).sum();
    const std::size_t n = line.z.size();
    const double before = k > 0 ? influence(k - 1, k + 1) : 0.0, after = k + 2 < n ? influence(k, k + 2) : 0.0;
    const double next = k == 0 ? after : k + 2 == n ? before : 0.5 * (before + after);
    const double structure = 0.5 * std::max(0.0, own - next) * (line.z[k + 1] - line.z[k]) / std::cos(lines_.model.pair.base_helix_angle);
    return std::max(structure - even_load_compliance(line.begin + k), -0.5 * least_slope(line.begin + k));
  }

  /// Between a point and the next, what contact takes back of their loads.
  double even_load_compliance(std::size_t point) const {
    const Eigen::VectorXd& taken_back = lines_.at.even_load_compliance;
    return taken_back.size() > 0 ? taken_back.segment<2>(static_cast<Eigen::Index>(point)).mean() : 0.0;
  }
  /// The smallest slope dc/dw of the laws of a point and the next, under the larger of their loads.
  double least_slope(std::size_t point) const {
    const double most = lines_.line_load.segment<2>(static_cast<Eigen::Index>(point)).maxCoeff();
    return std::min(lines_.laws[point].slope(most), lines_.laws[point + 1].slope(most));
  }

  const LoadedLines& lines_;
  PathOfContact path_;
  Eigen::VectorXd outside_;  ///< what other forces open; empty: nothing
};

struct LawLoad {
  double load, by_deflection;
};

/// c(w) + kappa (w - w_s) = deflection
LawLoad load_of(const ContactLaw& law, const LineCrest& crest) {
  const double budget = crest.deflection + crest.compliance * crest.seen_load;
  if (!(budget > 0.0)) return {0.0, 0.0};
  // Newton's steps: the left side rises with w and is concave.
  constexpr double last_change = 1e-14;
  constexpr int most_steps = 100;
  double w = crest.seen_load > 0.0 ? crest.seen_load : 1.0;
  for (int step = 0; step < most_steps; ++step) {
    const ContactLaw::Response here = law.evaluate(w);
    const double change = (budget - here.deflection - crest.compliance * w) / (here.slope + crest.compliance);
    w = std::max(w + change, 0.5 * w);
    if (std::abs(change) <= last_change * w) break;
  }
  return {w, 1.0 / (law.slope(w) + crest.compliance)};
}

bool has_starts(const PairReliefStarts& starts) {
  const auto any = [](const ReliefStarts& of) { return std::ranges::any_of(of.beyond(1.0, 0.0), [](double d) { return std::isfinite(d); }); };
  return any(starts.pinion) || any(starts.wheel);
}

}  // namespace

PairReliefStarts relief_starts(const GearPair& pair, const FlankCondition& condition) {
  return {{pair, Member::Pinion, condition.modification.pinion}, {pair, Member::Wheel, condition.modification.wheel}};
}

std::vector<LineCrest> line_crests(const LoadedLines& lines) {
  std::vector<LineCrest> crests;
  if (lines.laws.empty() || !has_starts(lines.starts)) return crests;
  const Lines all(lines);
  const auto load = [&](std::size_t i) { return lines.line_load[static_cast<Eigen::Index>(i)]; };
  const auto reaches_edge = [&](std::size_t i) { return lines.laws[i].reaches_edge(load(i)); };
  for (std::size_t begin = 0; begin < lines.at.points.size();) {
    const Lines::Line line = all.line_from(begin);
    begin = line.end;
    std::optional<ToothGap> gap;
    for (const Member gear : {Member::Pinion, Member::Wheel}) {
      const ReliefStarts& starts = lines.starts[gear];
      std::optional<std::array<double, ReliefStarts::count>> last;  // of point i, where it is known
      for (std::size_t i = line.begin; i + 1 < line.end; ++i) {
        const bool is_loaded = (load(i) > 0.0 || load(i + 1) > 0.0) && !reaches_edge(i) && !reaches_edge(i + 1);
        if (!is_loaded) {
          last.reset();
          continue;
        }
        const auto here = last ? *last : all.beyond(gear, starts, i), next = all.beyond(gear, starts, i + 1);
        for (std::size_t s = 0; s < ReliefStarts::count; ++s) {
          if (!std::isfinite(here[s]) || (here[s] < 0.0) == (next[s] < 0.0)) continue;
          const auto distance = [&](double way) { return all.beyond(gear, starts, i, way)[s]; };
          const double way = bracketed_root(distance, 0.0, here[s], 1.0, next[s], enclosed).x;
          if (!gap) gap.emplace(lines.gaps, lines.at.points[line.begin].tooth, lines.at.phase);
          auto crest = all.crest(line, *gap, i, way);
          if (!crest) continue;
          crest->gear = gear;
          crest->start = s;
          crest->rises = next[s] > here[s];
          crests.push_back(std::move(*crest));
        }
        last = next;
      }
    }
  }
  return crests;
}

CrestLoad load_on_crest(const std::vector<ContactLaw>& laws, const LineCrest& crest) {
  CrestLoad found;
  for (const auto& [point, share] : {std::pair{crest.before, 1.0 - crest.way}, std::pair{crest.before + 1, crest.way}}) {
    const ContactLaw& law = laws[static_cast<std::size_t>(point)];
    const auto [load, by_deflection] = load_of(law, crest);
    const StripContact::Peak peak = law.peak_pressure(load).highest;
    found.line_load += share * load;
    found.load_by_deflection += share * by_deflection;
    found.pressure += share * peak.pressure;
    found.by_deflection += share * peak.slope * by_deflection;
  }
  return found;
}

namespace {

/// Whether a parameter of a gear moves the starts of its reliefs over the flank: an extent, or what the process leaves of its shift.
bool moves_starts(ModificationParameter parameter) {
  const ParameterKind kind = describe(parameter).kind;
  return kind == ParameterKind::Extent || kind == ParameterKind::Fraction;
}

/// d(way)/dp where the parameter moves the start along the line; 0 where it does not.
double way_slope(const Lines& all, const LoadedLines& lines, const LineCrest& crest, const MeshParameter& parameter) {
  const auto point = static_cast<std::size_t>(crest.before);
  const FlankCondition& condition = lines.gaps.condition();
  const Lines::Slid slid = all.slid(crest.gear, point);
  const auto distance = [&](const Modification& modification, double way, const Lines::Slid& moved) {
    return all.beyond(crest.gear, {lines.model.pair, crest.gear, modification}, point, way, moved)[crest.start];
  };
  const Modification& own = condition.modification[crest.gear];
  double change = 0.0;  // of the distance by the parameter
  if (const auto* of_gear = std::get_if<GearParameter>(&parameter)) {
    if (of_gear->member != crest.gear || !moves_starts(of_gear->parameter)) return 0.0;
    const auto with = [&](double by) {
      Modification moved = own;
      set(moved, of_gear->parameter, get(moved, of_gear->parameter) + by);
      return distance(moved, crest.way, slid);
    };
    change = (with(extent_step) - with(-extent_step)) / (2.0 * extent_step);
  } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&parameter)) {
    if (moves_mesh(lines.gaps.model(), parameter)) return 0.0;
    const std::vector<ContactPoint> points{lines.at.points[point], lines.at.points[point + 1]};
    const auto with = [&](double by) {
      FlankCondition moved = condition;
      moved.misalignment.*(*misalignment) += by;
      const std::vector<FlankTouch> touches = FlankTouchSearch(lines.model.pair, moved).at(points);
      return distance(own, crest.way, {touches[0].slid[crest.gear], touches[1].slid[crest.gear]});
    };
    change = (with(misalignment_step) - with(-misalignment_step)) / (2.0 * misalignment_step);
  }
  if (change == 0.0) return 0.0;
  return -change * 2.0 * along / (distance(own, crest.way + along, slid) - distance(own, crest.way - along, slid));
}

}  // namespace

CrestSlopes crest_slopes(const LoadedLines& lines, const std::vector<LineCrest>& crests, const PointSlopes& slopes,
                         const ConditionSlopes& condition) {
  const Eigen::Index n = std::ssize(crests), m = slopes.line_load.cols();
  CrestSlopes by{Eigen::MatrixXd(n, m), Eigen::MatrixXd::Zero(n, m), Eigen::MatrixXd::Zero(n, m)};
  if (n == 0 || m == 0) return by;
  const Lines all(lines);
  MeshPosition places;
  places.phase = lines.at.phase;
  const Eigen::VectorXd& opened = lines.at.outside.by_force;
  if (opened.size() > 0) places.outside.by_force = Eigen::VectorXd::Zero(std::ssize(crests));
  for (const LineCrest& crest : crests) {
    for (std::size_t k = 0; k < crest.count && opened.size() > 0; ++k) {
      places.outside.by_force[std::ssize(places.points)] += crest.from[k].weight * opened[crest.from[k].index];
    }
    places.points.push_back(all.beside(crest));
  }
  const Gap gap = lines.gaps.at(places.points, lines.at.phase);
  const Eigen::MatrixXd gap_slopes = condition.at(places, gap).gap;
  const Eigen::MatrixXd forces = lines.at.weight.asDiagonal() * slopes.line_load;
  for (Eigen::Index i = 0; i < n; ++i) {
    const LineCrest& crest = crests[static_cast<std::size_t>(i)];
    Eigen::RowVectorXd influence = Eigen::RowVectorXd::Zero(forces.rows()), seen = Eigen::RowVectorXd::Zero(m);
    for (std::size_t k = 0; k < crest.count; ++k) {
      influence += crest.from[k].weight * lines.at.influence.row(crest.from[k].index);
      seen += crest.from[k].weight * slopes.line_load.row(crest.from[k].index);
    }
    by.deflection.row(i) = crest.compliance * seen - gap_slopes.row(i);
    for (Eigen::Index j = 0; j < 2; ++j) {
      const double share = crest.approach_shares[static_cast<std::size_t>(j)];
      if (share == 0.0) continue;
      const Eigen::Index k = crest.before + j;
      influence -= share * lines.at.influence.row(k);
      by.deflection.row(i) +=
          share * (lines.laws[static_cast<std::size_t>(k)].slope(lines.line_load[k]) * slopes.line_load.row(k) + slopes.gap.row(k));
    }
    by.deflection.row(i) -= influence * forces;
    Eigen::RowVectorXd ways(m);
    for (Eigen::Index p = 0; p < m; ++p) ways[p] = way_slope(all, lines, crest, condition.parameters()[static_cast<std::size_t>(p)]);
    if (ways.isZero(0.0)) continue;
    const auto point = static_cast<std::size_t>(crest.before);
    const Lines::Line line = all.line_of(point);
    const ToothGap tooth_gap(lines.gaps, lines.at.points[point].tooth, lines.at.phase);
    const double step = crest.rises ? -along : along;
    const auto one = all.crest(line, tooth_gap, point, crest.way + step), two = all.crest(line, tooth_gap, point, crest.way + 2.0 * step);
    if (!one || !two) continue;
    const CrestLoad here = load_on_crest(lines.laws, crest), near = load_on_crest(lines.laws, *one), far = load_on_crest(lines.laws, *two);
    const auto along_line = [step](double at, double first, double second) { return (4.0 * (first - at) - (second - at)) / (2.0 * step); };
    by.load.row(i) = along_line(here.line_load, near.line_load, far.line_load) * ways;
    by.pressure.row(i) = along_line(here.pressure, near.pressure, far.pressure) * ways;
  }
  return by;
}

}  // namespace flankwright
