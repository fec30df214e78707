#include "core/compliance/local/contact_law.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/local/hertz_line.hpp"
#include "core/compliance/local/load_end.hpp"

namespace flankwright {
namespace {

// Haddad 1991, eq. 1.54.
constexpr double kTipFactor0 = 1.627, kTipFactor1 = -0.282, kTipFactor2 = 0.03338;
// The parabola holds for y <= kBlendStart, where it still falls; M = 1 for y >= kBlendEnd.
constexpr double kBlendStart = 3.6, kBlendEnd = 5.0;

/// The bracket of eq. 1.30, g(h') = asinh(h') - k h' (S - h'), S = sqrt(1 + h'^2), and its derivative (1 - k (S -
/// h')^2) / S.
struct DepthFunction {
  double value, slope;
};

DepthFunction depth_function(double depth, double k) {
  // Beyond this depth S = h' to the last bit, and h'^2 may overflow.
  constexpr double kDeep = 1e9;
  if (depth > kDeep) return {std::log(2 * depth) - k / 2, 1 / depth};
  const double s = std::sqrt(1 + depth * depth);
  const double gap = 1 / (s + depth);  // S - h' without cancellation
  // asinh from the root at hand, where that costs no digits.
  const double inverse_sine = depth > 0.5 ? std::log(s + depth) : std::asinh(depth);
  return {inverse_sine - k * depth * gap, (1 - k * gap * gap) / s};
}

/// What both ends of one side add, of which those that its mate does not reach are held up by the flank beyond, see load_end_support().
FreeEnd::Softening at_ends(const FreeEnd& free_end, const ContactSide& side, const ContactSide& mate, double half_width) {
  std::array<double, 2> distances = side.end_distances, overhangs{};
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double own = side.end_distances[i], mates = mate.end_distances[i];
    if (std::isinf(own) || !(own > mates)) continue;
    overhangs[i] = own - mates;
    distances[i] += overhangs[i];
  }
  FreeEnd::Softening sum = free_end.at(distances, side.depth, half_width);
  if (overhangs == std::array<double, 2>{}) return sum;
  const double nu = side.lateral_ratio / (1 + side.lateral_ratio);
  const FreeEnd::Softening held = load_end_support(nu, mate.end_distances, overhangs, side.depth, half_width);
  sum.value += held.value;
  sum.widening += held.widening;
  return sum;
}

}  // namespace

TipFactor tip_factor(double tip_distance) {
  const double y = tip_distance;
  if (y >= kBlendEnd) return {1, 0};
  if (y <= kBlendStart) {
    return {kTipFactor0 + y * (kTipFactor1 + y * kTipFactor2), kTipFactor1 + 2 * y * kTipFactor2};
  }
  // Quintic in t = (y - start) / width with value, slope and curvature of the parabola at t = 0 and (1, 0, 0) at t = 1,
  // written as 1 + (1 - t)^3 (c0 + c1 t + c2 t^2).
  constexpr double width = kBlendEnd - kBlendStart;
  constexpr double value = kTipFactor0 + kBlendStart * (kTipFactor1 + kBlendStart * kTipFactor2) - 1;
  constexpr double slope = (kTipFactor1 + 2 * kBlendStart * kTipFactor2) * width;
  constexpr double curvature = 2 * kTipFactor2 * width * width;
  constexpr double c0 = value;
  constexpr double c1 = slope + 3 * c0;
  constexpr double c2 = curvature / 2 + 3 * c1 - 3 * c0;
  const double t = (y - kBlendStart) / width;
  const double u = 1 - t;
  const double polynomial = c0 + t * (c1 + t * c2);
  return {1 + u * u * u * polynomial, u * u * (u * (c1 + 2 * c2 * t) - 3 * polynomial) / width};
}

ContactSide ContactSide::of(const Material& material, double depth, double tip_distance, const std::array<double, 2>& end_distances,
                            double end_lean) {
  validate(material);
  if (!(depth > 0 && std::isfinite(depth))) throw InvalidInput("depth", std::to_string(depth), "more than 0 mm");
  const double nu = material.poissons_ratio;
  return {2 * (1 - nu * nu) / (units::pi * material.youngs_modulus), nu / (1 - nu), depth, tip_distance, end_distances, end_lean};
}

