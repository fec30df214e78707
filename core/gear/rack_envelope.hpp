#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/dual.hpp"
#include "core/base/jet.hpp"
#include "core/gear/tool_section.hpp"

namespace flankwright {

/// The circle that rolls with the tool: the gear's reference circle.
struct RollingCircle {
  double sin_alpha, cos_alpha;  ///< of the transverse pressure angle
  double base_radius;           ///< r_b [mm]
  double tangent_length;        ///< r sin(alpha_t): roll length on the reference circle [mm]

  explicit RollingCircle(const Gear& gear)
      : sin_alpha(gear.roll_length_at(gear.reference_radius) / gear.reference_radius),
        cos_alpha(gear.base_radius / gear.reference_radius),
        base_radius(gear.base_radius),
        tangent_length(gear.roll_length_at(gear.reference_radius)) {}
};

/// Where a point of the tool leaves its mark on the flank, in the coordinates of DeviationField.
template <class Scalar>
struct GeneratedPoint {
  Scalar roll;           ///< rho [mm]
  Scalar deviation;      ///< D [mm]
  Scalar d_roll;         ///< dD/drho
  Scalar d_z;            ///< dD/dz
  Scalar pressure_sine;  ///< sin(alpha_t) + slope cos(alpha_t): > 0 where the tool's normal points to the gear's tip
};

/// The flank enveloped by a tool that rolls like a rack. The velocity of that motion lies in the transverse plane, so that every
/// transverse section of the tool envelops the same section of the flank: the tool's normal n + d' b passes through the pitch
/// point (TM-107451, A.5.13 and A.5.14; TM-100260, eq. 19) where the contact point is lambda (n + d' b) away from it,
///
///     lambda = (xi cos(alpha) - d sin(alpha)) / (sin(alpha) + d' cos(alpha)),     eta = lambda d',   A = r sin(alpha) + lambda.
///
/// From the gear's centre it is (r_b + eta) b + A n, and its base tangent of length L = sqrt(A^2 + eta (2 r_b + eta)) is turned
/// by delta against n, tan(delta) = -eta (r_b (2 r_b + eta)/(A + L) + L) / (r_b (r_b + eta) + A L). The tool has moved by
/// d + lambda along n when it gets there, hence
///
///     rho = A + d - r_b delta,                     D = rho - L,
///     dD/drho = L/r_b tan(delta + atan d'),        dD/dz = d_z / (cos(delta) - d' sin(delta)),
///
/// the derivatives from the normal that tool and flank share. Exact, and D = 0 to the last bit for d = 0.
template <class Scalar>
GeneratedPoint<Scalar> envelope(const RollingCircle& circle, const ToolPoint<Scalar>& tool) {
  using std::atan2;
  using std::sqrt;
  const double rb = circle.base_radius;
  const Scalar pressure_sine = circle.sin_alpha + tool.slope * circle.cos_alpha;
  const Scalar lambda = (tool.along * circle.cos_alpha - tool.depth * circle.sin_alpha) / pressure_sine;
  const Scalar eta = lambda * tool.slope, a = circle.tangent_length + lambda;
  const Scalar excess = eta * (2.0 * rb + eta);
  const Scalar length = sqrt(a * a + excess);
  const Scalar shortfall = excess / (a + length);  // L - A
  const Scalar rise = -(rb * shortfall + length * eta), run = rb * (rb + eta) + a * length;
  const Scalar delta = atan2(rise, run), tan_delta = rise / run;
  const Scalar turn = 1.0 - tool.slope * tan_delta;
  const Scalar advance = tool.depth - rb * delta;
  return {a + advance, advance - shortfall, length / rb * (tool.slope + tan_delta) / turn,
          tool.lead_slope * sqrt(1.0 + tan_delta * tan_delta) / turn, pressure_sine};
}

template <class Section, class Scalar>
GeneratedPoint<Scalar> generated_point(const Section& section, const RollingCircle& circle, const Scalar& parameter,
                                       const Scalar& z) {
  return envelope(circle, section.at(parameter, z));
}

/// The tool's parameter whose mark lies at roll length rho in the section z, to |rho(parameter) - rho| <= 1e-13 (rho + r_b):
/// Newton with steps halved until they stay on the flank and come closer. Nothing where no regular flank leads there from the pitch
/// point: the envelope has a cusp before (undercut), the radius does not grow with rho, or the tool does not reach.
template <class Section>
std::optional<double> tool_parameter(const Section& section, const RollingCircle& circle, double rho, double z) {
  using Number = Dual<1>;
  struct Trial {
    double parameter, missing, rate;
    bool regular;
  };
  const auto attempt = [&](double parameter) -> Trial {
    const auto point = generated_point(section, circle, Number::variable(parameter, 0), Number(z));
    const double rate = point.roll.gradient[0];
    return {parameter, rho - point.roll.value, rate,
            rate > 0.0 && point.pressure_sine.value > 0.0 && point.d_roll.value < 1.0};
  };
  const double tolerance = 1e-13 * (std::abs(rho) + circle.base_radius);
  Trial trial = attempt(section.guess((rho - circle.tangent_length) * circle.sin_alpha / circle.cos_alpha, z));
  if (!trial.regular) trial = attempt(section.guess(0.0, z));
  if (!trial.regular) return std::nullopt;
  while (std::abs(trial.missing) > tolerance) {
    double step = trial.missing / trial.rate;
    Trial next = attempt(trial.parameter + step);
    while (!(next.regular && std::abs(next.missing) < std::abs(trial.missing))) {
      step *= 0.5;
      if (trial.parameter + step == trial.parameter) return std::nullopt;
      next = attempt(trial.parameter + step);
    }
    trial = next;
  }
  return trial.parameter;
}

/// Ends of a gear's generated flank, moved out by a share of the roll length there. A form circle on the base circle counts as a
/// roll length of r_b/100, where contact takes the flank to start.
struct GeneratedRange {
  /// The flank must be regular for (1 - regular_margin) rho_start <= rho <= (1 + regular_margin) rho_tip.
  static constexpr double regular_margin = 0.05;
  /// It is used as it is to here, and continued by its tangent beyond: derivatives and searches at the ends see the flank
  /// itself, and a cusp at the limit of the regular range stays away from it.
  static constexpr double exact_margin = 0.5 * regular_margin;

