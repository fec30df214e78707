#include "core/flank/natural_twist.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/flank/flank.hpp"
#include "core/flank/form_grinding.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/effects/instruction_count.hpp"
#include "tests/core/flank/grinding_simulation.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

constexpr std::array processes{GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding};

/// Haddad's pair 18:54.
GearPair pair_of(Hand hand, double helix_angle_deg = 30, WorkingFlank working = WorkingFlank::Right) {
  PairData data = pair_cases::pair_data(18, 54, helix_angle_deg, 10.0, 120.0);
  data.pinion_hand = hand;
  data.working_flank = working;
  return make_gear_pair(data);
}

Modification with_process(Modification m, GrindingKind kind, double compensation = 0.0) {
  m.process.kind = kind;
  m.process.twist_compensation = compensation;
  return m;
}
Modification crowned(double amount = 8 * units::um) {
  Modification m;
  m.lead_crowning = amount;
  return m;
}
Modification sloped() {
  Modification m;
  m.lead_slope = 10 * units::um;
  return m;
}
Modification relieved() {
  Modification m;
  m.end_relief = {8 * units::um, 20.0};
  return m;
}

/// Roll length at a share of the active profile.
double roll_at(const Gear& gear, double share) {
  return std::lerp(gear.roll_length_at(gear.active_root_radius), gear.roll_length_at(gear.tip_form_radius), share);
}

