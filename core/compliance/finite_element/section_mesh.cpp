#include "core/compliance/finite_element/section_mesh.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <ranges>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/finite_element/ring_division.hpp"
#include "core/compliance/finite_element/section_builder.hpp"

namespace flankwright {
namespace {

using units::pi;

constexpr double kWidest = 24 * units::deg;  // of one quadratic element around the axis

/// Polar coordinates, the angle counter-clockwise from +y.
struct Polar {
  double radius, angle;
  Eigen::Vector2d point() const { return {-radius * std::sin(angle), radius * std::cos(angle)}; }
};

Polar blend(const Polar& a, const Polar& b, double t) { return {a.radius + t * (b.radius - a.radius), a.angle + t * (b.angle - a.angle)}; }

/// One half tooth at half steps from the tip to the middle of the gap; angles of the left half (> 0).
struct HalfTooth {
  std::vector<Polar> profile, inner;
  int corner{0};    ///< step where the inner line turns from the centre line onto the rim's circle
  int involute{0};  ///< step where the fillet starts
  int fillet{0};    ///< step nearest to the fillet's lowest point, at or below it
  int steps() const { return static_cast<int>(profile.size() - 1) / 2; }
};

/// Points of the curve from the start of the fillet to the middle of the gap, at equal steps of arc length. The
/// junction of fillet and land is kept as a corner node unless the land is too short for an element of its own.
class RootCurve {
 public:
  RootCurve(const ToothForm& form, int teeth) : form_(form), gap_(pi / teeth) {
    constexpr int kSamples = 400;  // chords of the fillet, for their length only
    lambda_.push_back(form.fillet_start());
    length_.push_back(0);
    ProfilePoint last = form.fillet_point(form.fillet_start());
    for (int i = 1; i <= kSamples; ++i) {
      lambda_.push_back(form.fillet_start() + (pi / 2 - form.fillet_start()) * i / kSamples);
      const ProfilePoint p = form.fillet_point(lambda_.back());
      length_.push_back(length_.back() + std::hypot(p.x - last.x, p.y - last.y));
      last = p;
    }
    land_start_ = std::atan2(last.x, last.y);
    land_ = std::max(0.0, form.root_radius() * (gap_ - land_start_));
  }

  double fillet_length() const { return length_.back(); }
  double land_length() const { return land_; }

  Polar at(double s) const {
    if (s >= fillet_length()) {
      const double t = land_ > 0 ? std::min(1.0, (s - fillet_length()) / land_) : 1;
      return {form_.root_radius(), land_start_ + t * (gap_ - land_start_)};
    }
    const auto above = std::upper_bound(length_.begin(), length_.end(), s) - length_.begin();
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(length_) - 1));
    const double t = (s - length_[i - 1]) / (length_[i] - length_[i - 1]);
    const ProfilePoint p = form_.fillet_point(lambda_[i - 1] + t * (lambda_[i] - lambda_[i - 1]));
    return {std::hypot(p.x, p.y), std::atan2(p.x, p.y)};
  }
  double tangent_angle(double s) const {
    if (s >= fillet_length()) return pi / 2;
    const auto above = std::upper_bound(length_.begin(), length_.end(), s) - length_.begin();
    return form_.fillet_point(lambda_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, above - 1))]).tangent_angle;
  }

 private:
  const ToothForm& form_;
  double gap_;
  std::vector<double> lambda_, length_;
  double land_start_, land_;
};

HalfTooth half_tooth(const ToothForm& form, int teeth, double rim_radius, int flank_elements, int fillet_elements) {
  // Size at the tip over the mean one: loads are felt over a distance as the thickness is.
  constexpr double kAtTip = 0.6;
  HalfTooth half;
  for (int i = 0; i <= 2 * flank_elements; ++i) {
    const double t = i / (2.0 * flank_elements), drop = t * (kAtTip + (1 - kAtTip) * t);
    const double radius = form.tip_radius() + (form.form_radius() - form.tip_radius()) * drop;
    half.profile.push_back({radius, form.half_angle(std::max(radius, form.form_radius()))});
  }
  half.involute = flank_elements;

  const RootCurve root(form, teeth);
  const double element = root.fillet_length() / fillet_elements;
  const bool has_land = root.land_length() > 0.3 * element;  // otherwise the last fillet element reaches across it
  const int land_elements = has_land ? std::max(1, static_cast<int>(std::lround(root.land_length() / element))) : 0;
  const double fillet_end = root.fillet_length() + (has_land ? 0 : root.land_length());
  half.corner = -1;
  const auto add = [&](double begin, double end, int elements) {
    for (int i = 1; i <= 2 * elements; ++i) {
      const double s = begin + (end - begin) * i / (2 * elements);
      half.profile.push_back(root.at(s));
      // The fan of elements around the corner of the inner line is most even where the fillet leans by 45 deg; later
      // corners leave fewer elements around the body.
      if (half.corner < 0 && i % 2 == 0 && root.tangent_angle(s) > 70 * units::deg) half.corner = half.steps();
    }
  };
  add(0, fillet_end, fillet_elements);
  half.fillet = half.steps();
  if (has_land) add(fillet_end, fillet_end + root.land_length(), land_elements);
  half.profile.back().angle = pi / teeth;
  half.corner = std::min(half.corner < 0 ? half.steps() : half.corner, half.steps() - 1);

  const auto height = [&](int i) { return half.profile[i].radius * std::cos(half.profile[i].angle); };
  const int turn = 2 * half.corner;
  for (int i = 0; i <= turn; ++i) {
    const double t = (height(i) - height(turn)) / (height(0) - height(turn));
    half.inner.push_back({rim_radius + t * (form.tip_radius() - rim_radius), 0});
  }
  const int last = 2 * half.steps();
  for (int i = turn + 1; i <= last; ++i) half.inner.push_back({rim_radius, pi / teeth * (i - turn) / (last - turn)});
  return half;
}

