#include "core/rating/load_factors.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/flank/measured_grid.hpp"
#include "core/rating/iso_load_factors.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;
using mesh_cases::mesh_of;
using mesh_cases::torque_for;

namespace {

LoadFactors factors_of(const GearPair& gears, const FlankCondition& condition, double line_load = 100) {
  const auto located = [&](const FlankCondition& part) { return locate_peaks(mesh_of(gears), part, torque_for(gears, line_load)); };
  const ContactPeaks perfect = located(perfect_part(condition)), whole = located(condition);
  const auto peaks = [&](const FlankCondition& part) {
    return part == condition ? whole : part == perfect_part(condition) ? perfect : located(part);
  };
  return load_factors(perfect, peaks(lead_part(condition)), peaks(profile_part(condition)), whole);
}

FlankCondition lead_and_profile() {
  FlankCondition c;
  c.modification.pinion.lead_crowning = 6 * units::um;
  c.modification.wheel.lead_slope = -4 * units::um;
  c.modification.pinion.end_relief = {8 * units::um, 10};
  c.modification.wheel.tip_relief = {10 * units::um, 3, ReliefShape::Linear};
  c.modification.pinion.root_relief = {5 * units::um, 2, ReliefShape::Parabolic};
  set(c.modification.wheel, parameter_of("profile_crowning"), 4 * units::um);
  c.modification.pinion.profile_slope = 2 * units::um;
  c.error.pinion.helix_slope = 3 * units::um;
  c.error.pinion.profile_slope = -4 * units::um;
  c.error.pinion.pitch_step = 2 * units::um;
  c.error.pinion.helix_slopes = {0, 2 * units::um, -1 * units::um};
  c.error.wheel.profile_slopes = {1 * units::um, 0};
  c.error.wheel.cumulative_pitch = {1 * units::um, -2 * units::um, 0, 3 * units::um};
  c.misalignment.crossing = 10 * units::arcsec;
  c.misalignment.intersecting = -20 * units::arcsec;
  c.misalignment.mesh_misalignment = 5 * units::um;
  return c;
}

}  // namespace

TEST_CASE("A condition of leads and profiles is the sum of its parts", "[core][load][load-factors]") {
  constexpr double kRoundOff = 1e-15;  // mm
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const FlankCondition whole = lead_and_profile();
  const MeshModel model = mesh_of(gears)({0.3});
  const auto error = [&](const FlankCondition& c) { return plane_of_action_gap(gears, model.positions[0].points, c).error; };
  const Eigen::VectorXd sum = error(lead_part(whole)) + error(profile_part(whole)) - error(perfect_part(whole));
  CHECK(error(perfect_part(whole)).cwiseAbs().maxCoeff() < kRoundOff);
  // model: intersecting axes move the wheel along the profile, by 20'' over half the face, on flanks that slope by 10 um over 3 mm
  constexpr double second_order = 20 * units::arcsec * 60 * (10 * units::um / 3);
  CHECK((sum - error(whole)).cwiseAbs().maxCoeff() < second_order);
}

TEST_CASE("Every modification parameter belongs to one part", "[core][load][load-factors]") {
  for (const ModificationDescriptor& named : modification_parameters) {
    CAPTURE(named.key);
    FlankCondition condition;
    set(condition.modification.pinion, named.parameter, 1e-3);
    const bool lead = lead_part(condition) == condition, profile = profile_part(condition) == condition;
    CHECK(lead + profile + (named.flank_class == ModificationClass::Topography) == 1);
    CHECK((perfect_part(condition) == FlankCondition{}));
  }
}