/// Largest difference of the flank from another one over the active profile and the face [mm].
double largest_difference(const GearPair& pair, Member m, const Modification& a, const Modification& b) {
  const Flank one = make_flank(pair, m, a, {}), other = make_flank(pair, m, b, {});
  double largest = 0.0;
  for (double share = 0.0; share <= 1.0; share += 0.125) {
    for (double z = -60.0; z <= 60.0; z += 7.5) {
      const double rho = roll_at(pair[m], share);
      largest = std::max(largest, std::abs(one.deviation(rho, z, 0) - other.deviation(rho, z, 0)));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("A flank that a fed tool leaves is the lead modification where the tool touches", "[core][flank][grinding][slow]") {
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GrindingKind kind = GENERATE(GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding);
  const GearPair pair = pair_of(hand);
  const GroundGear gear(pair, member);
  const ThreadedWheel threaded(gear, pair.data, 140.0);
  const FormWheel form(gear, GrindingProcess{}.wheel_diameter);
  const double rho_0 = roll_at(pair[member], 0.5);
  // The machine is centred where mid profile is finished at the feed position asked for, see ContactShift.
  const double centre = kind == GrindingKind::FormGrinding
                            ? FormWheelContact(pair, member, GrindingProcess{}.wheel_diameter).position(rho_0)
                            : -gear.helix_rate() * gear.base_radius() * (rho_0 - gear.gear().reference_radius * std::sin(gear.alpha_t()));
  double moved = 0.0, nothing = 0.0;
  for (const Modification& asked : {Modification{}, crowned(), sloped(), relieved()}) {
    const Flank paper = make_flank(pair, member, asked, {}), ground = make_flank(pair, member, with_process(asked, kind), {});
    const auto lead = [&](double feed) { return paper.deviation(rho_0, feed + centre, 0); };
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
      for (const double z : {-58.0, -41.0, -13.0, 0.0, 22.0, 47.0, 60.0}) {
        const double rho = roll_at(pair[member], share), expected = ground.deviation(rho, z, 0);
        const double simulated = kind == GrindingKind::FormGrinding ? form.removal(lead, rho, z) : threaded.removal(lead, rho, z);
        CAPTURE(name_of(member), to_string(kind), share, z, simulated / units::um, expected / units::um);
        // The tool takes more than at its nominal point by R f'^2/2, see ContactShift; less only by what the search leaves.
        constexpr double model = 0.1 * units::um, search = 0.001 * units::um;
        CHECK(simulated - expected >= -search);
        CHECK(simulated - expected <= model);
        moved = std::max(moved, std::abs(expected - paper.deviation(rho, z, 0)));
        if (asked == Modification{}) nothing = std::max(nothing, std::abs(simulated));
      }
    }
  }
  CHECK(nothing <= 0.001 * units::um);  // what the search leaves
  CHECK(moved > 2 * units::um);         // it is no small matter
}

TEST_CASE("A shape of the face alone is a lead modification: that of order 2 is ground as the crowning that it is",
          "[core][flank][grinding][closed-form]") {
  // c P_2(2z/b) = 3/2 c (2z/b)^2 - c/2.
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GrindingKind kind = GENERATE(from_range(processes));
  const GearPair pair = pair_of(Hand::Right);
  constexpr double c = 8 * units::um;
  Modification shape;
  set(shape, parameter_of("topography.face_2"), c);
  const Flank of_shape = make_flank(pair, member, with_process(shape, kind), {});
  const Flank of_crowning = make_flank(pair, member, with_process(crowned(1.5 * c), kind), {});
  constexpr double round_off = 1e-13;  // mm
  for (double share = 0.0; share <= 1.0; share += 0.25) {
    for (double z = -60.0; z <= 60.0; z += 15.0) {
      const double rho = roll_at(pair[member], share);
      CHECK(of_shape.deviation(rho, z, 0) == tests::about(of_crowning.deviation(rho, z, 0) - 0.5 * c, round_off));
    }
  }
  CHECK(natural_twist(pair, member, with_process(shape, kind)) ==
        Approx(natural_twist(pair, member, with_process(crowned(1.5 * c), kind))).epsilon(1e-10));
}

TEST_CASE("Crowning that is generated twists by 8 C tan(beta_b) g_alpha / b", "[core][flank][grinding][closed-form]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const WorkingFlank working = GENERATE(WorkingFlank::Right, WorkingFlank::Left);
  const GearPair pair = pair_of(hand, 30, working);
  const Modification m = with_process(crowned(), GrindingKind::GeneratingGrinding);
  const double g = roll_at(pair[member], 1.0) - roll_at(pair[member], 0.0), b = 120.0, tan_base_helix = std::tan(pair.base_helix_angle);
  // The sign is that of the helix in the flank's own frame: removed more at the tip where the line of contact reaches the tip last.
  const double sense = pair.flank_frame(member).helix_rate > 0.0 ? 1.0 : -1.0;
  constexpr double round_off = 1e-15;
  CHECK(natural_twist(pair, member, m) == tests::about(sense * 8.0 * m.lead_crowning * tan_base_helix * g / b, round_off));
  CHECK(contact_shift_over_profile(pair, member, m.process) == Approx(-sense * tan_base_helix * g).epsilon(1e-13));
  // At mid profile the lead is as drawn; at mid face the profile gets a crowning of C (2 h/b)^2.
  const auto field = make_natural_twist_field(pair, member, m);
  for (const double z : {-50.0, -7.0, 31.0}) CHECK(std::abs(field->at(roll_at(pair[member], 0.5), z).value) <= round_off);
  for (const double share : {0.0, 1.0}) {
    CHECK(field->at(roll_at(pair[member], share), 0.0).value == tests::about(m.lead_crowning * std::pow(tan_base_helix * g / b, 2), round_off));
  }
  CHECK(natural_twist(pair, member, with_process(crowned(), GrindingKind::GeneratingGrinding, 0.25)) ==
        tests::about(0.75 * natural_twist(pair, member, m), round_off));
}

TEST_CASE("A lead slope that is generated keeps the normal base pitch of the tool", "[core][flank][grinding][closed-form]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = pair_of(Hand::Right);
  const Flank flank = make_flank(pair, member, with_process(sloped(), GrindingKind::GeneratingGrinding), {});
  const Dual<2> d = flank.deviation(Dual<2>::variable(roll_at(pair[member], 0.3), 0), Dual<2>::variable(11.0, 1), 0);
  // The helicoid whose base tangents are shorter by D = p rho + a z has the base radius r_b (1 - p) and the helix rate less by a/r_b.
  const double p = d.gradient[0], a = d.gradient[1], base = flank.base_radius * (1.0 - p), rate = flank.helix_rate - a / flank.base_radius;
  const auto normal_base_pitch = [](double radius, double helix_rate) { return radius / std::hypot(1.0, radius * helix_rate); };
  const double nominal = normal_base_pitch(flank.base_radius, flank.helix_rate), second_order = 10.0 * a * a;
  CHECK(std::abs(normal_base_pitch(base, rate) / nominal - 1.0) <= second_order);
  CHECK(std::abs(normal_base_pitch(flank.base_radius, rate) / nominal - 1.0) > 100.0 * second_order);  // without the profile slope it has another
}

TEST_CASE("Form grinding twists to the other side, the more the larger the wheel", "[core][flank][grinding]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const GearPair pair = pair_of(hand);
  const double generated = natural_twist(pair, member, with_process(crowned(), GrindingKind::GeneratingGrinding));
  double last = 0.0;
  for (const double diameter : {60.0, 100.0, 200.0, 400.0}) {
    Modification m = with_process(crowned(), GrindingKind::FormGrinding);
    m.process.wheel_diameter = diameter;
    const double share = natural_twist(pair, member, m) / generated;
    CAPTURE(diameter, share, last);
    CHECK(share < last);
    last = share;
  }
}

TEST_CASE("The contact line of a form wheel is a polynomial to 1e-5 mm", "[core][flank][grinding]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const double helix_angle_deg = GENERATE(8.0, 30.0, 44.0);
  const GearPair pair = pair_of(Hand::Right, helix_angle_deg);
  GrindingProcess process;
  process.kind = GrindingKind::FormGrinding;
  process.wheel_diameter = GENERATE(80.0, 400.0);
  const FormWheelContact contact(pair, member, process.wheel_diameter);
  const auto shift = ContactShift::of(pair, member, process);
  REQUIRE(shift);
  const Gear& gear = pair[member];
  const double start = gear.roll_length_at(gear.form_radius), tip = gear.roll_length_at(gear.tip_form_radius);
  const double middle = contact.position(roll_at(gear, 0.5));
  constexpr double interpolation = 1e-5;  // on a slope of 1 um/mm this is 1e-5 um
  for (double share = 0.0; share <= 1.0; share += 0.01) {
    const double rho = std::lerp(start, tip, share);
    CHECK(std::abs(shift->at(rho) - (contact.position(rho) - middle)) <= interpolation);
  }
  // Beyond both ends it goes on straight.
  for (const double rho : {0.9 * start, 1.1 * tip}) {
    const Jet h = shift->at(Jet::variable_u(rho));
    CHECK(h.uu == 0.0);
    CHECK(h.value == Approx(shift->at(rho < start ? start : tip) + h.u * (rho - (rho < start ? start : tip))).epsilon(1e-12));
  }
}

TEST_CASE("What no process twists is the flank as drawn, to the last bit", "[core][flank][grinding]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  Modification asked = relieved();
  asked.lead_crowning = 5 * units::um;
  asked.twist = 3 * units::um;
  const GearPair helical = pair_of(Hand::Left), spur = pair_of(Hand::Right, 0.0);
  const auto unchanged = [&](const GearPair& pair, const Modification& m) {
    return make_flank(pair, member, m, {}).fields.empty() && largest_difference(pair, member, m, asked) == 0.0 &&
           natural_twist(pair, member, m) == 0.0 && contact_shift_over_profile(pair, member, m.process) == 0.0;
  };
  CHECK(unchanged(helical, with_process(asked, GrindingKind::None)));
  CHECK(unchanged(helical, with_process(asked, GrindingKind::Topological)));
  for (const GrindingKind kind : processes) {
    CAPTURE(to_string(kind));
    CHECK(unchanged(helical, with_process(asked, kind, 1.0)));
    CHECK(unchanged(spur, with_process(asked, kind)));
    CHECK_FALSE(unchanged(helical, with_process(asked, kind)));
  }
}

TEST_CASE("Grinding moves every lead modification and no other", "[core][flank][grinding]") {
  const GearPair pair = pair_of(Hand::Right);
  for (const GrindingKind kind : processes) {
    for (const ModificationDescriptor& d : modification_parameters) {
      if (d.kind != ParameterKind::Amount || !d.half.empty()) continue;
      Modification m;
      if (!d.extent.empty()) find_parameter(d.extent)->set(m, 20.0);
      d.set(m, 8 * units::um);
      const double moved = largest_difference(pair, Member::Pinion, with_process(m, kind), m);
      CAPTURE(to_string(kind), std::string(d.key), moved);
      CHECK((moved > 0.5 * units::um) == (d.flank_class == ModificationClass::Lead));
      CHECK((moved == 0.0) == (d.flank_class != ModificationClass::Lead));
    }
  }
}

TEST_CASE("A left-hand gear is twisted as the mirror image of a right-hand one", "[core][flank][grinding][symmetry]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GrindingKind kind = GENERATE(GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding);
  const GearPair right = pair_of(Hand::Right), left = pair_of(Hand::Left), coast = pair_of(Hand::Right, 30, WorkingFlank::Left);
  Modification m = relieved(), mirrored = relieved();
  m.lead_crowning = mirrored.lead_crowning = 5 * units::um;
  m.lead_slope = 4 * units::um;
  mirrored.lead_slope = -4 * units::um;  // along z
  const Flank one = make_flank(right, member, with_process(m, kind), {});
  constexpr double round_off = 1e-16;
  for (const GearPair& other : {left, coast}) {
    const Flank image = make_flank(other, member, with_process(mirrored, kind), {});
    for (double share = 0.0; share <= 1.0; share += 0.25) {
      for (double z = -60.0; z <= 60.0; z += 10.0) {
        const double rho = roll_at(right[member], share);
        CHECK(std::abs(one.deviation(rho, z, 0) - image.deviation(rho, -z, 0)) <= round_off);
      }
    }
  }
}

TEST_CASE("The derivatives of a ground flank are its differences", "[core][flank][grinding]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GrindingKind kind = GENERATE(GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding);
  const GearPair pair = pair_of(Hand::Left);
  Modification m = with_process(relieved(), kind, 0.2);
  m.lead_crowning = 7 * units::um;
  m.lead_slope = -4 * units::um;
  m.tip_relief = {12 * units::um, 4.0};
  m.twist = 3 * units::um;
  const auto field = make_natural_twist_field(pair, member, m);
  for (const double share : {0.05, 0.4, 0.9}) {
    for (const double z : {-53.0, -20.0, 3.0, 52.0}) {
      const double rho = roll_at(pair[member], share), h = 1e-3, r = std::hypot(pair[member].base_radius, rho);
      const Jet d = field->at(rho, z), up = field->at(rho + h, z), down = field->at(rho - h, z), fore = field->at(rho, z + h),
                back = field->at(rho, z - h);
      const double scale = 1e-6 * 1e-3;  // of 1 um/mm: the differences' third derivatives and round-off
      CHECK(std::abs(d.u - (up.value - down.value) / (2 * h)) <= scale);
      CHECK(std::abs(d.v - (fore.value - back.value) / (2 * h)) <= scale);
      CHECK(std::abs(d.uu - (up.u - down.u) / (2 * h)) <= scale);
      CHECK(std::abs(d.uv - (fore.u - back.u) / (2 * h)) <= scale);
      CHECK(std::abs(d.vv - (fore.v - back.v) / (2 * h)) <= scale);
      for (const ModificationDescriptor& p : modification_parameters) {
        if (p.kind == ParameterKind::TeParabola) continue;  // of the gap, see gap_derivative()
        const double step = p.kind == ParameterKind::Extent ? 1e-4 : 1e-3;
        Modification more = m, less = m;
        p.set(more, p.get(m) + step);
        p.set(less, p.get(m) - step);
        const double difference =
            (make_flank(pair, member, more, {}).deviation(rho, z, 0) - make_flank(pair, member, less, {}).deviation(rho, z, 0)) / (2 * step);
        const double exact = ground_derivative(pair, member, m, p.parameter).at(r, z);
        CAPTURE(std::string(p.key), share, z, exact, difference);
        const bool is_half = !p.half.empty();  // both halves by different amounts are not one number
        if (!is_half || m.addendum_crowning == m.dedendum_crowning) CHECK(std::abs(exact - difference) <= 1e-6 * std::max(std::abs(exact), 1e-3));
      }
    }
  }
}

TEST_CASE("A form wheel that does not fit is refused by its key", "[core][flank][grinding]") {
  const GearPair pair = pair_of(Hand::Right, 45);
  Modification m = with_process(crowned(), GrindingKind::FormGrinding);
  m.process.wheel_diameter = -150.0;  // inside the gear: nothing that a study can say
  try {
    make_flank(pair, Member::Pinion, m, {});
    FAIL("accepted");
  } catch (const InvalidInput& problem) {
    CHECK(problem.field() == "grinding_wheel_diameter");
  }
}

// By core/effects/instruction_count_test.sh: [.] keeps it from running where nothing counts.
TEST_CASE("A process that twists nothing costs no instruction of a flank and its derivative", "[.][core][flank][grinding][instructions]") {
  const GearPair pair = pair_of(Hand::Right);
  InstructionCount counter;
  REQUIRE(counter.possible());
  const auto count_of = [&](const auto& value_at) {
    double sum = 0.0;
    const auto evaluate_all = [&] {
      for (int i = 0; i < 1000; ++i) sum += value_at(0.05 * i);
    };
    evaluate_all();  // warms up
    counter.start();
    evaluate_all();
    const std::int64_t counted = counter.stop();
    REQUIRE(counted > 0);
    REQUIRE(sum > 0.0);
    return counted;
  };
  const auto of_flank = [&](const Modification& m) {
    const Flank flank = make_flank(pair, Member::Pinion, m, {});
    return count_of([&](double z) { return flank.deviation(40.0, z, 0); });
  };
  const auto of_derivative = [&](const Modification& m) {
    const GroundDerivative derivative = ground_derivative(pair, Member::Pinion, m, parameter_of("lead_crowning"));
    return count_of([&](double z) { return derivative.at(100.0, z); });
  };
  for (const Modification& as_drawn :
       {with_process(crowned(), GrindingKind::Topological), with_process(crowned(), GrindingKind::FormGrinding, 1.0)}) {
    CHECK(of_flank(as_drawn) == of_flank(crowned()));
    CHECK(of_derivative(as_drawn) == of_derivative(crowned()));
  }
  CHECK(of_flank(with_process(crowned(), GrindingKind::GeneratingGrinding)) > of_flank(crowned()));
}
