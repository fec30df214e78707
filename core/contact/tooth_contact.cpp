#include "core/contact/tooth_contact.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/root.hpp"

namespace flankwright {

namespace {

constexpr int coarse_sections = 17;       // over the face; each is a concave problem of its own
constexpr double flat_tolerance = 1e-9;   // mm along the base tangent, see find_tooth_contact()
constexpr double flat_fraction = 1.0 / 200.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

using Number = Dual<2>;  // derivatives with respect to (rho1, z1)

/// The wheel angle for one pinion point, with derivatives, and where the point lies on the wheel.
struct Candidate {
  Number phi2, wheel_radius, wheel_z;
};

/// Which bound of a section is active at its maximum.
enum class Bound { None, PinionRoot, PinionTip, WheelRoot, WheelTip, WheelFace };

struct SectionMaximum {
  bool exists{false};
  double rho{0.0}, z{0.0};
  double phi2{-infinity};
  double slope{0.0};  ///< d(section maximum)/dz [rad/mm], bounds moving with z included
  Bound bound{Bound::None};
  Candidate at;
};

/// The maximisation for one tooth pair and pinion angle.
class FirstContact {
 public:
  FirstContact(const MeshScene& scene, int tooth, double phi1)
      : scene_(scene),
        tooth_(tooth),
        pinion_rotation_(phi1 + tooth * 2.0 * units::pi / scene.pinion_teeth),
        wheel_advance_(tooth * 2.0 * units::pi / scene.wheel_teeth),
        wheel_rotation_(scene.wheel_axes.transpose()) {}

  SectionMaximum solve() const;
  SectionMaximum section(double z) const;
  double highest_z() const { return scene_.pinion.half_face; }
  bool is_flat_around(const SectionMaximum& best) const;

 private:
  /// Follows the slope of the section maxima from one section to their summit before z = far, or to the flank's end.
  SectionMaximum climb(const SectionMaximum& from, double far) const;

  Candidate candidate(double rho, double z) const {
    const Number r = Number::variable(rho, 0), zz = Number::variable(z, 1);
    const Point3<Number> p = flank_point(scene_.pinion, r, zz, tooth_, pinion_rotation_);
    const Number dx = p.x - scene_.wheel_centre.x(), dy = p.y - scene_.wheel_centre.y(), dz = p.z - scene_.wheel_centre.z();
    const auto component = [&](int row) {
      return wheel_rotation_(row, 0) * dx + wheel_rotation_(row, 1) * dy + wheel_rotation_(row, 2) * dz;
    };
    const Point3<Number> q{component(0), component(1), component(2)};
    const double radius = std::hypot(q.x.value, q.y.value);
    if (radius <= scene_.wheel.base_radius) return {Number(-infinity), Number(radius), q.z};
    const auto through = rotation_through(scene_.wheel, q, tooth_);
    return {-through.rotation - wheel_advance_, through.radius, q.z};
  }

  /// Shrinks [lo, hi] to where `excess` (monotone in rho, <= 0 allowed) holds; false where nothing is left.
  template <class Excess>
  bool clip(const Excess& excess, double& lo, double& hi, Bound bound, Bound& at_lo, Bound& at_hi) const {
    const double e_lo = excess(lo), e_hi = excess(hi);
    if (e_lo <= 0.0 && e_hi <= 0.0) return true;
    if (e_lo > 0.0 && e_hi > 0.0) return false;
    const Root root = bracketed_root(excess, lo, e_lo, hi, e_hi, 1e-13 * scene_.pinion.tip_radius);
    if (e_lo > 0.0) {
      lo = root.upper;
      at_lo = bound;
    } else {
      hi = root.lower;
      at_hi = bound;
    }
    return lo <= hi;
  }