TEST_CASE("A measured flank has its lead and its profile in the parts that amounts have them in", "[core][load][load-factors][grid]") {
  // Spur, so that amounts and what a machine measures are along one line; the spline goes through straight lines to round-off.
  constexpr double round_off = 1e-13;  // mm
  const GearPair gears = mesh_cases::pair(21, 43, 0, 2.5, 22);
  const Gear& pinion = gears.pinion;
  const auto measured = [&](double slope_along_face, double slope_along_profile) {
    MeasuredGrid grid;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double start = pinion.roll_length_at(pinion.active_root_radius), end = pinion.roll_length_at(pinion.tip_form_radius);
      grid.radii.push_back(std::hypot(pinion.base_radius, std::lerp(start, end, share)));
      grid.z.push_back(22.0 * (share - 0.5));
    }
    grid.deviation.resize(5, 5);
    for (Eigen::Index i = 0; i < 5; ++i) {
      const double along = pinion.roll_length_at(grid.radii[static_cast<std::size_t>(i)]) - pinion.roll_length_at(grid.radii[2]);
      for (Eigen::Index j = 0; j < 5; ++j)
        grid.deviation(i, j) = slope_along_face * grid.z[static_cast<std::size_t>(j)] + slope_along_profile * along;
    }
    return make_grid_field(grid, pinion.base_radius, gears.base_helix_angle).field;
  };
  FlankCondition by_grid, by_amount;
  by_grid.modification.pinion.topography = measured(-20 * units::um / 22.0, 8 * units::um / 5.0);
  by_amount.modification.pinion.lead_slope = 20 * units::um;
  const MeshModel model = mesh_of(gears)({0.3});
  const std::vector<ContactPoint>& points = model.positions[0].points;
  const auto error = [&](const FlankCondition& c) { return plane_of_action_gap(gears, points, c).error; };
  CHECK((error(lead_part(by_grid)) - error(by_amount)).cwiseAbs().maxCoeff() < round_off);
  CHECK(lead_part(by_grid) == lead_part(by_grid));  // peaks of a part are sought once
  FlankCondition profile;
  profile.modification.pinion.topography = measured(0.0, 8 * units::um / 5.0);
  CHECK((error(profile_part(by_grid)) - error(profile)).cwiseAbs().maxCoeff() < round_off);
  CHECK(error(lead_part(profile)).cwiseAbs().maxCoeff() < round_off);
  // Errors of single teeth alike; ISO's deviations are those of the amounts.
  FlankCondition errors;
  errors.error.pinion.topographies = {nullptr, by_grid.modification.pinion.topography};
  const IsoDeviations iso = iso_deviations(gears, errors), of_slope = iso_deviations(gears, by_amount);
  CHECK(iso.misalignment == Approx(of_slope.misalignment).epsilon(1e-9));
  CHECK(iso.misalignment == Approx(20 * units::um).epsilon(1e-9));
  CHECK(iso.base_pitch == Approx(8 * units::um / 5.0 * (gears.path_end - gears.path_start)).epsilon(1e-9));
  CHECK(iso_deviations(gears, by_grid).base_pitch == 0.0);  // a modification is no error
}

TEST_CASE("Factors of a perfect pair are 1, those of a lead deviation are all its own", "[core][load][load-factors]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const LoadFactors perfect = factors_of(gears, {});
  for (const LoadFactors::Triple& k : {perfect.without_spikes, perfect.with_spikes}) {
    CHECK(k.lead == 1);
    CHECK(k.profile == 1);
    CHECK(k.combined == 1);
  }
  FlankCondition misaligned;
  misaligned.misalignment.mesh_misalignment = 8 * units::um;
  const LoadFactors lead = factors_of(gears, misaligned);
  for (const LoadFactors::Triple& k : {lead.without_spikes, lead.with_spikes}) {
    CHECK(k.lead > 1.1);
    CHECK(k.profile == 1);
    CHECK(k.combined == k.lead);
    CHECK(k.product() == k.lead);
  }
  // The heavier the load, the less the same deviation matters.
  CHECK(factors_of(gears, misaligned, 1000).without_spikes.lead < lead.without_spikes.lead);
}

TEST_CASE("Bending slices under a misalignment have the linear load of ISO 6336's model", "[core][load][load-factors]") {
  // Without Hertzian deflection a slice of stiffness c yields w = c (f_t - g): on a spur pair with one pair of teeth in
  // contact w = F/b - c_n (opening) z/b, and stress follows its root.
  constexpr double kRoundOff = 1e-9;
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const double phase = (gears.pitch_point - gears.path_start) / gears.transverse_base_pitch + PathOfContact::extension;
  const MeshModel model =
      mesh_cases::model(gears, {{QuadratureRule::Gauss2, 8}, {phase}}, MeshEffects::all_but({"hertzian_contact", "extended_contact_region"}));
  const double torque = torque_for(gears, 300);
  FlankCondition misaligned;
  misaligned.misalignment.mesh_misalignment = 4 * units::um;
  const auto peaks = [&](const FlankCondition& c) { return peaks_at(model, model.positions[0], analyse_cycle(model, c, torque).positions[0]); };
  const LoadedPosition perfect = analyse_cycle(model, {}, torque).positions[0];
  const double mean = perfect.load.line_load[0], stiffness = mean / perfect.load.transmission_error;
  const double outermost = -model.positions[0].points.front().z;
  const double expected = 1 + stiffness * 4 * units::um * outermost / 30 / mean;
  const LoadFactors factors = load_factors(peaks({}), peaks(misaligned), peaks({}), peaks(misaligned));
  CHECK(factors.with_spikes.lead == Approx(expected).epsilon(kRoundOff));
  CHECK(factors.without_spikes.lead == Approx(expected).epsilon(kRoundOff));
  CHECK(expected > 1.05);
  // By line loads that is the largest over the mean of the load along the face, as ISO 6336-1 defines K_Hbeta.
  const Eigen::VectorXd load = analyse_cycle(model, misaligned, torque).positions[0].load.line_load, &weight = model.positions[0].weight;
  CHECK(factors.line_load.lead == Approx(load.maxCoeff() * weight.sum() / weight.dot(load)).epsilon(kRoundOff));
}

