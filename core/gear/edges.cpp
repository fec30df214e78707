#include "core/gear/edges.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

constexpr double usual_radius = 0.05;            // of the module
constexpr double largest_tip_share = 1.0 / 4.0;  // of the tooth's thickness at the tip

double base_helix(const Gear& gear) { return std::atan(gear.helix_rate * gear.base_radius); }

/// Angle between the normals of flank and cylinder at a radius: that of the edge where the flank is cut off there [rad].
double tip_corner_angle(const Gear& gear, double radius) { return std::acos(std::cos(base_helix(gear)) * std::sin(gear.pressure_angle_at(radius))); }

/// delta of set_tip_edge() [rad].
double edge_slant(const Gear& gear, double corner) { return std::atan(std::sin(base_helix(gear)) * std::tan(gear.pressure_angle_at(corner))); }

/// Length along the profile from the corner at a radius to where the arc of an edge of radius rho begins, see set_tip_edge() [mm].
double edge_arc(const Gear& gear, double corner, double rho, double flat_angle) {
  const double gamma = tip_corner_angle(gear, corner) - flat_angle;
  return rho * std::tan(0.5 * gamma) / std::cos(edge_slant(gear, corner));
}

/// Angle between the normals of flank and end face [rad].
double end_corner_angle(const Gear& gear, bool acute) { return 0.5 * units::pi + (acute ? 1.0 : -1.0) * base_helix(gear); }

/// What an edge takes off the flank, along the axis [mm].
double taken_off_face(const Gear& gear, bool acute) {
  const EdgeChamfer& chamfer = gear.data.end_chamfer;
  const double gamma = end_corner_angle(gear, acute) - (chamfer.amount > 0.0 ? chamfer.angle : 0.0);
  return chamfer.amount + gear.data.end_edge_radius() * std::tan(0.5 * gamma) * std::cos(base_helix(gear));
}

/// Thickness that a chamfer leaves of the tooth at the tip, transverse section [mm].
double chamfered_tip(const Gear& gear) {
  const EdgeChamfer& chamfer = gear.data.tip_chamfer;
  const double corner = gear.tip_radius - chamfer.amount, cos_helix = std::cos(std::atan(gear.helix_rate * corner));
  return gear.tooth_thickness_at(corner) - 2.0 * chamfer.amount / (std::tan(chamfer.angle) * cos_helix);
}

/// Radius of the tip rounding whose arc begins at the form circle: the square of the roll length there falls in proportion to the radius [mm].
double tip_rounding_down_to(const Gear& gear, double form_radius) {
  const double tip = gear.roll_length_at(gear.tip_radius), form = gear.roll_length_at(form_radius);
  return (tip * tip - form * form) / (2.0 * gear.base_radius * edge_arc(gear, gear.tip_radius, 1.0, 0.0));
}

bool leaves_flank_and_tip(const Gear& gear, double form_radius) {
  return gear.tip_radius - gear.data.tip_chamfer.amount > form_radius && gear.tip_form_radius > form_radius && chamfered_tip(gear) > 0.0;
}

/// Largest amount of a tip chamfer of this angle and edge radius that leaves flank and tip, by bisection [mm].
double largest_tip_chamfer(Gear gear, double form_radius) {
  double least = 0.0, most = gear.tip_radius - form_radius;
  while (most - least > 0.1 * units::um) {
    double& amount = gear.data.tip_chamfer.amount;
    amount = 0.5 * (least + most);
    set_tip_edge(gear);
    (leaves_flank_and_tip(gear, form_radius) ? least : most) = amount;
  }
  return least;
}

/// "0 .. 0.847 mm", rounded down to micrometres so that the limit itself is allowed.
std::string up_to(double limit) {
  constexpr double round_off = 1e-6;  // um
  return "0 .. " + in_words(std::max(0.0, std::floor(limit / units::um - round_off)) * units::um) + " mm";
}

/// Collects what does not hold.
struct Problems {
  std::vector<InvalidInput> found{};
  void require(bool holds, const std::string& field, double value, const std::string& allowed) {
    if (!holds) found.emplace_back(field, in_words(value), allowed);
  }
};

/// What a chamfer may be wherever it stands.
void check_chamfer(const EdgeChamfer& chamfer, double rounding, const std::string& name, const std::string& a_rounding, Problems& problems) {
  problems.require(chamfer.radius >= 0.0, name + ".radius", chamfer.radius, "0 mm (sharp) or more");
  problems.require(chamfer.amount >= 0.0, name + ".amount", chamfer.amount, "0 mm (none) or more");
  problems.require(!(chamfer.amount > 0.0) || rounding == 0.0, name + ".amount", chamfer.amount,
                   "0 beside " + a_rounding + ": the chamfer's edge has a radius of its own");
}

}  // namespace

