#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/flank/modifications/descriptor.hpp"
#include "core/flank/modifications/relief.hpp"

namespace flankwright {

/// The corner of a helical flank where lines of contact are shortest, at the tip or at the start of active profile, and the strip along it that a
/// triangular relief takes off. Lines of contact have
///
///     s = rho - k z = const,     k = r_b helix_rate = tan(beta_b), signed as Flank::helix_rate,
///
/// with rho the roll length. Over the flank s is largest at the tip corner z = -sign(k) b/2 and smallest at the root corner z = +sign(k) b/2.
class ContactLineCorner {
 public:
  enum class At { Tip, Root };

  /// @param height  radial, along the face end at the corner [mm]; what would begin below the base circle begins there
  ContactLineCorner(const FlankFrame& frame, At at, double height)
      : base_radius_(frame.base_radius), rise_(frame.base_radius * frame.helix_rate), sense_(at == At::Tip ? 1.0 : -1.0) {
    const double end = at == At::Tip ? frame.tip_radius : frame.active_root_radius;
    start_radius_ = end - sense_ * height;
    extent_ = sense_ * (roll(end) - roll(start_radius_));
    corner_z_ = -sense_ * std::copysign(0.5 * frame.face_width, rise_);
    start_ = roll(start_radius_) - rise_ * corner_z_;
  }

  /// Roll length at the corner's face end from the start of the relief to the corner: L_Ea, L_Ef [mm].
  double extent() const { return extent_; }
  /// Where the corner lies along the face [mm].
  double face_end() const { return corner_z_; }
  /// How far the line where the relief starts reaches along the end of the profile, from that face end [mm].
  double reach_along_face() const { return extent_ / std::abs(rise_); }
  /// d extent/d height [-]; 0 where the relief begins below the base circle.
  double extent_slope() const { return roll(start_radius_) > 0.0 ? start_radius_ / roll(start_radius_) : 0.0; }
  /// How far s lies beyond the line where the relief starts, towards the corner [mm].
  double beyond(double r, double z) const { return sense_ * (roll(r) - rise_ * z - start_); }
  /// The same with its derivatives, u = r and v = z. Below the base circle nothing changes with r.
  Jet beyond_with_slopes(double r, double z) const {
    const double rho = roll(r), along = rho > 0.0 ? r / rho : 0.0, bend = rho > 0.0 ? -base_radius_ * base_radius_ / (rho * rho * rho) : 0.0;
    return {beyond(r, z), sense_ * along, -sense_ * rise_, sense_ * bend, 0.0, 0.0};
  }

 private:
  double roll(double r) const { return std::sqrt(std::max(0.0, (r - base_radius_) * (r + base_radius_))); }

  double base_radius_, rise_, sense_;                       ///< [mm], [-], [-]
  double start_radius_{0.0}, extent_{0.0}, corner_z_{0.0};  ///< [mm]
  double start_{0.0};                                       ///< s where the relief starts [mm]
};

namespace modifications {

/// C t or t^2, t = beyond/extent where that is positive: at the corner the whole amount, along each line of contact the same.
class TriangularTerm {
 public:
  TriangularTerm(const ProfileRelief& relief, const FlankFrame& frame, ContactLineCorner::At at)
      : corner_(frame, at, relief.height), ramp_(relief.amount, corner_.extent(), relief.shape), removes_(relief.amount != 0.0) {}

  void add(double r, double z, Jet& d) const {
    if (!removes_ || !(corner_.beyond(r, z) > 0.0)) return;
    const Jet way = corner_.beyond_with_slopes(r, z);
    double value = 0.0, first = 0.0, second = 0.0;
    ramp_.add(way.value, 1.0, value, first, second);
    d.value += value;
    d.u += first * way.u;
    d.v += first * way.v;
    d.uu += second * way.u * way.u + first * way.uu;
    d.uv += second * way.u * way.v;
    d.vv += second * way.v * way.v;
  }

 private:
  ContactLineCorner corner_;
  ReliefRamp ramp_;
  bool removes_;
};

/// Derivative of the removal by the height, one-sided at its start.
inline double triangular_slope(const ProfileRelief& relief, const FlankFrame& frame, ContactLineCorner::At at, double r, double z) {
  if (relief.amount == 0.0) return 0.0;
  const ContactLineCorner corner(frame, at, relief.height);
  return corner.extent_slope() * slope_by_extent(relief.amount, corner.extent(), relief.shape, corner.beyond(r, z));
}

inline std::array<double, 1> triangular_start(const ProfileRelief& relief, const FlankFrame& frame, ContactLineCorner::At at, double r, double z) {
  return {beyond_start(relief.amount, relief.shape, ContactLineCorner(frame, at, relief.height).beyond(r, z))};
}

/// Off the tip corner that lines of contact cut [ISO 21771, C_Ea]. It starts along a line of contact, so that a line has its removal all along and
/// none is cut in two.
struct TriangularTipRelief {
  ProfileRelief triangular_tip_relief;

