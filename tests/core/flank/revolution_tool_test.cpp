#include "core/flank/revolution_tool.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/contact/unloaded/tooth_contact.hpp"
#include "core/flank/generated_field.hpp"
#include "core/gear/tool_section.hpp"
#include "tests/core/flank/rolling.hpp"
#include "tests/common/about.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using units::deg;
using units::inch;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The example of TM-100260: 20/40 teeth, P_n = 10 1/in, psi_c = 20 deg; the face width is not given there.
PairData data_of() {
  PairData data;
  data.normal_module = inch / 10.0;
  data.pinion.teeth = 20;
  data.wheel.teeth = 40;
  data.pinion.face_width = data.wheel.face_width = 0.5 * inch;
  return data;
}

RevolutionTool paper_tool() { return {80 * deg, 0.176 * inch, 500 * inch}; }

struct Revolved {
  GearPair pair;
  Flank flank;
  double reference_roll;
};

Revolved revolve(const RevolutionTool& tool, PairData data = data_of(), Member member = Member::Pinion) {
  data[member].generation = tool;
  Revolved made{make_gear_pair(data), {}, not_given};
  made.flank = make_flank(made.pair, member, {}, {});
  made.flank.fields = {make_generated_field(made.pair, member)};
  made.reference_roll = made.pair[member].roll_length_at(made.pair[member].reference_radius);
  return made;
}

double roll_at_share(const Flank& flank, double share) { return flank.lowest_roll() + share * (flank.highest_roll() - flank.lowest_roll()); }

/// How far a point of the rack's frame lies inside the tool: its distance from the circle of the arc, rho and centre in
/// the meridian plane; from the generatrix for a cone.
double inside_tool(const RevolutionTool& tool, double apex_distance, double pressure_angle, const Eigen::Vector3d& p) {
  const double sa = std::sin(pressure_angle), ca = std::cos(pressure_angle);
  const double st = std::sin(tool.half_apex), ct = std::cos(tool.half_apex);
  const double along = p.x() * ca - p.y() * sa, out = p.x() * sa + p.y() * ca;
  // Distance from the tool's axis and height along it, from the tangent point's.
  const double from_axis = std::hypot((apex_distance - along) * st + out * ct, p.z()) - apex_distance * st;
  const double height = along * ct + out * st;
  const double normal = from_axis * ct + height * st, tangential = height * ct - from_axis * st;
  if (tool.arc_radius == kInfinity) return -normal;
  const double x = tool.arc_radius + normal;  // rho - hypot(x, tangential), without cancellation
  return -(normal * (2 * tool.arc_radius + normal) + tangential * tangential) / (tool.arc_radius + std::hypot(x, tangential));
}

/// Second derivative of the transmission error at the angle where its vertex is expected [rad/rad^2].
double second_difference(const FlankAssembly& scene, double vertex, double step) {
  const auto error = [&](double phi1) { return find_tooth_contact(scene, 0, phi1).transmission_error; };
  return (error(vertex + step) - 2.0 * error(vertex) + error(vertex - step)) / (step * step);
}

}  // namespace

TEST_CASE("A tool of revolution cuts nowhere deeper than its flank and touches it once", "[core][flank]") {
  RevolutionTool tool = paper_tool();
  tool.arc_radius = GENERATE(as<double>{}, kInfinity, 12700.0, 900.0);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  PairData data = data_of();
  data.pinion.profile_shift = 0.1;
  const auto made = revolve(tool, data, member);
  const GearPair& pair = made.pair;
  const double apex = RevolutionSection(tool, pair.data, pair[member].data).apex_distance();
  for (const double z : {-6.3, -2.0, 0.0, 4.0}) {
    for (double share = 0.0; share <= 1.0; share += 0.125) {
      const SurfacePoint at = surface_point(made.flank, roll_at_share(made.flank, share), z, 0, 0.0);
      const Point3<double> p{at.position.x(), at.position.y(), z};
      const auto clearance = [&](double psi) {
        const Eigen::Vector3d q = rolling::in_rack(pair, member, p, psi);
        return q.x() < rolling::tool_tip(pair, member) ? kInfinity : inside_tool(tool, apex, data.pressure_angle, q);
      };
      const double contact = rolling::roll_of_normal(pair, member, at);
      CAPTURE(z, share, contact);
      constexpr double kRoundOff = 1e-12;  // mm, on radii of 50 mm
      CHECK(std::abs(clearance(contact)) <= kRoundOff);
      CHECK(std::abs(rolling::least(clearance, contact - 0.4, contact + 0.4)) <= kRoundOff);
      CHECK(std::abs(at.normal.dot(at.d_rho)) <= kRoundOff);
      CHECK(std::abs(at.normal.dot(at.d_z)) <= kRoundOff);
    }
  }
}