/// Sizes that start at `first` and grow by `growth` until they fill `length`, scaled to fit; as fractions of length.
std::vector<double> graded(double length, double first, double growth, double largest) {
  std::vector<double> ends{0};
  for (double size = first; ends.back() < length * (1 - 1e-12); size = std::min(size * growth, largest)) {
    ends.push_back(ends.back() + size);
  }
  // The last element is dropped where more than half of it sticks out.
  if (ends.size() > 2 && ends.back() - length > length - ends[ends.size() - 2]) ends.pop_back();
  for (double& end : ends) end /= ends.back();
  ends.back() = 1;
  return ends;
}

/// Rings from the teeth's blocks down to the shaft, as fractions of their distance: sizes grow from both ends, where
/// loads enter and where the shaft carries them, but stay in proportion to the radius, like the stress of a torque that
/// flows to the shaft.
std::vector<double> ring_fractions(double outer, double inner, double first_outside, double first_inside, double growth) {
  constexpr double kOfRadius = 0.35;
  std::vector<double> from_outside{outer}, from_inside{inner};
  double outside = first_outside, inside = first_inside;
  while (true) {
    const double gap = from_outside.back() - from_inside.back();
    const double below = std::min(outside, kOfRadius * from_outside.back()), above = std::min(inside, kOfRadius * from_inside.back());
    const double next = std::min(below, above);
    if (gap <= 1.5 * next) {  // the last ring, or too little for one
      if (gap < 0.5 * next && from_outside.size() > 1) from_outside.pop_back();
      break;
    }
    if (below <= above) {
      from_outside.push_back(from_outside.back() - below);
      outside *= growth;
    } else {
      from_inside.push_back(from_inside.back() + above);
      inside *= growth;
    }
  }
  std::vector<double> ends;
  for (const double radius : from_outside) ends.push_back((outer - radius) / (outer - inner));
  for (const double radius : from_inside | std::views::reverse) ends.push_back((outer - radius) / (outer - inner));
  return ends;
}

/// Rings from the shaft's surface to the bore, as fractions of their distance, each four times as thick as the one before:
/// the stress that body and shaft exchange stays near the surface between them, above all where the gear's faces end on it.
std::vector<double> shaft_fractions(int rings) {
  constexpr double kGrowth = 4;
  std::vector<double> ends;
  for (int i = 0; i <= rings; ++i) ends.push_back((std::pow(kGrowth, i) - 1) / (std::pow(kGrowth, rings) - 1));
  return ends;
}

/// Elements from the teeth's inner line to their surface, as fractions of the way. Below the fillet, whose stress falls
/// off over a fraction of its radius, each is 1.5 times as thick as the next one outwards; along the flank this ratio
/// falls to 1 at the tip, where the elements at the centre, through which loads enter, matter as much.
/// @param of_flank  0 at the tip, 1 from the start of the fillet on
std::vector<double> half_thickness_fractions(int elements, double of_flank) {
  constexpr double kBelowFillet = 1.5;
  const double growth = 1 + (kBelowFillet - 1) * of_flank;
  std::vector<double> ends{0};
  for (int i = elements; i-- > 0;) ends.push_back(ends.back() + std::pow(growth, i));
  for (double& end : ends) end /= ends.back();
  ends.back() = 1;
  return ends;
}

/// Fractions at half steps.
double at_half_step(const std::vector<double>& fractions, int i) {
  return i % 2 == 0 ? fractions[i / 2] : 0.5 * (fractions[i / 2] + fractions[i / 2 + 1]);
}

}  // namespace