  static constexpr auto corner = ContactLineCorner::At::Tip;
  static constexpr ModificationClass flank_class = ModificationClass::Topography;
  static constexpr auto parameters() {
    using M = TriangularTipRelief;
    return std::array{
        row<M, &M::triangular_tip_relief, &ProfileRelief::amount>(
            {.key = "triangular_tip_relief.amount",
             .name = "triangular tip relief",
             .symbol = "C_Ea",
             .meaning = "removed at the tip corner that the lines of contact cut off; helical gears",
             .extent = "triangular_tip_relief.height",
             .needs_helix = true}),
        row<M, &M::triangular_tip_relief, &ProfileRelief::height>(
            {.key = "triangular_tip_relief.height",
             .name = "triangular tip relief height",
             .meaning =
                 "radial, from the tip down at that face end, where a line of contact begins that bounds the relief; above 0 where there is an amount",
             .kind = ParameterKind::Extent},
            [](const M& m, const FlankFrame& frame, double r, double z) { return triangular_slope(m.triangular_tip_relief, frame, corner, r, z); })};
  }
  static constexpr auto choices() {
    return std::array{
        ChoiceRow<TriangularTipRelief>{"triangular_tip_relief.shape",
                                       "triangular tip relief shape",
                                       {"linear", "parabolic"},
                                       "between its start and the corner",
                                       [](auto& m, std::size_t word) { m.triangular_tip_relief.shape = static_cast<ReliefShape>(word); }}};
  }

  struct Term : TriangularTerm {
    Term(const TriangularTipRelief& m, const FlankFrame& frame) : TriangularTerm(m.triangular_tip_relief, frame, corner) {}
  };
  /// Where the slope of the removal jumps.
  std::array<double, 1> beyond_starts(const FlankFrame& frame, double r, double z) const {
    return triangular_start(triangular_tip_relief, frame, corner, r, z);
  }
  bool operator==(const TriangularTipRelief&) const = default;
};

/// Off the corner at the start of active profile, at the other face end [ISO 21771, C_Ef].
struct TriangularRootRelief {
  ProfileRelief triangular_root_relief;

  static constexpr auto corner = ContactLineCorner::At::Root;
  static constexpr ModificationClass flank_class = ModificationClass::Topography;
  static constexpr auto parameters() {
    using M = TriangularRootRelief;
    return std::array{
        row<M, &M::triangular_root_relief, &ProfileRelief::amount>(
            {.key = "triangular_root_relief.amount",
             .name = "triangular root relief",
             .symbol = "C_Ef",
             .meaning = "removed at the corner at the start of active profile that the lines of contact cut off; helical gears",
             .extent = "triangular_root_relief.height",
             .needs_helix = true}),
        row<M, &M::triangular_root_relief, &ProfileRelief::height>(
            {.key = "triangular_root_relief.height",
             .name = "triangular root relief height",
             .meaning =
                 "radial, from the start of active profile up at that face end, where a line of contact begins that bounds the relief; above 0 where there is an amount",
             .kind = ParameterKind::Extent},
            [](const M& m, const FlankFrame& frame, double r, double z) { return triangular_slope(m.triangular_root_relief, frame, corner, r, z); })};
  }
  static constexpr auto choices() {
    return std::array{
        ChoiceRow<TriangularRootRelief>{"triangular_root_relief.shape",
                                        "triangular root relief shape",
                                        {"linear", "parabolic"},
                                        "between its start and the corner",
                                        [](auto& m, std::size_t word) { m.triangular_root_relief.shape = static_cast<ReliefShape>(word); }}};
  }

  struct Term : TriangularTerm {
    Term(const TriangularRootRelief& m, const FlankFrame& frame) : TriangularTerm(m.triangular_root_relief, frame, corner) {}
  };
  /// Where the slope of the removal jumps.
  std::array<double, 1> beyond_starts(const FlankFrame& frame, double r, double z) const {
    return triangular_start(triangular_root_relief, frame, corner, r, z);
  }
  bool operator==(const TriangularRootRelief&) const = default;
};

}  // namespace modifications
}  // namespace flankwright