TEST_CASE("The flank of a tool of revolution satisfies the paper's equation of meshing", "[core][flank]") {
  const RevolutionTool tool = paper_tool();
  const auto made = revolve(tool);
  const double alpha = tool.half_apex, psi_c = made.pair.data.pressure_angle, rho = tool.arc_radius;
  const double a1 = RevolutionSection(tool, made.pair.data, made.pair.pinion.data).apex_distance();
  for (const double z : {-5.0, 0.0, 3.0}) {
    for (double share = 0.0; share <= 1.0; share += 0.125) {
      const SurfacePoint at = surface_point(made.flank, roll_at_share(made.flank, share), z, 0, 0.0);
      const double psi = rolling::roll_of_normal(made.pair, Member::Pinion, at);
      const Eigen::Vector3d p = rolling::in_rack(made.pair, Member::Pinion, {at.position.x(), at.position.y(), z}, psi);
      // The point in S_a (inverse of eq. 17, with x_c = y and y_c = x here), its meridian and its place on the arc.
      const double x = p.y() + a1 * std::sin(psi_c), y = p.x() - a1 * std::cos(psi_c);
      const double xa = std::cos(alpha - psi_c) * x - std::sin(alpha - psi_c) * y;
      const double ya = std::sin(alpha - psi_c) * x + std::cos(alpha - psi_c) * y;  // from the apex
      const double theta = std::atan2(z, xa);
      const double radial = std::hypot(xa, z) - a1 * std::sin(alpha), axial = ya + a1 * std::cos(alpha);
      const double beta = std::asin((axial * std::cos(alpha) - radial * std::sin(alpha)) / rho);
      // Eq. 19; the paper's rack moves by -r_1 phi_p (eq. 21).
      const double residual =
          rho * std::sin(beta) * std::cos(theta) - a1 * std::sin(alpha) * std::sin(alpha + beta) * (std::cos(theta) - 1.0) -
          made.pair.pinion.reference_radius * psi *
              (std::sin(alpha + beta) * std::cos(alpha - psi_c) - std::cos(theta) * std::cos(alpha + beta) * std::sin(alpha - psi_c));
      CAPTURE(z, share);
      CHECK(std::abs(residual) <= 1e-11);  // mm, round-off
    }
  }
}

TEST_CASE("A cone leaves the involute in mid face and nowhere else", "[core][flank][closed-form]") {
  RevolutionTool cone = paper_tool();
  cone.arc_radius = kInfinity;
  const auto made = revolve(cone);
  for (double share = 0.0; share <= 1.0; share += 0.1) {
    const double rho = roll_at_share(made.flank, share);
    const Jet middle = made.flank.fields.front()->at(rho, 0.0);
    CHECK(middle.value == 0.0);
    CHECK(middle.u == 0.0);
    CHECK(middle.v == 0.0);
    CHECK(made.flank.fields.front()->at(rho, 3.0).value > 0.03);
  }
  // In the section z the cone lies deeper than its tangent plane by d = z^2/(w T + sqrt(w^2 T^2 + (T^2 - 1) z^2)), T =
  // tan(alpha), at the distance w from the apex along the generatrix.
  const RevolutionSection section(cone, made.pair.data, made.pair.pinion.data);
  const double t = std::tan(cone.half_apex);
  for (const double z : {-6.0, 0.5, 12.0}) {
    for (const double parameter : {-3.0, 0.0, 2.0}) {
      const auto point = section.at(parameter, z);
      const double wt = (section.apex_distance() - point.along) * t;
      CHECK(point.depth == Approx(z * z / (wt + std::sqrt(wt * wt + (t * t - 1) * z * z))).epsilon(1e-13));
    }
  }
}

