#include "core/flank/conjugate_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/gear/involute.hpp"
#include "core/gear/rack_envelope.hpp"

namespace flankwright {

namespace {

constexpr double least_pace = 0.5;  // see make_conjugate_field()

/// The point where the flank touches its mate, in the coordinates of DeviationField.
template <class Scalar>
struct Touch {
  Scalar roll;    ///< rho [mm]
  Scalar along;   ///< rho - D [mm]
  Scalar d_roll;  ///< dD/drho
};

class ConjugateField final : public PredesignedField {
 public:
  ConjugateField(const GearPair& pair, Member member, double coefficient)
      : frame_(pair.flank_frame(member)),
        on_pinion_(member == Member::Pinion),
        mate_base_radius_(pair[on_pinion_ ? Member::Wheel : Member::Pinion].base_radius),
        centre_distance_(pair.centre_distance),
        speed_ratio_(1.0 / pair.gear_ratio()),
        start_(involute(pair.working_transverse_pressure_angle)),
        a_(coefficient) {
    const GeneratedRange range(pair[member], GeneratedRange::exact_margin);
    for (const double z : {-range.half_width, range.half_width}) {
      lowest_ = std::max(lowest_, exact_to(range.active, z));
      highest_ = std::min(highest_, exact_to(range.highest, z));
    }
  }

  Jet at(double rho, double z) const override {
    const double end = std::clamp(rho, lowest_, highest_);
    const std::optional<Root> root = touching_angle(end, z);
    if (!root) return {not_given, not_given, not_given, not_given, not_given, not_given};
    // The touch as a function of (phi1, z), and phi1 as a function of (rho, z), past the end of z alone.
    const Jet profile = Jet::variable_u(rho), face = Jet::variable_v(z);
    const Touch<Jet> mark = *touch(Jet::variable_u(root->angle), face);
    const Jet angle = implicit_angle(mark.roll, root->angle, rho == end ? 1.0 : 0.0);
    if (rho == end) return profile - chain(mark.along, angle, face);
    return end - chain(mark.along, angle, face) + (profile - end) * chain(mark.d_roll, angle, face);
  }

  double coefficient_slope(double rho, double z) const override {
    using Number = Dual<2>;  // by phi1 and the coefficient
    const double end = std::clamp(rho, lowest_, highest_);
    const std::optional<Root> root = touching_angle(end, z);
    if (!root) return not_given;
    const Touch<Number> mark = *touch(Number::variable(root->angle, 0), Number(z), Number::variable(a_, 1));
    const auto at_fixed_roll = [&](const Number& f) { return f.gradient[1] - f.gradient[0] * mark.roll.gradient[1] / mark.roll.gradient[0]; };
    return -at_fixed_roll(mark.along) + (rho - end) * at_fixed_roll(mark.d_roll);
  }

  /// Whether the flank gives the parabola at mid face, over the pitch in which its pair is the leading one.
  bool carries_a_pitch(int pinion_teeth) const {
    const double half = units::pi / pinion_teeth * std::abs(frame_.base_radius / frame_.pinion_turn);
    return lowest_ <= frame_.pitch_roll - half && frame_.pitch_roll + half <= highest_;
  }

 private:
  struct Root {
    double angle, rate;  ///< phi1 [rad] and d(roll)/d(phi1) [mm/rad]
  };

  /// t(u, v) where f(t, v) = rate u + constant, from the derivatives of f: those of an implicit function.
  static Jet implicit_angle(const Jet& f, double t, double rate) {
    const double t_u = rate / f.u, t_v = -f.v / f.u;
    const double t_uu = -f.uu * t_u * t_u / f.u;
    const double t_uv = -(f.uu * t_v + f.uv) * t_u / f.u;
    const double t_vv = -(f.uu * t_v * t_v + 2.0 * f.uv * t_v + f.vv) / f.u;
    return {t, t_u, t_v, t_uu, t_uv, t_vv};
  }

  template <class Scalar>
  std::optional<Touch<Scalar>> touch(const Scalar& phi1, const Scalar& z) const {
    return touch(phi1, z, a_);
  }

