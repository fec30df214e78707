#include "tests/benchmarks/contact_truth/tooth_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/compliance/thin_slice/thin_slice.hpp"
#include "core/contact/path/contact_points.hpp"

namespace flankwright::contact_truth {
namespace {

constexpr double cap_height = 0.6;  // of half the tip's thickness
constexpr double land_share = 0.2;  // part of half the tip land that belongs to the loaded side's grid

}  // namespace

ToothSurface::ToothSurface(const ContactGear& gear, const ContactMeshOptions& options)
    : gear_(gear),
      options_(options),
      form_(tooth_form(*gear.pair, gear.member)),
      path_(*gear.pair),
      root_(form_, units::pi / (*gear.pair)[gear.member].data.teeth),
      rounding_((*gear.pair)[gear.member].data.tip_rounding) {
  if (rounding_ > 0) tip_.emplace((*gear.pair)[gear.member], gear.flank->helix_rate);
}

double ToothSurface::turn() const {
  const double phi1 = path_.pinion_angle_at(gear_.line_phase, *gear_.pair);
  const double rotation = pinion() ? phi1 : -phi1 / gear_.pair->gear_ratio();
  return rotation - form_.half_angle((*gear_.pair)[gear_.member].working_pitch_radius);
}

double ToothSurface::top(int tooth) const {
  return capped(tooth) ? form_.tip_radius() - cap_height * form_.tip_radius() * form_.tip_half_angle() : form_.tip_radius();
}

ToothSurface::Finest ToothSurface::finest(int tooth, double z) const {
  const Gear& g = (*gear_.pair)[gear_.member];
  const double pinion_roll = path_.roll_at(path_.phase_at(gear_.line_phase + pair_of(tooth), z));
  const double roll = std::max(0.0, pinion() ? pinion_roll : gear_.pair->path_length - pinion_roll);
  const auto contact = contact_point(*gear_.pair, path_, gear_.line_phase, pair_of(tooth), z, true);
  if (options_.edge_finest == 0 || !contact || !(contact->tip_edge.radius > 0)) return {involute_arc(roll), options_.finest};
  const double distance = contact->tip_edge.distance;
  if (distance > options_.edge_reach) {
    const double share = std::min(1.0, options_.edge_blend > 0 ? distance / options_.edge_blend : 1.0);
    return {involute_arc(roll), options_.edge_finest + share * (options_.finest - options_.edge_finest)};
  }
  if (contact->tip_edge.gear == gear_.member) return {involute_arc(tip_->flank_end()), options_.edge_finest};
  return {involute_arc(g.roll_length_at(pinion() ? contact->pinion_radius : contact->wheel_radius)), options_.edge_finest};
}

/// The surface's length from the involute's start on the base circle to half step i of the flank, rho^2 / (2 r_b) on the involute; a rounding counts
/// its radius times the angle of its normal [mm].
double ToothSurface::arc(int tooth, int side, int i, double z) const {
  if (i % 2 != 0) return (arc(tooth, side, i - 1, z) + arc(tooth, side, i + 1, z)) / 2;
  const Gear& g = (*gear_.pair)[gear_.member];
  double tip = involute_arc(g.roll_length_at(side < 0 ? top(tooth) : form_.tip_radius()));
  const double start = involute_arc(g.roll_length_at(form_.form_radius()));
  const double t = i / (2.0 * flank_elements(tooth));
  if (side < 0 || !loaded(tooth)) return tip + t * (start - tip);
  if (tip_) {
    tip = involute_arc(tip_->flank_end()) + rounding_ * tip_->angle() + land_share * form_.tip_radius() * form_.tip_half_angle();
    const auto steps_above = [&](double at_z) {
      const auto [at, size] = finest(tooth, at_z);
      const double a = std::asinh((tip - at) / size), b = std::asinh((at - start) / size);
      return std::clamp(static_cast<int>(std::lround(a / (a + b) * options_.flank)), 2, options_.flank - 2);
    };
    const auto [at, size] = finest(tooth, z);
    const int above = steps_above(0), below = options_.flank - above, step = i / 2 - above;
    const double end = step < 0 ? tip - at : at - start;
    return at - size * std::sinh(std::asinh(end / size) * step / (step < 0 ? above : below));
  }
  const double contact = std::clamp(finest(tooth, z).at, start, tip), delta = options_.finest;
  const double above = std::asinh((tip - contact) / delta), below = std::asinh((contact - start) / delta);
  return contact + delta * std::sinh(above - t * (above + below));
}

Polar ToothSurface::profile(int tooth, int side, int i, double z) const {
  const int end = 2 * flank_elements(tooth);
  if (i > end) return root_.at((i - end) / (2.0 * fillet_elements(tooth)));
  const double s = arc(tooth, side, i, z);
  if (side > 0 && capped(tooth) && s > involute_arc(tip_->flank_end())) return beyond_flank(s - involute_arc(tip_->flank_end()));
  const double rho = std::sqrt(2 * form_.base_radius() * s), radius = std::hypot(rho, form_.base_radius());
  if (side < 0 || !loaded(tooth)) return {radius, form_.half_angle(std::clamp(radius, form_.form_radius(), form_.tip_radius()))};
  const auto p = flank_point(*gear_.flank, rho, z, pair_of(tooth), 0.0);
  const double centre = gear_.flank->helix_rate * z - form_.half_angle((*gear_.pair)[gear_.member].working_pitch_radius);
  return {std::hypot(p.x, p.y), std::remainder(std::atan2(p.y, p.x) - centre, 2 * units::pi)};
}

/// On the rounding or the tip land, at a length from the end of the flank.
Polar ToothSurface::beyond_flank(double length) const {
  const double end = form_.half_angle(std::hypot(form_.base_radius(), tip_->flank_end()));
  const double on_land = length - rounding_ * tip_->angle();
  const auto [radius, angle] = tip_->at(std::max(0.0, tip_->angle() - length / rounding_));
  return {radius, end + angle - std::max(0.0, on_land) / form_.tip_radius()};
}

}  // namespace flankwright::contact_truth