TEST_CASE("At the reference circle a cone gives a lead crowning of z^2/(2 a_1 tan alpha)", "[core][flank][closed-form]") {
  RevolutionTool cone = paper_tool();
  cone.arc_radius = kInfinity;
  const auto made = revolve(cone);
  const double a1 = RevolutionSection(cone, made.pair.data, made.pair.pinion.data).apex_distance();
  const double curvature = 1.0 / (a1 * std::tan(cone.half_apex));
  CHECK(made.flank.fields.front()->at(made.reference_roll, 0.0).vv == Approx(curvature).epsilon(1e-12));
  const auto model_error = [&](double z) { return made.flank.fields.front()->at(made.reference_roll, z).value / (0.5 * curvature * z * z) - 1.0; };
  CHECK(std::abs(model_error(0.5)) < 1e-3);
  CHECK(model_error(1.0) / model_error(0.5) == Approx(4.0).epsilon(0.01));  // the next term is z^4
}

TEST_CASE("Cones become the straight rack as they flatten or grow, arcs become cones", "[core][flank]") {
  const double z = 5.0;
  const auto removed = [&](const RevolutionTool& tool, double share) {
    const auto made = revolve(tool);
    return made.flank.fields.front()->at(roll_at_share(made.flank, share), z).value;
  };
  const double share = GENERATE(0.1, 0.5, 1.0);
  const double straight = removed({89.99 * deg, 4.47, kInfinity}, share);
  // a_1 tan(alpha) grows as 1/cos^2(alpha).
  CHECK(straight == Approx(0.01 * removed({89.9 * deg, 4.47, kInfinity}, share)).epsilon(0.01));
  CHECK(straight < 1e-5);
  const double large = removed({80 * deg, 4.47e3, kInfinity}, share);
  CHECK(large == Approx(10.0 * removed({80 * deg, 4.47e4, kInfinity}, share)).epsilon(1e-2));
  const double cone = removed({80 * deg, 4.47, kInfinity}, share);
  const double flat = removed({80 * deg, 4.47, 1e6}, share) - cone, round = removed({80 * deg, 4.47, 1e5}, share) - cone;
  CHECK(round > 1e-8);
  CHECK(round / flat == Approx(10.0).epsilon(1e-3));  // model error of first order in 1/rho
}

TEST_CASE("An arc crowns the profile with the curvature tan^2(alpha)/rho at the reference circle", "[core][flank][closed-form]") {
  const RevolutionTool tool = paper_tool();
  const auto made = revolve(tool);
  const Jet there = made.flank.fields.front()->at(made.reference_roll, 0.0);
  const double tangent = std::tan(made.pair.data.pressure_angle);
  CHECK(std::abs(there.value) <= 1e-16);  // round-off
  CHECK(std::abs(there.u) <= 1e-16);
  CHECK(there.uu == Approx(tangent * tangent / tool.arc_radius).epsilon(1e-12));
}

TEST_CASE("The flank of a tool of revolution is symmetric about mid face, finite, and thinner than the involute", "[core][flank]") {
  const auto made = revolve(paper_tool());
  const DeviationField& field = *made.flank.fields.front();
  for (double share = 0.0; share <= 1.0; share += 0.05) {
    for (double z = 0.1; z <= 1.2 * made.flank.face.half(); z += 0.4) {
      const Jet front = field.at(roll_at_share(made.flank, share), z), back = field.at(roll_at_share(made.flank, share), -z);
      REQUIRE(std::isfinite(front.value));
      REQUIRE(front.value > 0.0);
      REQUIRE(front.value == back.value);
      REQUIRE(front.u == back.u);
      REQUIRE(front.v == -back.v);
      REQUIRE(front.uu == back.uu);
      REQUIRE(front.uv == -back.uv);
      REQUIRE(front.vv == back.vv);
    }
  }
}

