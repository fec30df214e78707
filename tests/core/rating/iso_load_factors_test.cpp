#include "core/rating/iso_load_factors.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/load/cycle/mesh_motion.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

const GearPair& haddad() {
  static const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  return gears;
}

IsoLoadFactors factors_for(const IsoDeviations& deviations, double torque = 1014.868e3) {
  return iso_load_factors(haddad(), iso_stiffness(haddad(), {}, {}), deviations, torque, 120);
}

}  // namespace

TEST_CASE("ISO's misalignment is the linear part of the gap along the face", "[core][load][iso]") {
  constexpr double kRoundOff = 1e-12;
  const GearPair& gears = haddad();
  FlankCondition c;
  CHECK(iso_deviations(gears, c).misalignment == tests::about(0, 1e-15));
  c.misalignment.mesh_misalignment = -7 * units::um;
  CHECK(iso_deviations(gears, c).misalignment == Approx(7 * units::um).epsilon(kRoundOff));
  // Crowning, reliefs and profiles are not linear along the face.
  c.modification.pinion.lead_crowning = 20 * units::um;
  c.modification.wheel.end_relief = {10 * units::um, 20};
  c.error.pinion.profile_slope = 9 * units::um;
  CHECK(iso_deviations(gears, c).misalignment == Approx(7 * units::um).epsilon(kRoundOff));
  // A lead slope that removes where the misalignment closes takes it back, an error that adds there takes it on.
  c.modification.pinion.lead_slope = -7 * units::um;  // removes at -z, where the mesh is closed
  c.misalignment.mesh_misalignment = 7 * units::um;   // opens at +z
  CHECK(iso_deviations(gears, c).misalignment == tests::about(0, 1e-15));
  c.error.wheel.helix_slope = -3 * units::um;
  CHECK(iso_deviations(gears, c).misalignment == Approx(3 * units::um).epsilon(kRoundOff));
  // Teeth that differ: the worst of them.
  c.error.pinion.helix_slopes = {0, -2 * units::um, 2 * units::um};
  CHECK(iso_deviations(gears, c).misalignment == Approx(5 * units::um).epsilon(kRoundOff));
  // A wheel that stands aside leaves less face in common, and as much less of a slope that is over the whole face.
  FlankCondition aside;
  aside.misalignment.mesh_misalignment = 12 * units::um;
  for (const double offset : {30.0, -60.0}) {
    aside.misalignment.axial_offset = offset;
    CHECK(iso_deviations(gears, aside).misalignment == Approx(12 * units::um * (120.0 - std::abs(offset)) / 120.0).epsilon(kRoundOff));
  }
  // Crossing axes: an angle in the plane of action, by cos(alpha_wt), over the face.
  FlankCondition crossed;
  crossed.misalignment.crossing = 1 * units::arcmin;
  // Model: displacements along the axis, tan(beta_b) times as large as the tilt allows, do not change along it.
  CHECK(iso_deviations(gears, crossed).misalignment == Approx(units::arcmin * 120 * std::cos(gears.working_transverse_pressure_angle)).epsilon(1e-6));
}

TEST_CASE("ISO's pitch deviation is the largest single step or profile deviation", "[core][load][iso]") {
  constexpr double kRoundOff = 1e-12;
  const GearPair& gears = haddad();
  FlankCondition c;
  c.error.pinion.pitch_step = -4 * units::um;
  CHECK(iso_deviations(gears, c).base_pitch == Approx(4 * units::um).epsilon(kRoundOff));
  c.error.wheel.cumulative_pitch = {0, 3 * units::um, 9 * units::um, 1 * units::um};  // steps 3, 6, -8, and -1 back to the first
  CHECK(iso_deviations(gears, c).base_pitch == Approx(8 * units::um).epsilon(kRoundOff));
  // A profile slope over the active profile of the pinion; both gears' active profiles are those of A to E.
  c.error.pinion.profile_slope = 12 * units::um;
  CHECK(iso_deviations(gears, c).base_pitch == Approx(12 * units::um).epsilon(kRoundOff));
  c.error.pinion.profile_slopes = {0, 3 * units::um};
  CHECK(iso_deviations(gears, c).base_pitch == Approx(15 * units::um).epsilon(kRoundOff));
  c.error.pinion.profile_slopes.clear();
  // Modifications are meant, not deviations.
  c.modification.pinion.tip_relief = {40 * units::um, 5, ReliefShape::Linear};
  CHECK(iso_deviations(gears, c).base_pitch == Approx(12 * units::um).epsilon(kRoundOff));
}