  /// Nothing where no normal through the momentary pitch point touches the mate's base circle, or the flank's own.
  /// @param a  the coefficient, a number or Scalar
  template <class Scalar, class Coefficient>
  std::optional<Touch<Scalar>> touch(const Scalar& phi1, const Scalar& z, const Coefficient& a) const {
    using std::atan2;
    using std::cos;
    using std::sin;
    using std::sqrt;
    const double rb = frame_.base_radius;
    const Scalar phi2 = phi1 * (speed_ratio_ - a * phi1);
    const Scalar to_wheel = centre_distance_ / (1.0 + speed_ratio_ - 2.0 * a * phi1);  // from the pitch point to the wheel's axis
    const Scalar to_mate = on_pinion_ ? to_wheel : centre_distance_ - to_wheel;
    const Scalar own = on_pinion_ ? phi1 : -phi2, mate = on_pinion_ ? -phi2 : phi1;  // rotations, each in its own frame
    const Scalar tangent_square = to_mate * to_mate - mate_base_radius_ * mate_base_radius_;
    if (value_of(tangent_square) <= 0.0) return std::nullopt;
    const Scalar tangent = sqrt(tangent_square);
    const Scalar cosine = mate_base_radius_ / to_mate, sine = tangent / to_mate;  // of the momentary pressure angle
    const Scalar mate_roll = mate_base_radius_ * (start_ + mate + atan2(sine, cosine)) - frame_.helix_rate * rb * z;
    const Scalar beyond = tangent - mate_roll;  // from the pitch point to the contact, along the own outward normal
    const Scalar x = centre_distance_ - to_mate + beyond * sine, y = beyond * cosine;
    const Scalar along_square = x * x + y * y - rb * rb;
    if (value_of(along_square) <= 0.0) return std::nullopt;
    const Scalar along = sqrt(along_square);
    const Scalar base = atan2(y, x) - atan2(along, Scalar(rb));  // polar angle where the base tangent starts
    // The tangent along/r_b e - D' t is square to the normal (sine, cosine).
    const Scalar c = cos(base), s = sin(base);
    return Touch<Scalar>{rb * (start_ + own + frame_.helix_rate * z - base), along, along / rb * (sine * c + cosine * s) / (cosine * c - sine * s)};
  }

  /// phi1 at which the flank touches at roll length rho in the section z, to |rho(phi1) - rho| <= 1e-13 (rho + r_b), by Newton from
  /// where the involute would; nothing where the flank folds or ends on the way.
  std::optional<Root> touching_angle(double rho, double z) const {
    using Number = Dual<1>;
    double phi1 = frame_.pinion_turn * ((rho - frame_.pitch_roll) / frame_.base_radius - frame_.helix_rate * z);
    const double forward = frame_.pinion_turn;  // sense of d(roll)/d(phi1) of the involute
    for (int i = 0; i < 50; ++i) {
      const std::optional<Touch<Number>> mark = touch(Number::variable(phi1, 0), Number(z));
      if (!mark) return std::nullopt;
      const double rate = mark->roll.gradient[0];
      if (rate * forward <= 0.0 || mark->d_roll.value >= 1.0) return std::nullopt;
      const double missing = rho - mark->roll.value;
      if (std::abs(missing) <= 1e-13 * (rho + frame_.base_radius)) return Root{phi1 + missing / rate, rate};
      phi1 += missing / rate;
    }
    return std::nullopt;
  }

  /// Roll length nearest to `end` that can be reached from the pitch circle in the section z while contact moves along the flank at
  /// least least_pace times as fast as along the involute.
  double exact_to(double end, double z) const {
    const double nominal = frame_.base_radius / frame_.pinion_turn;
    const auto is_exact = [&](double rho) {
      const std::optional<Root> root = touching_angle(rho, z);
      return root && root->rate / nominal >= least_pace;
    };
    if (is_exact(end)) return end;
    double exact = frame_.pitch_roll, beyond = end;
    while (std::abs(beyond - exact) > 1e-6 * frame_.pitch_roll) {
      const double middle = 0.5 * (exact + beyond);
      (is_exact(middle) ? exact : beyond) = middle;
    }
    return exact;
  }

  FlankFrame frame_;
  bool on_pinion_;
  double mate_base_radius_, centre_distance_;
  double speed_ratio_;                                                     ///< N1/N2
  double start_;                                                           ///< inv(alpha_wt) [rad]
  double a_;                                                               ///< [1/rad]
  double lowest_{0.0}, highest_{std::numeric_limits<double>::infinity()};  ///< roll lengths between which the field is exact [mm]
};

}  // namespace

std::shared_ptr<const PredesignedField> make_conjugate_field(const GearPair& pair, Member member, double coefficient) {
  auto field = std::make_shared<ConjugateField>(pair, member, coefficient);
  const int teeth = pair.data.pinion.teeth;
  if (field->carries_a_pitch(teeth)) return field;
  double possible = 0.0, folded = coefficient;
  for (int halving = 0; halving < 30; ++halving) {
    const double middle = 0.5 * (possible + folded);
    (ConjugateField(pair, member, middle).carries_a_pitch(teeth) ? possible : folded) = middle;
  }
  throw InvalidInput("parabolic_te", std::to_string(coefficient / units::arcsec_per_square_deg),
                     std::string("up to ")
                         .append(std::to_string(possible / units::arcsec_per_square_deg))
                         .append(" arcsec/deg^2, beyond which no flank has this parabola over a whole pitch"));
}

}  // namespace flankwright