TEST_CASE("By line loads K_Hbeta is that of a single contact line of a spur pair, peak over mean", "[core][load][load-factors]") {
  // Hertzian and bending slices that do not support each other: the perfect pair's load is uniform along the face, so that its peak is the mean of any line
  // that carries all the force.
  constexpr double kSlices = 1e-6;  // round-off of the solver, relative to the mean load
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshAt mesh = [&](const std::vector<double>& phases) {
    return mesh_cases::model(gears, {{QuadratureRule::Graded, 5}, phases}, MeshEffects::all_but({"extended_contact_region", "free_ends"}));
  };
  const double mean = 200, torque = torque_for(gears, mean);
  FlankCondition misaligned;
  misaligned.misalignment.mesh_misalignment = 5 * units::um;
  const ContactPeaks perfect = locate_peaks(mesh, {}, torque), found = locate_peaks(mesh, misaligned, torque);
  CHECK(perfect.without_spikes.line_load.value == Approx(mean * gears.face_width / mesh({0.5}).face_width).epsilon(kSlices));
  const LoadFactors factors = load_factors(perfect, found, perfect, found);
  CHECK(factors.line_load.lead > 1.1);
  CHECK(factors.line_load.lead == Approx(found.without_spikes.line_load.value / perfect.without_spikes.line_load.value).epsilon(kSlices));
  CHECK(factors.line_load.profile == 1.0);
  CHECK(factors.line_load.combined == factors.line_load.lead);
}

TEST_CASE("A tip edge of the perfect pair is no part of a load factor", "[core][load][load-factors][edge]") {
  PairData data = mesh_cases::pair_data(25, 50, 0, 3, 30);
  data.pinion.tip_rounding = data.wheel.tip_rounding = 0.3;
  const GearPair gears = make_gear_pair(data);
  FlankCondition relieved;
  relieved.modification.pinion.tip_relief = relieved.modification.wheel.tip_relief = {25 * units::um, 1.0, ReliefShape::Linear};
  constexpr double line_load = 200;
  const ContactPeaks perfect = locate_peaks(mesh_of(gears), {}, torque_for(gears, line_load), {.everywhere = true});
  CHECK(perfect.everywhere.contact_stress.value > 1.5 * perfect.with_spikes.contact_stress.value);  // the edge carries
  const LoadFactors k = factors_of(gears, relieved, line_load);
  // Both peaks lie on the flanks, where one pair of teeth carries nearly all: by stress and by load the factors differ by the radii of curvature at both peaks.
  constexpr double by_radius = 0.1;
  for (const LoadFactors::Triple& triple : {k.without_spikes, k.with_spikes})
    CHECK(triple.combined == Approx(k.line_load.combined).epsilon(by_radius));
  CHECK(k.line_load.combined > 0.95);
}

TEST_CASE("Shafts belong to the lead and to the whole", "[core][load][load-factors]") {
  CHECK(shafts_deflect(lead_part));
  CHECK(shafts_deflect(whole_condition));
  CHECK_FALSE(shafts_deflect(perfect_part));
  CHECK_FALSE(shafts_deflect(profile_part));
}

TEST_CASE("A failed position leaves no factor", "[core][load][load-factors]") {
  ContactPeaks good, failed;
  good.with_spikes.contact_stress.value = good.without_spikes.contact_stress.value = 300;
  failed = good;
  failed.failures = 1;
  const LoadFactors factors = load_factors(good, failed, good, good);
  CHECK(std::isnan(factors.with_spikes.lead));
  CHECK(factors.with_spikes.combined == 1);
  CHECK(std::isnan(load_factors(failed, good, good, good).without_spikes.combined));
}