TEST_CASE("The derivatives of a flank from a tool of revolution are those of its values and of each other", "[core][flank]") {
  RevolutionTool tool = paper_tool();
  tool.arc_radius = GENERATE(as<double>{}, kInfinity, 2500.0);
  const auto made = revolve(tool);
  const DeviationField& field = *made.flank.fields.front();
  constexpr double kStep = 1e-3;            // mm
  constexpr double kDiscretisation = 2e-9;  // step^2 times third derivatives of 1e-3, round-off / step
  for (const double z : {-7.0, 0.0, 0.3, 4.0}) {
    for (double share = -0.5; share <= 1.3; share += 0.1) {  // on the flank and where it is continued
      const double rho = roll_at_share(made.flank, share);
      const Jet at = field.at(rho, z);
      const Jet down = field.at(rho - kStep, z), up = field.at(rho + kStep, z);
      const Jet back = field.at(rho, z - kStep), front = field.at(rho, z + kStep);
      CAPTURE(z, share);
      CHECK(std::abs(at.u - (up.value - down.value) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(at.v - (front.value - back.value) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(at.uu - (up.u - down.u) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(at.uv - (up.v - down.v) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(at.uv - (front.u - back.u) / (2 * kStep)) <= kDiscretisation);
      CHECK(std::abs(at.vv - (front.v - back.v) / (2 * kStep)) <= kDiscretisation);
    }
  }
}

TEST_CASE("An arc's parabola of transmission error is the one unloaded contact finds", "[core][flank]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const double stretch = GENERATE(1.0, 1.01);  // of the centre distance; the paper takes 1 %
  PairData data = data_of();
  data.centre_distance = stretch * 0.5 * 60 * data.normal_module;
  const auto made = revolve(paper_tool(), data, member);
  const GearPair& pair = made.pair;
  FlankAssembly scene = assemble_flanks(pair, {});
  scene[member].fields = made.flank.fields;
  const double contact = member == Member::Pinion ? made.reference_roll : pair.path_length - made.reference_roll;
  const double vertex = (contact - pair.pitch_point) / pair.pinion.base_radius;
  const double coarse = second_difference(scene, vertex, 0.04), fine = second_difference(scene, vertex, 0.02);
  const double expected = parabola_of_arc(pair, member, paper_tool().arc_radius);
  CAPTURE(coarse, fine, expected);
  // Discretisation: the term of fourth order removed by Richardson's extrapolation, round-off 1e-15 / 0.02^2.
  CHECK(-0.5 * (4.0 * fine - coarse) / 3.0 == Approx(expected).epsilon(1e-6));
  if (stretch == 1.0) {
    // TM-100260, eq. 8 times N1/N2: m21' = -2 a.
    const double i = 0.5, psi_c = data.pressure_angle, r1 = pair.pinion.reference_radius, k = 1.0 / paper_tool().arc_radius;
    const double rate = -i * (1 + i) * std::tan(psi_c) * k / ((1 + i) / (r1 * std::sin(psi_c)) + k);
    CHECK(-2.0 * expected == Approx(rate).epsilon(1e-13));
  }
}

TEST_CASE("TM-100260's pinion has a transmission error of 0.32 arcsec peak to peak", "[core][flank][reference]") {
  PairData data = data_of();
  data.centre_distance = 1.01 * 0.5 * 60 * data.normal_module;
  const GearPair pair = make_gear_pair(data);
  const double half_pitch = units::pi / data.pinion.teeth;
  const double peak = parabola_of_arc(pair, Member::Pinion, paper_tool().arc_radius) * half_pitch * half_pitch;
  CHECK(peak / units::arcsec == tests::about(0.32, 0.005));  // model: two printed digits
}

TEST_CASE("A straight-sided tool gives no parabola, and an arc has a radius", "[core][flank]") {
  const GearPair pair = make_gear_pair(data_of());
  CHECK(parabola_of_arc(pair, Member::Wheel, kInfinity) == 0.0);
  CHECK_THROWS_AS(parabola_of_arc(pair, Member::Pinion, 0.0), InvalidInput);
}