  const MeshScene& scene_;
  int tooth_;
  double pinion_rotation_, wheel_advance_;
  Eigen::Matrix3d wheel_rotation_;
};

SectionMaximum FirstContact::section(double z) const {
  SectionMaximum best;
  best.z = z;
  double lo = scene_.pinion.lowest_roll(), hi = scene_.pinion.highest_roll();
  Bound at_lo = Bound::PinionRoot, at_hi = Bound::PinionTip;
  const Flank& wheel = scene_.wheel;
  const auto wheel_point = [&](double rho) {
    const Point3<double> p = flank_point(scene_.pinion, rho, z, tooth_, pinion_rotation_);
    const Eigen::Vector3d q = wheel_rotation_ * (Eigen::Vector3d(p.x, p.y, p.z) - scene_.wheel_centre);
    return q;
  };
  const auto radius = [&](double rho) { return wheel_point(rho).head<2>().norm(); };
  // Towards the pinion's tip the point approaches the wheel's axis: the radius is monotone in rho.
  if (!clip([&](double rho) { return radius(rho) - wheel.tip_radius; }, lo, hi, Bound::WheelTip, at_lo, at_hi) ||
      !clip([&](double rho) { return wheel.form_radius - radius(rho); }, lo, hi, Bound::WheelRoot, at_lo, at_hi) ||
      !clip([&](double rho) { return std::abs(wheel_point(rho).z()) - wheel.half_face; }, lo, hi, Bound::WheelFace, at_lo,
            at_hi)) {
    return best;
  }
  best.exists = true;
  const auto slope = [&](double rho) { return candidate(rho, z).phi2.gradient[0]; };
  const double slope_lo = slope(lo), slope_hi = slope(hi);
  if (slope_lo <= 0.0) {
    best.rho = lo;
    best.bound = slope_lo < 0.0 ? at_lo : Bound::None;
  } else if (slope_hi >= 0.0) {
    best.rho = hi;
    best.bound = slope_hi > 0.0 ? at_hi : Bound::None;
  }
  const bool inside = slope_lo > 0.0 && slope_hi < 0.0;
  const Root root = inside ? bracketed_root(slope, lo, slope_lo, hi, slope_hi, 1e-13 * scene_.pinion.tip_radius)
                           : Root{best.rho, best.rho, best.rho};
  best.rho = root.x;
  best.at = candidate(best.rho, z);
  best.phi2 = best.at.phi2.value;
  // Envelope theorem: an interior maximum moves freely; one on a wheel bound moves along it with z.
  best.slope = best.at.phi2.gradient[1];
  if (root.lower < root.upper) {
    // One on a kink (start of a linear relief, of the wheel's too) moves along it: continuity of phi2 across the kink makes the
    // slope the mean of both sides' that also makes the slope along rho zero. Without a kink both sides agree.
    const Number below = candidate(root.lower, z).phi2, above = candidate(root.upper, z).phi2;
    const double share = below.gradient[0] / (below.gradient[0] - above.gradient[0]);
    best.slope = (1.0 - share) * below.gradient[1] + share * above.gradient[1];
  }
  const auto follow = [&](const Number& bound) {
    best.slope -= best.at.phi2.gradient[0] * bound.gradient[1] / bound.gradient[0];
  };
  if (best.bound == Bound::WheelTip || best.bound == Bound::WheelRoot) follow(best.at.wheel_radius);
  if (best.bound == Bound::WheelFace) follow(best.at.wheel_z);
  return best;
}

SectionMaximum FirstContact::solve() const {
  // Sections over the face that both gears cover; tilted ends are found by the refinement.
  const double reach = scene_.pinion.half_face;
  const double lo = std::max(-reach, scene_.wheel_centre.z() - scene_.wheel.half_face);
  const double hi = std::min(reach, scene_.wheel_centre.z() + scene_.wheel.half_face);
  if (!(lo < hi)) return {};
  std::array<SectionMaximum, coarse_sections> coarse;
  int best = -1;
  for (int i = 0; i < coarse_sections; ++i) {
    coarse[i] = section(i + 1 == coarse_sections ? hi : lo + i * (hi - lo) / (coarse_sections - 1));
    if (coarse[i].exists && (best < 0 || coarse[i].phi2 > coarse[best].phi2)) best = i;
  }
  if (best < 0) return {};
  // Hollow flanks (metal added at the ends) have several summits: climb every one, from below where both sides exist. A
  // slope that is round-off over the span marks a summit, or a flat valley, by itself.
  const double span = (hi - lo) / (coarse_sections - 1);
  const auto rises = [&](int i, int step) { return coarse[i].slope * step * span > 1e-15; };  // rad
  const auto exists = [&](int i) { return i >= 0 && i < coarse_sections && coarse[i].exists; };
  SectionMaximum top = coarse[best];
  for (int i = 0; i < coarse_sections; ++i) {
    if (!coarse[i].exists) continue;
    for (const int step : {1, -1}) {
      const int next = i + step;
      if (!rises(i, step)) continue;
      if (exists(next) && (rises(next, step) || (step < 0 && rises(next, 1)))) continue;  // on the same climb, or done
      const double far = next < 0 || next >= coarse_sections ? std::clamp(coarse[i].z + step * span, -reach, reach)
                                                             : coarse[next].z;
      const SectionMaximum summit = climb(coarse[i], far);
      if (summit.phi2 > top.phi2) top = summit;
    }
  }
  return top;
}

SectionMaximum FirstContact::climb(const SectionMaximum& from, double far) const {
  if (far == from.z) return from;  // held by the pinion's face end
  // Past the end of a flank counts as downhill.
  const double direction = from.slope > 0.0 ? 1.0 : -1.0;
  const auto uphill = [&](double z) {
    const SectionMaximum s = section(z);
    return s.exists ? s.slope : -direction * std::abs(from.slope);
  };
  const double slope_far = uphill(far);
  if ((slope_far > 0.0) == (from.slope > 0.0) && slope_far != 0.0) {
    const SectionMaximum end = section(far);
    return end.phi2 > from.phi2 ? end : from;
  }
  const Root root = bracketed_root(uphill, from.z, from.slope, far, slope_far, 1e-13 * std::max(1.0, scene_.pinion.half_face));
  // Of the two ends of the last bracket the one on the flank; where both are, the higher.
  const SectionMaximum lower = section(root.lower), upper = section(root.upper);
  if (!upper.exists) return lower;
  if (!lower.exists) return upper;
  return upper.phi2 > lower.phi2 ? upper : lower;
}

bool FirstContact::is_flat_around(const SectionMaximum& best) const {
  const double step = 2.0 * flat_fraction * scene_.pinion.half_face;
  for (const double side : {-1.0, 1.0}) {
    const double z = best.z + side * step;
    if (std::abs(z) > scene_.pinion.half_face) continue;
    const SectionMaximum neighbour = section(z);
    if (neighbour.exists && neighbour.bound == best.bound &&
        (best.phi2 - neighbour.phi2) * scene_.wheel.base_radius <= flat_tolerance) {
      return true;
    }
  }
  return false;
}

ContactKind kind_of(const FirstContact& problem, const SectionMaximum& best, const MeshScene& scene) {
  const bool flat = problem.is_flat_around(best);
  // At a face end the angle still rises outwards; a flat valley that merely reaches the end is no edge contact.
  const double end_gap = 1e-9 * scene.pinion.half_face;
  const bool on_pinion_end = scene.pinion.half_face - std::abs(best.z) <= end_gap;
  const bool on_wheel_end = scene.wheel.half_face - std::abs(best.at.wheel_z.value) <= end_gap;
  const bool on_face_end = !flat && (on_pinion_end || on_wheel_end) && best.slope * best.z > 0.0;
  const bool on_profile_end = best.bound != Bound::None && best.bound != Bound::WheelFace;
  if (on_profile_end && (on_face_end || best.bound == Bound::WheelFace)) return ContactKind::Corner;
  switch (best.bound) {
    case Bound::PinionRoot: return ContactKind::PinionRoot;
    case Bound::PinionTip: return ContactKind::PinionTip;
    case Bound::WheelRoot: return ContactKind::WheelRoot;
    case Bound::WheelTip: return ContactKind::WheelTip;
    case Bound::WheelFace: return ContactKind::FaceEnd;
    case Bound::None: break;
  }
  if (flat) return ContactKind::Line;
  return on_face_end ? ContactKind::FaceEnd : ContactKind::Surface;
}

}  // namespace

ToothContact find_tooth_contact(const MeshScene& scene, int tooth, double phi1) {
  ToothContact contact;
  contact.tooth = tooth;
  contact.phi1 = phi1;
  const FirstContact problem(scene, tooth, phi1);
  const SectionMaximum best = problem.solve();
  if (!best.exists) return contact;
  contact.kind = kind_of(problem, best, scene);
  contact.phi2 = best.phi2;
  contact.transmission_error = best.phi2 - scene.speed_ratio() * phi1;
  contact.pinion_radius = std::hypot(scene.pinion.base_radius, best.rho);
  contact.pinion_z = best.z;
  contact.wheel_radius = best.at.wheel_radius.value;
  contact.wheel_z = best.at.wheel_z.value;
  return contact;
}

const char* to_string(ContactKind kind) {
  switch (kind) {
    case ContactKind::None: return "none";
    case ContactKind::Line: return "line";
    case ContactKind::Surface: return "surface";
    case ContactKind::PinionTip: return "pinion_tip";
    case ContactKind::WheelTip: return "wheel_tip";
    case ContactKind::PinionRoot: return "pinion_root";
    case ContactKind::WheelRoot: return "wheel_root";
    case ContactKind::FaceEnd: return "face_end";
    case ContactKind::Corner: return "corner";
  }
  __builtin_unreachable();
}

}  // namespace flankwright