  double lowest;      ///< roll length below the form circle [mm]
  double active;      ///< below the start of the active profile [mm], >= lowest
  double highest;     ///< above the tip circle [mm]
  double half_width;  ///< |z| [mm]: 1.2 times half the face width

  GeneratedRange(const Gear& gear, double margin)
      : lowest((1.0 - margin) * start(gear, gear.form_radius)),
        active((1.0 - margin) * start(gear, gear.active_root_radius)),
        highest((1.0 + margin) * gear.roll_length_at(gear.tip_radius)),
        half_width(0.6 * gear.data.face_width) {}

 private:
  static double start(const Gear& gear, double radius) {
    return std::max(gear.roll_length_at(std::max(radius, gear.base_radius)), 0.01 * gear.base_radius);
  }
};

/// Where the flank that a tool is to generate starts.
enum class FlankStart { Form, Active };

/// Whether a tool generates the flank from its start to the tip circle over the whole width (regular_margin). The corners
/// decide: the distance to the cusp, r sin(alpha + atan d') + l - kappa l^2 with l the distance from the pitch point and kappa
/// the tool's curvature, is smallest at an end, and the depth of every tool here grows with |z|.
template <class Section>
bool generates(const Section& section, const Gear& gear, FlankStart start) {
  const RollingCircle circle(gear);
  const GeneratedRange range(gear, GeneratedRange::regular_margin);
  const double lowest = start == FlankStart::Form ? range.lowest : range.active;
  for (const double z : {0.0, range.half_width}) {
    for (const double rho : {lowest, range.highest}) {
      if (!tool_parameter(section, circle, rho, z)) return false;
    }
  }
  return true;
}

}  // namespace flankwright