void set_tip_edge(Gear& gear) {
  const EdgeChamfer& chamfer = gear.data.tip_chamfer;
  const double corner = gear.tip_radius - chamfer.amount, rho = gear.data.tip_edge_radius();
  gear.tip_form_radius = corner;
  gear.tip_edge_radius = 0.0;
  if (!(rho > 0.0) || !(corner > gear.base_radius)) return;
  const double delta = edge_slant(gear, corner);
  const double arc = edge_arc(gear, corner, rho, chamfer.amount > 0.0 ? chamfer.angle : 0.0), roll = gear.roll_length_at(corner);
  const double square = roll * roll - 2.0 * gear.base_radius * arc;
  gear.tip_form_radius = std::sqrt(gear.base_radius * gear.base_radius + std::max(0.0, square));
  gear.tip_edge_radius = rho / (std::cos(delta) * std::cos(delta));
}

FaceRange flank_range(const Gear& gear, int acute_end) {
  const double half = 0.5 * gear.data.face_width;
  const double at_acute = taken_off_face(gear, true), at_obtuse = taken_off_face(gear, false);
  return acute_end > 0 ? FaceRange{-half + at_obtuse, half - at_acute} : FaceRange{-half + at_acute, half - at_obtuse};
}

double usual_edge_radius(const Gear& gear, double normal_module) {
  const double tip = largest_tip_share * gear.tooth_thickness_at(gear.tip_radius);
  return tip > 0.0 ? std::min(usual_radius * normal_module, tip) : 0.0;
}

std::vector<InvalidInput> find_edge_problems(const Gear& gear, double form_radius, const std::string& name) {
  Problems problems;
  const double rounding = gear.data.tip_rounding;
  const std::string form_circle = "the form circle, diameter " + in_words(2.0 * form_radius) + " mm";
  const double half_tip = 0.5 * gear.tooth_thickness_at(gear.tip_radius), to_form = tip_rounding_down_to(gear, form_radius);
  const bool leaves_flank = gear.data.tip_chamfer.amount > 0.0 || gear.tip_form_radius > form_radius;  // beside a chamfer it is refused below
  problems.require(rounding == 0.0 || (rounding > 0.0 && leaves_flank && rounding < half_tip), name + ".edges.tip_rounding", rounding,
                   up_to(std::min(half_tip, to_form)) +
                       (half_tip < to_form ? ", less than half of the tooth's thickness at the tip" : ", which leaves a flank above " + form_circle));
  const EdgeChamfer &tip = gear.data.tip_chamfer, &end = gear.data.end_chamfer;
  const std::string tip_name = name + ".edges.tip_chamfer", end_name = name + ".edges.end_chamfer";
  check_chamfer(tip, rounding, tip_name, "a tip_rounding", problems);
  const double corner = gear.tip_radius - tip.amount;
  if (tip.amount > 0.0 && corner > form_radius) {
    const double steepest = tip_corner_angle(gear, corner);
    problems.require(tip.angle > 0.0 && tip.angle < steepest, tip_name + ".angle", tip.angle / units::deg,
                     "above 0 and below " + in_words(steepest / units::deg) + " deg, where the flat would go on from the flank");
  }
  if (tip.amount > 0.0 && !leaves_flank_and_tip(gear, form_radius)) {
    problems.require(
        false, tip_name + ".amount", tip.amount,
        up_to(largest_tip_chamfer(gear, form_radius)) + ", which leaves a flank above " + form_circle + ", and part of the tip between the flats");
  }
  check_chamfer(end, gear.data.end_rounding, end_name, "an end_rounding", problems);
  problems.require(gear.data.end_rounding >= 0.0, name + ".edges.end_rounding", gear.data.end_rounding, "0 mm (sharp) or more");
  if (end.amount > 0.0) {
    const double steepest = end_corner_angle(gear, false);
    problems.require(end.angle > 0.0 && end.angle < steepest, end_name + ".angle", end.angle / units::deg,
                     "above 0 and below " + in_words(steepest / units::deg) + " deg, where the flat would go on from the flank at the obtuse end");
  }
  const double face_width = gear.data.face_width, taken = taken_off_face(gear, true) + taken_off_face(gear, false);
  constexpr double least_face = 0.01;  // of the face width, which is left between both ends
  if (!(taken <= (1.0 - least_face) * face_width)) {
    const bool by_chamfer = end.amount > 0.0;
    const double given = by_chamfer ? end.amount : gear.data.end_rounding;
    const double most = (1.0 - least_face) * face_width, largest = by_chamfer ? 0.5 * (most - taken) + end.amount : given * most / taken;
    problems.require(false, by_chamfer ? end_name + ".amount" : name + ".edges.end_rounding", given,
                     up_to(largest) + ", which leaves a hundredth of the face width of " + in_words(face_width) + " mm between both ends");
  }
  return std::move(problems.found);
}

bool leaves_room_for_tip_chamfer(const Gear& gear) {
  const EdgeChamfer& chamfer = gear.data.tip_chamfer;
  const double corner = gear.tip_radius - chamfer.amount;
  return gear.tip_form_radius > gear.base_radius && chamfer.angle < tip_corner_angle(gear, corner) && chamfered_tip(gear) > 0.0;
}

}  // namespace flankwright