TEST_CASE("ISO's factors are 1 without deviations and join where their branches meet", "[core][load][iso]") {
  constexpr double kRoundOff = 1e-12;
  const IsoLoadFactors none = factors_for({0, 0});
  CHECK(none.lead == 1);
  CHECK(none.profile == 1);
  CHECK(none.specific_load == Approx(1014.868e3 / haddad().pinion.reference_radius / 120).epsilon(kRoundOff));
  // q = 2: the load reaches just over the face width, the load at one end is twice the mean.
  const double c = iso_stiffness(haddad(), {}, {}).c_gamma / units::um;
  const double meeting = 2 * none.specific_load / c;
  CHECK(factors_for({meeting, 0}).lead == Approx(2).epsilon(kRoundOff));
  CHECK(factors_for({meeting * (1 + 1e-9), 0}).lead == Approx(2).epsilon(1e-8));
  CHECK(factors_for({meeting / 2, 0}).lead == Approx(1.5).epsilon(kRoundOff));
  CHECK(factors_for({meeting * 8, 0}).lead == Approx(std::sqrt(32.0)).epsilon(kRoundOff));
}

TEST_CASE("ISO's K_Halpha ends at the thesis' limit and falls with K_Hbeta", "[core][load][iso]") {
  // Haddad, section 4.3.2: the limit is 3.26 for this pair.
  const IsoLoadFactors large = factors_for({0, 200 * units::um});
  CHECK(large.profile == large.profile_limit);
  CHECK(large.profile_limit == tests::about(3.26, 0.005));
  CHECK(large.running_in == 3 * units::um);
  // F_tH grows with K_Hbeta, so that the factors are not independent (section 1.2.2).
  const IsoLoadFactors pitch = factors_for({0, 15 * units::um}), both = factors_for({10 * units::um, 15 * units::um});
  CHECK(pitch.profile > 1.5);
  CHECK(both.profile < pitch.profile);
  CHECK(both.combined() < both.lead * pitch.profile);
  // Twice the load halves what a deviation adds.
  const double heavy = factors_for({0, 15 * units::um}, 2 * 1014.868e3).profile;
  CHECK(heavy - 0.9 == Approx((pitch.profile - 0.9) / 2).epsilon(1e-12));
}

TEST_CASE("ISO's K_Halpha of a spur pair uses the load sharing of less than two pairs", "[core][load][iso]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  REQUIRE(gears.total_contact_ratio() < 2);
  const IsoStiffness stiffness = iso_stiffness(gears, {}, {});
  const double torque = mesh_cases::torque_for(gears, 200);
  const IsoLoadFactors factors = iso_load_factors(gears, stiffness, {0, 10 * units::um}, torque, 30);
  const double f = 9.25;  // um, run in
  const double expected = gears.total_contact_ratio() / 2 * (0.9 + 0.4 * stiffness.c_gamma * f / factors.specific_load);
  CHECK(factors.profile == Approx(expected).epsilon(1e-12));
  CHECK(factors.profile_limit == Approx(3 / (4 - gears.transverse_contact_ratio)).epsilon(1e-12));  // Z_eps of a spur pair
}

TEST_CASE("To ISO a mesh that its shafts open is one that is misaligned as much", "[core][load][iso]") {
  const GearPair gears = haddad();
  FlankCondition misaligned, slope;
  misaligned.misalignment.mesh_misalignment = 12 * units::um;
  slope.modification.pinion.lead_slope = 20 * units::um;
  const double opened = iso_deviations(gears, misaligned).misalignment;
  CHECK(iso_deviations(gears, {}, 12 * units::um).misalignment == Approx(opened).epsilon(1e-12));
  CHECK(iso_deviations(gears, misaligned, -12 * units::um).misalignment == tests::about(0, 1e-15));  // round-off
  CHECK(iso_deviations(gears, misaligned, 3 * units::um).misalignment == Approx(1.25 * opened).epsilon(1e-12));
  // The slope removes metal at +z, as what opens the mesh there does.
  const double by_slope = iso_deviations(gears, slope).misalignment;
  CHECK(iso_deviations(gears, slope, 5 * units::um).misalignment == Approx(by_slope + 5 * units::um).epsilon(1e-12));
}

