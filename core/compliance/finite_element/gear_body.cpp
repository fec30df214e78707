#include "core/compliance/finite_element/gear_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace flankwright {
namespace {

std::string millimetres(double value) { return std::to_string(value) + " mm"; }

/// Refuses a length outside [low, high]. Bounds are sums of lengths: a body that just touches one is allowed.
void require_between(const char* field, double value, double low, double high, const std::string& why) {
  const double round_off = 1e-9 * (std::abs(low) + std::abs(high));
  if (value >= low - round_off && value <= high + round_off) return;
  throw InvalidInput(field, std::to_string(value), std::to_string(low) + " to " + millimetres(high) + why);
}

void check_holes(const WebHoles& holes, const BodyRadii& radii, double normal_module) {
  if (holes.count == 0) return;
  if (holes.count < 3) throw InvalidInput("body.hole_count", std::to_string(holes.count), "0, or at least 3");
  const double inner = 2 * radii.hub, outer = 2 * radii.underside;
  require_between("body.hole_circle_diameter", holes.circle_diameter, inner, outer, ", between hub and rim");
  const double of_web = std::min(outer - holes.circle_diameter, holes.circle_diameter - inner) - 0.2 * normal_module;
  const double of_neighbour = 0.95 * holes.circle_diameter * std::sin(units::pi / holes.count);
  const double most = std::min(of_web, of_neighbour);
  if (!(holes.diameter > 0 && holes.diameter <= most)) {
    throw InvalidInput("body.hole_diameter", std::to_string(holes.diameter),
                       "more than 0 and at most " + millimetres(most) + ": a tenth of the module from rim and hub, a twentieth of their pitch apart");
  }
}

void check_web(const WebbedBody& web, const BodyRadii& radii, double root, double normal_module, double face_width) {
  const double m = normal_module;
  // Half a module for the blocks of the teeth, another of web.
  require_between("body.rim_thickness", web.rim_thickness, 0.5 * m, root - radii.carrier - m,
                  ": half a module below the root circle to a module above the shaft or the bore");
  require_between("body.hub_diameter", web.hub_diameter, 2.1 * radii.carrier, 2 * radii.underside - m,
                  ": 1.05 of the shaft or of the held bore to a module below the rim's inner diameter");
  if (!(web.hub_width > 0) || !std::isfinite(web.hub_width)) throw InvalidInput("body.hub_width", std::to_string(web.hub_width), "more than 0 mm");
  require_between("body.web_thickness", web.web_thickness, 0.1 * m, std::min(face_width, web.hub_width),
                  ": a tenth of the module to the face width, or the hub's where that is less");
  const double most = std::max(0.0, 0.5 * (std::min(face_width, web.hub_width) - web.web_thickness));
  require_between("body.web_offset", web.web_offset, -most, most, ": the web may leave neither rim nor hub");
  check_holes(web.holes, radii, m);
}

std::array<double, 10> lengths(const GearBody& body) {
  const WebbedBody web = body.web.value_or(WebbedBody{});
  return {body.shaft_diameter, body.bore_diameter, body.shaft_overhang, web.rim_thickness,  web.web_thickness,
          web.web_offset,      web.hub_diameter,   web.hub_width,       web.holes.diameter, web.holes.circle_diameter};
}

}  // namespace

bool GearBody::operator==(const GearBody& other) const {
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  const auto holes = [](const GearBody& body) { return body.web ? body.web->holes.count : 0; };
  return torque_end == other.torque_end && rigid == other.rigid && hold == other.hold && web.has_value() == other.web.has_value() &&
         holes(*this) == holes(other) && std::ranges::equal(lengths(*this), lengths(other), same);
}

const char* to_string(BodyHold hold) { return hold == BodyHold::Shaft ? "shaft" : "rigid_bore"; }

double hole_stiffness(const WebHoles& holes) {
  if (holes.count == 0) return 1;
  return std::pow(1 - holes.count * holes.diameter / (4 * holes.circle_diameter), 3);
}

double default_shaft_diameter(const ToothForm& form, double normal_module) {
  return std::min({1.6 * form.reference_radius(), 25 * normal_module / std::cos(form.helix_angle()), 2 * form.root_radius() - 1.2 * normal_module});
}

