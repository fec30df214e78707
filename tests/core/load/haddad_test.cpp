#include <catch2/catch.hpp>
#include <optional>

#include "core/compliance/local/hertz_line.hpp"
#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/core/contact/contact_cases.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "tests/reference/haddad_1991.hpp"
#include "tests/common/about.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
namespace haddad = reference::haddad_1991;

namespace {

const Material kMaterial{haddad::youngs_modulus, haddad::poissons_ratio};

MeshModel haddad_model(const MeshEffects& effects = {}) {
  const GearPair gears = make_gear_pair(reference::haddad_18_54::pair_data());
  return make_mesh_model(gears, {kMaterial, kMaterial}, {{QuadratureRule::Gauss2, 5}, {haddad::phase_a, haddad::phase_b}}, effects);
}

/// Index of our point where the thesis has one: same tooth, same axial position to half its last digit.
std::optional<Eigen::Index> find(const MeshPosition& at, const haddad::Point& printed) {
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    const ContactPoint& point = at.points[i];
    if (point.tooth + haddad::reference_tooth == printed.tooth && std::abs(point.z + 60.0 - printed.z) < 1e-3) {
      return static_cast<Eigen::Index>(i);
    }
  }
  return std::nullopt;
}

template <class Points, class Compare>
int for_common_points(const MeshPosition& at, const Points& points, const Compare& compare) {
  int common = 0;
  for (std::size_t row = 0; row < points.size(); ++row) {
    const auto index = find(at, points[row]);
    if (!index) continue;
    ++common;
    CAPTURE(points[row].tooth, points[row].z);
    compare(row, points[row], *index);
  }
  return common;
}

bool on_path(double phase) { return phase >= reference::haddad_18_54::path_start && phase <= reference::haddad_18_54::path_end; }

}  // namespace

TEST_CASE("Our contact points are Haddad's", "[core][load][haddad]") {
  const MeshModel model = haddad_model();
  const auto check = [&](const MeshPosition& at, const auto& printed) {
    const int common = for_common_points(at, printed, [&](std::size_t, const haddad::Point& point, Eigen::Index i) {
      CHECK(at.points[static_cast<std::size_t>(i)].phase == tests::about(point.phase, 2 * haddad::phase_digit));  // round-off: digits
      CHECK(at.weight[i] * std::cos(model.pair.base_helix_angle) == Approx(12.0).epsilon(1e-12));
    });
    // The thesis lists whole intervals; what lies outside the extended region has no counterpart here, and carries
    // nothing there.
    int inside = 0;
    for (const haddad::Point& point : printed) {
      const bool in_region = point.phase >= 0.0 && point.phase <= reference::haddad_18_54::region_length;
      if (in_region) ++inside;
      if (!in_region) CHECK(point.load == 0.0);
    }
    CHECK(common == inside);
    CHECK(common == static_cast<int>(at.points.size()));
  };
  check(model.positions[0], haddad::null_a);
  check(model.positions[1], haddad::null_b);
}

TEST_CASE("The radii of curvature are Haddad's", "[core][load][haddad]") {
  constexpr double kModel = 1e-3;
  const MeshModel model = haddad_model();
  const double cos_base = std::cos(model.pair.base_helix_angle);
  for (const MeshPosition& at : model.positions) {
    for (const ContactPoint& point : at.points) {
      if (!on_path(point.phase)) continue;
      const double rho_1 = 16.3988 + (point.phase - 0.35) * 33.4425, rho_2 = 161.061 - rho_1;  // thesis, section 2.3
      CHECK(point.relative_radius == Approx(rho_1 * rho_2 / (rho_1 + rho_2) / cos_base).epsilon(kModel));
    }
  }
}