ContactLaw::ContactLaw(const ContactSide& pinion, const ContactSide& wheel, double relative_radius, double contact_modulus,
                       const std::optional<RoundedEdge>& edge)
    : half_width_at_unit_load_(hertz_line(1.0, relative_radius, contact_modulus).half_width),
      relative_radius_(relative_radius),
      contact_modulus_(contact_modulus),
      edge_(edge) {
  if (edge && !(edge->radius >= 0.0)) throw InvalidInput("edge.radius", std::to_string(edge->radius), "0 mm or more");
  if (edge && !std::isfinite(edge->distance)) throw InvalidInput("edge.distance", std::to_string(edge->distance), "a distance in mm");
  const auto distance = [](const char* field, double given) {
    if (std::isnan(given)) throw InvalidInput(field, "nan", "a distance in mm or infinity");
    return std::max(0.0, given);
  };
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    ContactSide side = i == 0 ? pinion : wheel;
    assert(side.coefficient > 0 && side.depth > 0 && side.lateral_ratio >= 0 && side.lateral_ratio < 1);
    side.tip_distance = distance("tip_distance", side.tip_distance);
    for (double& end : side.end_distances) end = distance("end_distances", end);
    const double nu = side.lateral_ratio / (1 + side.lateral_ratio);
    const bool endless = side.end_distances == ContactSide::no_ends;
    correction_ += side.correction;
    sides_[i] = {side, FreeEnd(nu, side.end_lean), endless ? 0 : side.coefficient / (1 - nu * nu)};
  }
}

ContactLaw ContactLaw::with_edge_moved(double further) const {
  ContactLaw moved = *this;
  if (moved.edge_) moved.edge_->distance += further;
  return moved;
}

double ContactLaw::half_width(double line_load) const { return half_width_at_unit_load_ * std::sqrt(line_load); }

/// The strip, where it reaches the edge.
std::optional<StripContact> ContactLaw::strip(double line_load) const {
  if (!reaches_edge(line_load)) return std::nullopt;
  return StripContact(*edge_, relative_radius_, contact_modulus_, line_load);
}

ContactLaw::Response ContactLaw::evaluate(double line_load) const {
  assert(line_load >= 0);
  if (line_load == 0) return {0, std::numeric_limits<double>::infinity()};
  const double flank_width = half_width(line_load);
  const std::optional<StripContact> on_edge = strip(line_load);
  const double l = on_edge ? on_edge->half_width() : flank_width, growth = on_edge ? on_edge->growth() : 0.5;
  Response response{correction_ * line_load, correction_};
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const auto& [side, free_end, end_coefficient] = sides_[i];
    // L grows as sqrt(w), so w d/dw of h' and of y are -h'/2 and -y/2; on an edge that of h' is -growth h'.
    const double h = side.depth / l;
    const DepthFunction g = depth_function(h, side.lateral_ratio);
    const double y = side.tip_distance / flank_width;
    const TipFactor m = tip_factor(y);
    const double lengthening = m.slope == 0 ? 0 : m.slope * y * g.value;  // y may be infinite where the slope is zero
    response.deflection += side.coefficient * line_load * m.value * g.value;
    response.slope += side.coefficient * (m.value * (g.value - growth * h * g.slope) - 0.5 * lengthening);
    if (end_coefficient == 0) continue;
    const FreeEnd::Softening f = at_ends(free_end, side, sides_[1 - i].data, l);
    response.deflection += end_coefficient * line_load * f.value;
    response.slope += end_coefficient * (f.value + growth * f.widening);
  }
  if (on_edge) {  // d(rise)/dw = (2/(pi E')) growth, by Betti's theorem
    const double hertz = 1.0 / (units::pi * contact_modulus_);
    response.deflection += on_edge->rise() - hertz * line_load;
    response.slope += hertz * (2.0 * growth - 1.0);
  }
  return response;
}

double ContactLaw::line_load(double deflection) const {
  if (!(deflection > 0)) return 0;
  // Newton's steps on log c by log w, a curve that rises by 1/2 to 1 all the way.
  constexpr double round_off = 1e-13;
  constexpr int most_steps = 50;
  double load = 1;
  for (int step = 0; step < most_steps; ++step) {
    const Response here = evaluate(load);
    const double change = std::log(deflection / here.deflection) * here.deflection / (load * here.slope);
    load *= std::exp(change);
    if (std::abs(change) < round_off) break;
  }
  return load;
}

double ContactLaw::edge_slope(double line_load) const {
  const std::optional<StripContact> on_edge = strip(line_load);
  if (!on_edge) return 0.0;
  const double l = on_edge->half_width(), widening = on_edge->half_width_by_edge() / l, flank_width = half_width(line_load);
  double slope = on_edge->rise_by_edge();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const auto& [side, free_end, end_coefficient] = sides_[i];
    const double h = side.depth / l;
    const double m = tip_factor(side.tip_distance / flank_width).value;
    slope -= side.coefficient * line_load * m * depth_function(h, side.lateral_ratio).slope * h * widening;
    if (end_coefficient == 0) continue;
    slope += end_coefficient * line_load * at_ends(free_end, side, sides_[1 - i].data, l).widening * widening;
  }
  return slope;
}

StripContact::Peaks ContactLaw::peak_pressure(double line_load) const {
  assert(line_load >= 0);
  if (line_load == 0) return {};
  if (const std::optional<StripContact> on_edge = strip(line_load)) return on_edge->peaks();
  const double pressure = std::sqrt(line_load * contact_modulus_ / (units::pi * relative_radius_));
  return {{pressure, 0.5 * pressure / line_load, 0.0}, {}, {}};
}

}  // namespace flankwright