void GearMeshOptions::validate() const {
  const auto at_least = [](const char* field, int value, int least) {
    if (value < least) throw InvalidInput(field, std::to_string(value), "at least " + std::to_string(least));
  };
  at_least("options.flank_elements", flank_elements, 1);
  at_least("options.fillet_elements", fillet_elements, 2);
  at_least("options.half_thickness_elements", half_thickness_elements, 1);
  at_least("options.adjacent_flank_elements", adjacent_flank_elements, 1);
  at_least("options.adjacent_fillet_elements", adjacent_fillet_elements, 2);
  at_least("options.teeth_each_side", teeth_each_side, 1);
  at_least("options.most_layers", most_layers, 4);
  at_least("options.shaft_elements", shaft_elements, 1);
  const auto more_than = [](const char* field, double value, double bound) {
    if (!(value > bound)) throw InvalidInput(field, std::to_string(value), "more than " + std::to_string(bound));
  };
  more_than("options.end_element", end_element, 0);
  more_than("options.axial_growth", axial_growth, 1);
  more_than("options.body_growth", body_growth, 1);
  if (!(layer_share >= 0)) throw InvalidInput("options.layer_share", std::to_string(layer_share), "at least 0");
  if (!(largest_element >= end_element)) {
    throw InvalidInput("options.largest_element", std::to_string(largest_element), "at least options.end_element");
  }
}

BodyRadii section_radii(const ToothForm& form, int teeth, double normal_module, double face_width, const GearBody& body,
                        const GearMeshOptions& options) {
  options.validate();
  if (!(form.tip_half_angle() > 0)) {
    throw InvalidInput("tip_diameter", std::to_string(2 * form.tip_radius()), "a tooth that is not pointed");
  }
  if (2 * options.teeth_each_side + 1 > teeth) {
    throw InvalidInput("options.teeth_each_side", std::to_string(options.teeth_each_side), "at most half the number of teeth");
  }
  return body_radii(body, form, normal_module, face_width);
}

