#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/unloaded/contact_ellipse.hpp"
#include "core/contact/unloaded/parabola_check.hpp"
#include "core/flank/conjugate_field.hpp"
#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

// Predesigned parabola of the transmission error: the mesh lags by r_b2 a phi1^2 along the line that touches at phi1.
//
// A pinion's point that touches at phi1 + x falls behind by K x^2/2 when it is asked to touch at phi1, K =
// (rho_1^2/r_b2)(1/rho_1 + 1/rho_2) (for the wheel's point (rho_2 N1/N2)^2 for rho_1^2). If the lag itself were removed,
// contact would slide to where -a (phi1 + x)^2 - K x^2/2 is largest and keep only K/(K + 2 a) of the parabola: the flank has to
// yield by K/(K - 2 a) of the lag.

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::arcsec;
using units::deg;
using units::pi;

namespace {

constexpr double kAngleRoundOff = 1e-12;  // rad

Modification parabola(double a, double lead_crowning = 0.0) {
  Modification m;
  m.parabolic_te = a;
  m.lead_crowning = lead_crowning;
  return m;
}

/// K of the member that carries the parabola, at a point of contact.
double falling_behind(const GearPair& pair, Member member, const ToothContact& contact) {
  const double rho1 = pair.pinion.roll_length_at(contact.pinion_radius), rho2 = pair.wheel.roll_length_at(contact.wheel_radius);
  const double own = member == Member::Pinion ? rho1 : rho2 / pair.gear_ratio();
  return own * own * (1 / rho1 + 1 / rho2) / pair.wheel.base_radius;
}

/// What a small misalignment asks of a crowned pair, see ParabolaCheck: where it moves the contact, where the vertex,
/// and which share of the margin of the path of contact that takes.
struct Absorption {
  double z, vertex, use;
  Absorption(const GearPair& pair, const Misalignment& misalignment, double a, double crown) {
    const double b = pair.base_helix_angle, alpha = pair.working_transverse_pressure_angle, face = pair.face_width;
    const double pitch = 2 * pi / pair.data.pinion.teeth, rise = pair.contact_line_sense() * std::tan(b);
    // A lead-angle error of a left-hand pinion acts as the crossing of the same sign, TM-107451, fig. 3.
    const double closing = (misalignment.crossing - pair.contact_line_sense() * misalignment.pinion_lead_angle) * std::cos(alpha) -
                           misalignment.intersecting * std::sin(alpha);
    z = closing * face * face / (8 * crown * std::pow(std::cos(b), 2));
    vertex = closing * rise / pair.gear_ratio() / (2 * a);
    const double middle = (0.5 * (pair.path_start + pair.path_end) - pair.pitch_point - z * rise) / pair.pinion.base_radius;
    use = std::abs(vertex - middle) / (0.5 * (pair.transverse_contact_ratio - 1) * pitch);
  }
};

ParabolaCheck check(const GearPair& pair, const Misalignment& misalignment, const Modification& pinion, const Modification& wheel, double a) {
  const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
  return check_parabola(scene, analyse_unloaded_mesh(pair, scene, 64), a);
}

}  // namespace

TEST_CASE("The removal for a parabola is the same along each line of contact and on either gear", "[core][flank][closed-form]") {
  const double beta = GENERATE(0.0, 22.0) * deg, a = 4e-4;
  const GearPair pair = make_gear_pair(pair_data(25, 60, beta, 0.2, 0.1));
  const FlankFrame pinion = pair.flank_frame(Member::Pinion), wheel = pair.flank_frame(Member::Wheel);
  const Modification m = parabola(a);
  for (const double phi1 : {-0.11, -0.02, 0.0, 0.07}) {
    for (const double z : {-12.0, 0.0, 5.0}) {
      // The line that touches at phi1: rho_1 = rho_w + r_b1 (phi1 + z/p), rho_2 the rest of the path.
      const double rho1 = pair.pitch_point + pair.pinion.base_radius * (phi1 + pinion.helix_rate * z), rho2 = pair.path_length - rho1;
      const double r1 = std::hypot(pair.pinion.base_radius, rho1), r2 = std::hypot(pair.wheel.base_radius, rho2);
      const double expected = pair.wheel.base_radius * a * phi1 * phi1;
      CHECK(std::abs(removal(m, pinion, r1, z) - expected) <= 1e-14);
      CHECK(std::abs(removal(m, wheel, r2, z) - expected) <= 1e-14);
      CHECK(std::abs(removal_derivative(m, pinion, parameter_of("parabolic_te"), r1, z) - expected / a) <= 1e-10);
      CHECK(std::abs(removal_derivative(m, wheel, parameter_of("parabolic_te"), r2, z) - expected / a) <= 1e-10);
    }
  }
}