TEST_CASE("Deviations of the flanks are Haddad's errors, metal added positive", "[core][load][haddad]") {
  constexpr double kModel = 1e-3;
  const MeshModel model = haddad_model();
  FlankCondition slope, crowning, profile;
  slope.error.pinion.helix_slope = 8 * units::um;  // printed as -8: his slope adds metal towards the other end
  crowning.modification.pinion.lead_crowning = 8 * units::um;
  profile.modification.pinion.addendum_crowning = profile.modification.wheel.addendum_crowning = 8 * units::um;
  const auto check = [&](const FlankCondition& condition, double haddad::Errors::*column) {
    const MeshPosition& at = model.positions[0];
    const Gap gap = plane_of_action_gap(model.pair, at.points, condition);
    const int common = for_common_points(at, haddad::null_a, [&](std::size_t row, const haddad::Point&, Eigen::Index i) {
      const ContactPoint& point = at.points[static_cast<std::size_t>(i)];
      const double undisturbed = point.clearance - contact_cases::undisturbed_gap(model.pair, point, condition);
      CHECK(undisturbed / units::um == Approx(haddad::errors[row].*column).epsilon(kModel).margin(haddad::last_digit));
      // Flanks touch where less is removed, by slope^2/(2 kappa): 8 um over 10 mm on radii below 40 mm.
      CHECK(gap.error[i] >= undisturbed - 1e-9 * units::um);
      CHECK(gap.error[i] <= undisturbed + 0.05 * units::um);
    });
    CHECK(common >= 20);
  };
  SECTION("helix slope") { check(slope, &haddad::Errors::helix_slope); }
  SECTION("lead crowning") { check(crowning, &haddad::Errors::lead_crowning); }
  SECTION("profile crowning") { check(profile, &haddad::Errors::addendum_crowning); }
}

TEST_CASE("Haddad's loads give Haddad's stresses and contact deflections", "[core][load][haddad]") {
  constexpr double kModel = 1e-3;
  // The contact law here is exact where the thesis' logarithm is its limit for deep points: the difference is below its
  // digits. Close to a tip the factor M rests on his blend; those points are left to the stress.
  const MeshModel model = haddad_model(MeshEffects::all_but({"tip_corner", "free_ends"}));
  const auto check = [&](const MeshPosition& at, const auto& printed) {
    int loaded = 0, deflected = 0;
    for_common_points(at, printed, [&](std::size_t, const haddad::Point& row, Eigen::Index i) {
      if (row.load == 0.0 || !on_path(row.phase)) return;
      const ContactPoint& point = at.points[static_cast<std::size_t>(i)];
      const HertzLine hertz = hertz_line(row.load, point.relative_radius, model.contact_modulus);
      ++loaded;
      CHECK(hertz.peak_pressure == Approx(row.stress).epsilon(kModel));
      if (std::min(point.pinion_tip_distance, point.wheel_tip_distance) < 5.0 * hertz.half_width) return;
      ++deflected;
      CHECK(at.laws[static_cast<std::size_t>(i)].deflection(row.load) / units::um ==
            Approx(row.contact_deflection).epsilon(kModel).margin(2 * haddad::last_digit));
    });
    CHECK(loaded >= 12);
    CHECK(deflected >= 10);
  };
  check(model.positions[0], haddad::null_a);
  check(model.positions[1], haddad::null_b);
}

TEST_CASE("The torque of Haddad's pair is his normal force", "[core][load][haddad]") {
  CHECK(haddad_model().normal_force(haddad::torque) == Approx(haddad::normal_force).epsilon(1e-5));  // model: his rounded angles
  for (const auto* printed : {&haddad::null_a}) {
    double sum = 0.0;
    for (const haddad::Point& point : *printed) sum += 12.0 * point.load;
    CHECK(sum == Approx(haddad::normal_force).epsilon(5e-4));  // model: stop criterion of the thesis' own iteration
  }
}

TEST_CASE("Thin slices make Haddad's pair stiffer than finite elements that hold the gear bodies", "[core][load][haddad]") {
  // Model: slices know the teeth and their foundation at ISO's stiffness (measured: 0.64 of his transmission error);
  // his influence functions also hold the torsion of both gear bodies.
  const LoadedCycle cycle = analyse_cycle(haddad_model(), {}, haddad::torque);
  REQUIRE(cycle.usable());
  const double ratio = cycle.positions[0].load.transmission_error / units::um / haddad::transmission_error_a;
  CHECK(ratio > 0.5);
  CHECK(ratio < 1.0);
}