SectionMesh section_mesh(const ToothForm& form, int teeth, double normal_module, double face_width, const GearBody& body,
                         const GearMeshOptions& options) {
  const BodyRadii radii = section_radii(form, teeth, normal_module, face_width, body, options);
  const double root = form.root_radius(), rim = radii.teeth;
  const int across = options.half_thickness_elements;
  const std::vector<double> below_fillet = half_thickness_fractions(across, 1);
  const double same_point = 1e-7 * normal_module;
  SectionBuilder builder(same_point);
  std::vector<SectionTooth> lines;
  std::vector<double> angles;  // of the rim's nodes at half steps, counter-clockwise
  const double pitch = 2 * pi / teeth;
  // Centre lines of the detailed teeth go down to the bore: a load's moments are made up for over all of the centre surface.
  std::vector<double> centres;
  for (int m = -options.teeth_each_side; m <= options.teeth_each_side; ++m) centres.push_back(m * pitch);

  for (int m = -options.teeth_each_side; m <= options.teeth_each_side; ++m) {
    const HalfTooth half = m == 0 ? half_tooth(form, teeth, rim, options.flank_elements, options.fillet_elements)
                                  : half_tooth(form, teeth, rim, options.adjacent_flank_elements, options.adjacent_fillet_elements);
    const auto at = [&](int side, int step, int level) {
      const double of_flank = std::min(1.0, step / (2.0 * half.involute));
      const Polar p = blend(half.inner[step], half.profile[step], at_half_step(half_thickness_fractions(across, of_flank), level));
      return Polar{p.radius, m * pitch + side * p.angle}.point();
    };
    const int steps = half.steps();
    const SectionPart part = m == 0 ? SectionPart::LoadedTooth : SectionPart::Body;
    builder.grid(steps, across, part, [&](int i, int j) { return at(1, i, 2 * across - j); });
    builder.grid(steps, across, part, [&](int i, int j) { return at(-1, 2 * steps - i, 2 * across - j); });

    SectionTooth tooth;
    const auto edge = [&](int side, int step, int level) {
      return SectionEdge{builder.node(at(side, 2 * step, level)), builder.node(at(side, 2 * step + 1, level)),
                         builder.node(at(side, 2 * step + 2, level))};
    };
    for (int i = 0; i < half.corner; ++i) tooth.centre_line.push_back(edge(1, i, 0));
    for (int i = 0; i < half.involute; ++i) tooth.flank.push_back(edge(-1, i, 2 * across));
    for (int i = half.involute; i < half.fillet; ++i) tooth.fillet.push_back(edge(-1, i, 2 * across));
    lines.push_back(std::move(tooth));

    for (int i = 2 * steps; i > 2 * half.corner; --i) angles.push_back(m * pitch - half.inner[i].angle);
    for (int i = 2 * half.corner; i < 2 * steps; ++i) angles.push_back(m * pitch + half.inner[i].angle);
  }

  // Plain ring around the rest, from the last gap on to the first one's next turn.
  const double first = angles.front() + 2 * pi, last = (options.teeth_each_side + 0.5) * pitch;
  if (first - last > 0.5 * pitch) {
    const double half_angle = (first - last) / 2;
    std::vector<double> ring = graded(half_angle, std::min(pitch / 3, half_angle), options.body_growth, kWidest);
    const auto n = static_cast<int>(ring.size()) - 1;
    const auto angle = [&](int i) {
      return i <= 2 * n ? last + half_angle * at_half_step(ring, i) : first - half_angle * at_half_step(ring, 4 * n - i);
    };
    const auto at = [&](int i, int j) { return blend({rim, angle(i)}, {root, angle(i)}, at_half_step(below_fillet, 2 * across - j)).point(); };
    builder.grid(2 * n, across, SectionPart::Body, at);
    for (int i = 0; i < 4 * n; ++i) angles.push_back(angle(i));
  }

  // Rings down to the bore.
  RingDivision around{std::move(angles)};
  std::vector<SectionTie> ties;
  const auto rings = [&](double outer, double inner, const std::vector<double>& fractions, SectionPart part) {
    for (std::size_t ring = 0; ring + 1 < fractions.size(); ++ring) {
      const double from = outer + (inner - outer) * fractions[ring], to = outer + (inner - outer) * fractions[ring + 1];
      const double depth = root - from;
      const double longest = options.layer_share * std::min(depth, from) / from;
      JoinedRing joined = join_neighbours(around, std::min(longest, kWidest), centres);
      for (const int joint : joined.joints) {
        const auto node = [&](int index) { return builder.node(Polar{from, around.angle(index)}.point()); };
        const SectionEdge edge{node(joint - 2), node(joint), node(joint + 2)};
        ties.push_back({node(joint - 1), edge, -0.5, part});
        ties.push_back({node(joint + 1), edge, 0.5, part});
      }
      around = std::move(joined.division);
      const std::array<double, 3> at{from, 0.5 * (from + to), to};
      builder.grid(around.elements(), 1, part, [&](int i, int j) { return Polar{at[static_cast<std::size_t>(j)], around.angle(i)}.point(); });
      for (std::size_t m = 0; m < centres.size(); ++m) {
        const auto node = [&](double radius) { return builder.node(Polar{radius, centres[m]}.point()); };
        lines[m].centre_line.push_back({node(at[0]), node(at[1]), node(at[2])});
      }
    }
  };
  const bool has_shaft = body.hold == BodyHold::Shaft;
  const double at_carrier = has_shaft ? (radii.carrier - radii.bore) * shaft_fractions(options.shaft_elements)[1] : normal_module;
  const auto graded_rings = [&](double outer, double inner, double first_outside, double first_inside, SectionPart part) {
    if (outer - inner > same_point) rings(outer, inner, ring_fractions(outer, inner, first_outside, first_inside, options.body_growth), part);
  };
  if (!body.web) {
    graded_rings(rim, radii.carrier, normal_module, at_carrier, SectionPart::Body);
  } else {
    const WebbedBody& web = *body.web;
    const double at_corner = std::min(normal_module, web.web_thickness / 2);  // where rim or hub meet the web
    graded_rings(rim, radii.underside, normal_module, at_corner, SectionPart::Body);
    if (web.holes.count == 0) {
      graded_rings(radii.underside, radii.hub, at_corner, at_corner, SectionPart::Web);
    } else {
      const double circle = complete_body(body, form, normal_module, face_width).web->holes.circle_diameter / 2, half = web.holes.diameter / 2;
      graded_rings(radii.underside, circle + half, at_corner, web.web_thickness / 2, SectionPart::Web);
      graded_rings(circle + half, circle - half, web.web_thickness / 2, web.web_thickness / 2, SectionPart::HoledWeb);
      graded_rings(circle - half, radii.hub, web.web_thickness / 2, at_corner, SectionPart::Web);
    }
    graded_rings(radii.hub, radii.carrier, at_corner, at_carrier, SectionPart::Hub);
  }
  if (has_shaft) rings(radii.carrier, radii.bore, shaft_fractions(options.shaft_elements), SectionPart::Shaft);

  SectionMesh mesh = builder.take(std::move(lines));
  mesh.root_radius = root;
  mesh.ties = std::move(ties);
  return mesh;
}

}  // namespace flankwright