TEST_CASE("ISO's factors change with misalignment, modifications, offset and torque as central differences say", "[core][load][iso][gradient]") {
  // Relative; step^2 of the differences, and for the offset that of its own three meshes.
  constexpr double kDifference = 1e-6;
  const auto [misaligned, pitch] =
      GENERATE(table<double, double>({{2e-3, 8e-3}, {40e-3, 60e-3}, {6e-3, 0.3}}));  // both branches of K_Hbeta; K_Halpha free and at its limit
  const bool helical = GENERATE(false, true);
  const GearPair gears = helical ? haddad() : mesh_cases::pair(20, 40, 0, 4, 30);
  FlankCondition condition;
  condition.misalignment.mesh_misalignment = misaligned;
  condition.misalignment.axial_offset = 1.5;
  condition.error.pinion.pitch_step = pitch;
  condition.error.wheel.helix_slopes = {0, 3 * units::um, -2 * units::um};
  condition.modification.pinion.lead_slope = 1 * units::um;
  condition.modification.wheel.end_relief = {6 * units::um, 0.2 * gears.face_width};
  condition.modification.wheel.tip_relief = {6 * units::um, 2, ReliefShape::Linear};
  const double torque = mesh_cases::torque_for(gears, 200);
  const std::vector<MeshParameter> parameters{&Misalignment::mesh_misalignment,
                                              &Misalignment::crossing,
                                              GearParameter{Member::Pinion, parameter_of("lead_slope")},
                                              GearParameter{Member::Wheel, parameter_of("end_relief.amount")},
                                              GearParameter{Member::Wheel, parameter_of("tip_relief.amount")},
                                              &Misalignment::axial_offset,
                                              PinionTorque{}};
  const std::vector<double> steps{1e-5, 2e-8, 1e-5, 1e-5, 1e-5, 1e-3, 1e-4 * torque};
  const GapModel gap = misaligned < 5e-3 ? GapModel::WholeSurface : GapModel::PlaneOfAction;  // the standard asks for neither
  const MeshPlaced placed = [&](const MeshPlacement& placement) {
    return make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{}, {0.3}}, {}, placement);
  };
  const auto mesh = [&](const FlankCondition& c) { return placed(MeshPlacement::of(gap, c.misalignment)); };
  const auto factors = [&](const FlankCondition& c, double by_torque) {
    const MeshModel model = mesh(c);
    return iso_load_factors(gears, model.iso, iso_deviations(gears, c), by_torque, model.face_width);
  };
  const MeshModel model = with_perturbed_meshes(mesh(condition), placed, parameters);
  const IsoLoadFactors here = factors(condition, torque);
  const IsoGradient gradient = iso_gradient(model, condition, here, analyse_cycle(model, condition, torque, parameters), parameters);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto moved = [&](double by) {
      FlankCondition c = condition;
      if (const auto* gear = std::get_if<GearParameter>(&parameters[p])) {
        Modification& m = c.modification[gear->member];
        set(m, gear->parameter, get(m, gear->parameter) + by);
      } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&parameters[p])) {
        c.misalignment.*(*misalignment) += by;
      }
      return factors(c, std::holds_alternative<PinionTorque>(parameters[p]) ? torque + by : torque);
    };
    const IsoLoadFactors up = moved(steps[p]), down = moved(-steps[p]);
    const auto column = static_cast<Eigen::Index>(p);
    const auto check = [&](const char* name, double exact, double high, double low, double value) {
      CAPTURE(p, name, misaligned, helical);
      CHECK(std::abs(exact - (high - low) / (2 * steps[p])) <= kDifference * (std::abs(exact) + 1e-3 * value / steps[p]));
    };
    check("F_beta_y", gradient.misalignment[column], up.deviations.misalignment, down.deviations.misalignment, here.deviations.misalignment);
    check("specific load", gradient.specific_load[column], up.specific_load, down.specific_load, here.specific_load);
    check("K_Hbeta", gradient.lead[column], up.lead, down.lead, here.lead);
    check("K_Halpha", gradient.profile[column], up.profile, down.profile, here.profile);
    check("K_H", gradient.combined[column], up.combined(), down.combined(), here.combined());
  }
  CHECK(gradient.misalignment[4] == 0);  // tip relief is no lead
  // Shafts whose f_sh grows with the first parameter as the misalignment itself: all that follows from it grows twice as fast.
  ShaftMisalignment shafts{0.0, gradient.misalignment[0] * Eigen::RowVectorXd::Unit(std::ssize(parameters), 0)};
  const IsoGradient with_shafts = iso_gradient(model, condition, here, analyse_cycle(model, condition, torque, parameters), parameters, shafts);
  CHECK(with_shafts.misalignment[0] == Approx(2 * gradient.misalignment[0]).epsilon(1e-12));
  CHECK(with_shafts.lead[0] == Approx(2 * gradient.lead[0]).epsilon(1e-12));
}