TEST_CASE("An aligned pair's transmission error is the predesigned parabola to round-off", "[core][flank][closed-form]") {
  const double beta = GENERATE(0.0, 20.0) * deg, a = GENERATE(1e-5, 3e-4, 3e-3);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const bool crowned = GENERATE(false, true);
  const WorkingFlank flank = GENERATE(WorkingFlank::Right, WorkingFlank::Left);
  PairData data = pair_data(30, 100, beta, 0.2, -0.1);
  data.working_flank = flank;
  const GearPair pair = make_gear_pair(data);
  const Modification carrier = parabola(a, crowned ? 0.02 : 0.0);
  const FlankAssembly scene = member == Member::Pinion ? scene_of(pair, {}, carrier) : scene_of(pair, {}, {}, carrier);
  for (const double phi1 : {-0.09, -0.03, 0.0, 0.05, 0.09}) {
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    CAPTURE(beta / deg, a, phi1, crowned, to_string(contact.kind));
    CHECK(contact.kind == (crowned ? ContactKind::Surface : ContactKind::Line));
    CHECK(std::abs(contact.transmission_error + a * phi1 * phi1) <= kAngleRoundOff);
    CHECK(std::abs(contact.slope + 2 * a * phi1) <= 1e-7);  // round-off of the place on a flat line
    if (crowned) continue;
    const ContactEllipse ellipse = contact_ellipse(scene, contact, 0.006);
    CHECK(std::abs(ellipse.least_curvature) <= 1e-8 * ellipse.greatest_curvature);
  }
}

TEST_CASE("Removal exceeds the lag by the sliding of the contact", "[core][flank][closed-form]") {
  const double beta = GENERATE(0.0, 20.0) * deg, a = GENERATE(1e-4, 3e-3);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = make_gear_pair(pair_data(30, 100, beta, 0.2, -0.1));
  const Modification m = parabola(a);
  const FlankAssembly scene = member == Member::Pinion ? scene_of(pair, {}, m) : scene_of(pair, {}, {}, m);
  const FlankFrame frame = pair.flank_frame(member);
  for (const double phi1 : {-0.09, -0.03, 0.05, 0.09}) {
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    const bool on_pinion = member == Member::Pinion;
    const double radius = on_pinion ? contact.pinion_radius : contact.wheel_radius, z = on_pinion ? contact.pinion_z : contact.wheel_z;
    const double lag = removal(m, frame, radius, z);
    const double exact = make_conjugate_field(pair, member, a)->at(pair[member].roll_length_at(radius), z).value;
    const double k = falling_behind(pair, member, contact);
    CAPTURE(beta / deg, a, phi1, exact / lag);
    CHECK(std::abs(exact - lag - lag * 2 * a / (k - 2 * a)) <= 0.2 * lag * 2 * a / k + 1e-12);  // model: K along the profile
  }
}

TEST_CASE("The conjugate flank's derivative by its coefficient is the lag's at the involute and that of differences elsewhere", "[core][flank]") {
  const double beta = GENERATE(0.0, 20.0) * deg;
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = make_gear_pair(pair_data(30, 100, beta, 0.2, -0.1));
  const FlankFrame frame = pair.flank_frame(member);
  const double lowest = pair[member].roll_length_at(pair[member].active_root_radius);
  const double highest = pair[member].roll_length_at(pair[member].tip_radius);
  for (const double share : {0.1, 0.5, 0.9}) {
    const double rho = lowest + share * (highest - lowest), z = 7.0;
    const double lag = removal_derivative({}, frame, parameter_of("parabolic_te"), std::hypot(frame.base_radius, rho), z);
    constexpr double kRoundOff = 1e-12;  // mm rad
    CHECK(std::abs(make_conjugate_field(pair, member, 0.0)->coefficient_slope(rho, z) - lag) <= kRoundOff);
    const double a = 1e-3, step = 1e-5;
    const auto at = [&](double coefficient) { return make_conjugate_field(pair, member, coefficient)->at(rho, z).value; };
    const double slope = make_conjugate_field(pair, member, a)->coefficient_slope(rho, z);
    CAPTURE(share, slope, lag);
    // discretisation: third derivative times the step's square; round-off: 1e-14 mm over the step
    CHECK(std::abs(slope - (at(a + step) - at(a - step)) / (2 * step)) <= 1e-4 * std::abs(slope) + 1e-8);
    CHECK(std::abs(slope - lag) > 1e-3 * std::abs(lag));  // beyond first order
  }
}