GearBody complete_body(const GearBody& body, const ToothForm& form, double normal_module, double face_width) {
  GearBody complete = body;
  if (body.hold == BodyHold::Shaft) {
    if (std::isnan(body.shaft_diameter)) complete.shaft_diameter = default_shaft_diameter(form, normal_module);
    if (std::isnan(body.bore_diameter)) complete.bore_diameter = default_bore_share * complete.shaft_diameter;
    if (std::isnan(body.shaft_overhang)) complete.shaft_overhang = 0.5 * complete.shaft_diameter;
  } else if (std::isnan(body.bore_diameter)) {
    complete.bore_diameter = default_shaft_diameter(form, normal_module);
  }
  if (complete.web) {
    WebbedBody& web = *complete.web;
    const double carrier = complete.hold == BodyHold::Shaft ? complete.shaft_diameter : complete.bore_diameter;
    if (std::isnan(web.hub_diameter)) web.hub_diameter = default_hub_share * carrier;
    if (std::isnan(web.hub_width)) web.hub_width = face_width;
    if (web.holes.count > 0 && std::isnan(web.holes.circle_diameter)) {
      web.holes.circle_diameter = 0.5 * (web.hub_diameter + 2 * (form.root_radius() - web.rim_thickness));
    }
  }
  return complete;
}

GearBody in_units(GearBody body, double unit) {
  for (double* length : {&body.shaft_diameter, &body.bore_diameter, &body.shaft_overhang}) *length /= unit;
  if (body.web) {
    WebbedBody& web = *body.web;
    for (double* length : {&web.rim_thickness, &web.web_thickness, &web.web_offset, &web.hub_diameter, &web.hub_width, &web.holes.diameter,
                           &web.holes.circle_diameter}) {
      *length /= unit;
    }
  }
  return body;
}

double rim_radius(const ToothForm& form, double inner_diameter, double normal_module) {
  const double root = form.root_radius(), inner = inner_diameter / 2;
  return root - inner < 1.8 * normal_module ? inner : root - 1.25 * normal_module;
}

BodyRadii body_radii(const GearBody& given, const ToothForm& form, double normal_module, double face_width) {
  const GearBody body = complete_body(given, form, normal_module, face_width);
  const double root = form.root_radius();
  BodyRadii radii;
  radii.bore = body.bore_diameter / 2;
  // The blocks of the teeth need at least half a module of rim.
  const double largest = root - 0.5 * normal_module;
  if (body.hold == BodyHold::Shaft) {
    radii.carrier = body.shaft_diameter / 2;
    if (!(radii.carrier > 0 && radii.carrier <= largest)) {
      throw InvalidInput("body.shaft_diameter", std::to_string(body.shaft_diameter), "more than 0 and at most " + millimetres(2 * largest));
    }
    if (!(radii.bore > 0 && radii.bore < 0.9 * radii.carrier)) {
      throw InvalidInput("body.bore_diameter", std::to_string(body.bore_diameter), "more than 0 and less than 0.9 of the shaft");
    }
    if (!(body.shaft_overhang > 0) || !std::isfinite(body.shaft_overhang)) {
      throw InvalidInput("body.shaft_overhang", std::to_string(body.shaft_overhang), "more than 0 mm");
    }
  } else {
    const auto no_shaft = [](const char* field, double value) {
      if (!std::isnan(value)) throw InvalidInput(field, std::to_string(value), "not given where the bore is held rigidly: there is no shaft");
    };
    no_shaft("body.shaft_diameter", body.shaft_diameter);
    no_shaft("body.shaft_overhang", body.shaft_overhang);
    radii.carrier = radii.bore;
    if (!(radii.bore > 0 && radii.bore <= largest)) {
      throw InvalidInput("body.bore_diameter", std::to_string(body.bore_diameter), "more than 0 and at most " + millimetres(2 * largest));
    }
  }
  double inside_teeth = 2 * radii.carrier;
  if (body.web) {
    radii.underside = root - body.web->rim_thickness;
    radii.hub = body.web->hub_diameter / 2;
    check_web(*body.web, radii, root, normal_module, face_width);
    inside_teeth = 2 * radii.underside;
  }
  radii.teeth = rim_radius(form, inside_teeth, normal_module);
  return radii;
}

}  // namespace flankwright