TEST_CASE("Derivatives of the conjugate flank agree with differences, across the ends of its exact range too", "[core][flank]") {
  const double beta = GENERATE(0.0, 20.0) * deg;
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = make_gear_pair(pair_data(30, 100, beta));
  const auto field = make_conjugate_field(pair, member, 2e-3);
  const Gear& gear = pair[member];
  constexpr double kStep = 1e-3;  // mm
  for (const double rho : {0.5 * gear.roll_length_at(gear.active_root_radius), gear.roll_length_at(gear.reference_radius),
                           gear.roll_length_at(gear.tip_radius), 1.1 * gear.roll_length_at(gear.tip_radius)}) {
    for (const double z : {-13.0, 4.0}) {
      const Jet here = field->at(rho, z), up = field->at(rho + kStep, z), down = field->at(rho - kStep, z);
      const Jet right = field->at(rho, z + kStep), left = field->at(rho, z - kStep);
      CAPTURE(rho, z, beta / deg);
      const double kDiscretisation = 1e-8;
      CHECK(std::abs(here.u - (up.value - down.value) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(here.v - (right.value - left.value) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(here.uu - (up.u - down.u) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(here.uv - (right.u - left.u) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(here.vv - (right.v - left.v) / (2 * kStep)) <= kDiscretisation);
    }
  }
}

TEST_CASE("A parabola that would fold the flank inside its pitch is refused with the largest that does not", "[core][flank][closed-form]") {
  const GearPair pair = make_gear_pair(pair_data(18, 54, GENERATE(0.0, 20.0) * deg));
  // Lowest point that carries: half a pitch before the pitch point. Contact may slow down to half there, 2 a = K/2.
  const double rho1 = pair.pitch_point - pair.pinion.base_radius * pi / 18;
  const double k = rho1 * rho1 / pair.wheel.base_radius * (1 / rho1 + 1 / (pair.path_length - rho1));
  // model: K at the pitch point as it is, which the parabola moves
  CHECK_NOTHROW(make_conjugate_field(pair, Member::Pinion, 0.05 * k));
  CHECK_THROWS_AS(make_conjugate_field(pair, Member::Pinion, 0.35 * k), InvalidInput);
  CHECK_THROWS_WITH(make_conjugate_field(pair, Member::Pinion, 0.35 * k), Catch::Contains("over a whole pitch"));
}

TEST_CASE("Below the point where the flank would fold its slope continues, and the leading pair keeps the parabola", "[core][flank]") {
  // 18 teeth: the active profile starts close to the base circle, where K is small.
  const GearPair pair = make_gear_pair(pair_data(18, 54, 0.0));
  const double a = 6e-3;
  const auto field = make_conjugate_field(pair, Member::Pinion, a);
  const double start = pair.path_start;
  REQUIRE(2 * a > 0.5 * start * start / pair.wheel.base_radius * (1 / start + 1 / (pair.path_length - start)));
  const Jet here = field->at(start, 0.0), below = field->at(start - 0.1, 0.0);
  CHECK(here.uu == 0.0);
  CHECK(std::abs(below.value - (here.value - 0.1 * here.u)) <= 1e-14);
  const FlankAssembly scene = scene_of(pair, {}, parabola(a, 0.01));
  for (const double phi1 : {-pi / 18, -0.05, 0.06, pi / 18}) {
    CHECK(std::abs(find_tooth_contact(scene, 0, phi1).transmission_error + a * phi1 * phi1) <= kAngleRoundOff);
  }
}

TEST_CASE("Over a pitch the parabola's height is a (pi/N1)^2, whatever carries it", "[core][flank][closed-form]") {
  const double beta = GENERATE(0.0, 20.0) * deg;
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const double a = 2e-4;
  const GearPair pair = make_gear_pair(pair_data(30, 100, beta));
  const Modification carrier = parabola(a, 0.02);
  const bool on_pinion = member == Member::Pinion;
  const FlankAssembly scene = scene_of(pair, {}, on_pinion ? carrier : Modification{}, on_pinion ? Modification{} : carrier);
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 64);
  CHECK(std::abs(mesh.peak_to_peak / (a * std::pow(pi / 30, 2)) - 1) <= 1e-7);  // round-off over 0.5 arcsec
  const ParabolaCheck found = check_parabola(scene, mesh, a);
  CAPTURE(found.why);
  CHECK(found.holds);
  CHECK(std::abs(found.found / a - 1) <= 1e-6);
  CHECK(std::abs(found.shift) <= 1e-6 * pi / 30);
  // Half on each gear is the whole, to first order in a.
  const Modification half = parabola(a / 2, 0.02);
  const UnloadedMesh shared = analyse_unloaded_mesh(pair, scene_of(pair, {}, half, half), 64);
  CHECK(std::abs(shared.peak_to_peak / mesh.peak_to_peak - 1) <= 4e-3);
}

TEST_CASE("Misalignment of 3 minutes shifts the parabola of a crowned pair and leaves its coefficient", "[core][flank][closed-form]") {
  const double a = 3e-3, crown = 0.120, sign = GENERATE(1.0, -1.0);
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  Misalignment crossing, lead, intersecting, both;
  crossing.crossing = lead.pinion_lead_angle = intersecting.intersecting = both.intersecting = sign * 3 * arcmin;
  both.crossing = sign * -1.5 * arcmin;
  for (const Misalignment& misalignment : {crossing, lead, intersecting, both}) {
    const Absorption expected(pair, misalignment, a, crown);
    REQUIRE(expected.use < 1.0);
    REQUIRE(std::abs(expected.z) < 0.5 * pair.face_width);
    const ParabolaCheck found = check(pair, misalignment, parabola(a, crown), {}, a);
    CAPTURE(sign, expected.use, found.found / a, found.shift, expected.vertex, found.residual, found.why);
    CHECK(found.right_sign);
    CHECK(found.holds);
    CHECK(std::abs(found.found / a - 1) <= 2e-3);                                                         // model: second order in the misalignment
    CHECK(std::abs(found.shift - expected.vertex) <= 0.08 * std::abs(expected.vertex) + 0.01 * pi / 30);  // model: K along the profile
    CHECK(found.residual <= 0.02 * a * std::pow(pi / 30, 2));
  }
}

TEST_CASE("The parabola holds until its vertex has moved by (eps_alpha - 1)/2 of a pitch, and not far beyond", "[core][flank][closed-form][slow]") {
  const double a = GENERATE(1e-3, 2e-3), crown = a == 1e-3 ? 0.020 : 0.040, sign = GENERATE(1.0, -1.0);
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  double holds_to = 0.0, fails_from = 10.0;
  for (double minutes = 0.5; minutes <= 8.0; minutes += 0.5) {
    Misalignment misalignment;
    misalignment.crossing = sign * minutes * arcmin;
    const ParabolaCheck found = check(pair, misalignment, parabola(a, crown), {}, a);
    const double use = Absorption(pair, misalignment, a, crown).use;
    CAPTURE(a, crown, minutes, use, found.residual / (a * std::pow(pi / 30, 2)), found.why);
    if (use <= 1.0) CHECK(found.holds);
    if (use >= 1.7) CHECK_FALSE(found.holds);
    CHECK(found.holds == found.why.empty());
    if (found.holds) holds_to = std::max(holds_to, use);
    if (!found.holds) {
      fails_from = std::min(fails_from, use);
      CHECK(found.why.find("contact runs on a") != std::string::npos);
    }
  }
  CHECK(holds_to < fails_from + 0.2);
}

TEST_CASE("Crowning keeps a crossed spur pair's parabola on the flanks until the contact reaches the face end", "[core][flank][closed-form]") {
  // The closing g cos(a) z against C (2z/b)^2: contact at z = g cos(a) b^2/(8 C), at the face end from g = 4 C/(b
  // cos(a)) on.
  const double a = 3e-4, crown = GENERATE(0.004, 0.010);
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0));
  const double limit = 4 * crown / (30.0 * std::cos(pair.working_transverse_pressure_angle));
  for (const double share : {0.3, 0.95, 1.05, 2.0}) {
    Misalignment misalignment;
    misalignment.crossing = share * limit;
    const ParabolaCheck found = check(pair, misalignment, parabola(a, crown), {}, a);
    CAPTURE(crown, share, found.why);
    CHECK(found.right_sign);
    CHECK(found.holds == (share < 1.0));
    if (share > 1.0) CHECK(found.why.find("face end over 100 % of the pitch") != std::string::npos);
    CHECK(std::abs(found.found / a - 1) <= 0.02);  // the transmission error itself stays a parabola
  }
}

TEST_CASE("Without crowning beside it a parabola does not absorb crossed axes", "[core][flank]") {
  const double a = 1e-3;
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  Misalignment misalignment;
  misalignment.crossing = 1 * arcmin;
  REQUIRE(Absorption(pair, misalignment, a, 0.040).use < 1.0);
  CHECK(check(pair, misalignment, parabola(a, 0.040), {}, a).holds);
  const ParabolaCheck bare = check(pair, misalignment, parabola(a), {}, a);
  CHECK_FALSE(bare.holds);
  CHECK(bare.why.find("more lead crowning") != std::string::npos);
}
