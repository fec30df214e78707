#include "core/flank/removal.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/core/flank/sample_flank_frame.hpp"

using namespace flankwright;

namespace {

const FlankFrame frame = sample_flank_frame();
constexpr double active_height = 7.0;  // r_a - r_Nf

constexpr double kRemovalRoundOff = 1e-15;  // mm: amounts are of the order of 0.01 mm

Modification alone(ModificationParameter parameter, double amount) {
  Modification m;
  m.tip_relief.height = 1.6;
  m.root_relief.height = 1.2;
  m.end_relief.length = 5.0;
  set(m, parameter, amount);
  return m;
}

/// Everything at once, reliefs overlapping with crowning.
Modification everything(ReliefShape shape) {
  Modification m;
  m.lead_crowning = 0.008;
  m.lead_slope = -0.005;
  m.addendum_crowning = 0.006;
  m.dedendum_crowning = 0.004;
  m.profile_slope = 0.003;
  m.tip_relief = {0.020, 1.6, shape};
  m.root_relief = {0.015, 1.2, shape};
  m.end_relief = {0.010, 5.0};
  m.twist = 0.007;
  return m;
}

bool near(double found, double expected, double margin = kRemovalRoundOff) {
  INFO("found " << found << ", expected " << expected);
  return std::abs(found - expected) <= margin;
}

}  // namespace

TEST_CASE("Each amount is what is removed where it is specified", "[core][flank][closed-form]") {
  const double c = 0.01, tip = frame.tip_radius, low = frame.active_root_radius, pitch = frame.pitch_radius, end = 15.0;
  const auto removed = [&](ModificationParameter p, double r, double z) { return removal(alone(p, c), frame, r, z); };
  for (const double r : {low, pitch, tip}) {
    CHECK(near(removed(parameter_of("lead_crowning"), r, end), c));
    CHECK(near(removed(parameter_of("lead_crowning"), r, -end), c));
    CHECK(near(removed(parameter_of("lead_crowning"), r, 0.5 * end), 0.25 * c));
    CHECK(near(removed(parameter_of("lead_slope"), r, end) - removed(parameter_of("lead_slope"), r, -end), c));
    CHECK(removed(parameter_of("lead_slope"), r, end) > 0.0);
    CHECK(removed(parameter_of("lead_slope"), r, 0.0) == 0.0);
    CHECK(near(removed(parameter_of("end_relief.amount"), r, -end), c));
    CHECK(near(removed(parameter_of("end_relief.amount"), r, 12.5), 0.5 * c));
    CHECK(removed(parameter_of("end_relief.amount"), r, 10.0) == 0.0);
  }
  for (const double z : {-end, 0.0, 3.0}) {
    CHECK(near(removed(parameter_of("addendum_crowning"), tip, z), c));
    CHECK(near(removed(parameter_of("addendum_crowning"), 52.0, z), 0.25 * c));
    CHECK(removed(parameter_of("addendum_crowning"), low, z) == 0.0);
    CHECK(near(removed(parameter_of("dedendum_crowning"), low, z), c));
    CHECK(removed(parameter_of("dedendum_crowning"), tip, z) == 0.0);
    CHECK(near(removed(parameter_of("profile_crowning"), tip, z), c));
    CHECK(near(removed(parameter_of("profile_crowning"), low, z), c));
    CHECK(near(removed(parameter_of("profile_slope"), tip, z) - removed(parameter_of("profile_slope"), low, z), c));
    CHECK(near(removed(parameter_of("tip_relief.amount"), tip, z), c));
    CHECK(near(removed(parameter_of("tip_relief.amount"), tip - 0.8, z), 0.5 * c));
    CHECK(removed(parameter_of("tip_relief.amount"), tip - 1.6, z) == 0.0);
    CHECK(near(removed(parameter_of("root_relief.amount"), low, z), c));
    CHECK(near(removed(parameter_of("root_relief.amount"), low + 0.3, z), 0.75 * c));
    CHECK(removed(parameter_of("root_relief.amount"), low + 1.2, z) == 0.0);
    CHECK(removed(parameter_of("twist"), pitch, z) == 0.0);
    for (const ModificationParameter p :
         {parameter_of("profile_crowning"), parameter_of("profile_slope"), parameter_of("tip_relief.amount"), parameter_of("root_relief.amount")}) {
      CHECK(removed(p, pitch, z) == 0.0);
    }
  }
  // Twist: the difference of the profile slopes at the two ends.
  const double at_end = removed(parameter_of("twist"), tip, end) - removed(parameter_of("twist"), low, end);
  const double at_start = removed(parameter_of("twist"), tip, -end) - removed(parameter_of("twist"), low, -end);
  CHECK(near(at_end - at_start, c));
  CHECK(removed(parameter_of("twist"), tip, end) > 0.0);
}

TEST_CASE("A part of the profile that touches nothing is not crowned", "[core][flank]") {
  // All contact beyond the pitch point: the active flank begins above the pitch circle. Its depth below would else be squared, whatever its sign.
  FlankFrame recess = frame;
  recess.active_root_radius = frame.pitch_radius + 0.1;
  const Modification m = alone(parameter_of("profile_crowning"), 0.15);
  CHECK(removal(m, recess, 47.0, 0.0) == 0.0);
  CHECK(removal(m, recess, 54.0, 0.0) == Approx(0.15).epsilon(1e-14));
  FlankFrame approach = frame;
  approach.tip_radius = frame.pitch_radius - 0.1;
  CHECK(removal(m, approach, 49.95, 0.0) == Approx(0.15 * 0.05 * 0.05 / 9.0).epsilon(1e-12));
  CHECK(removal(m, approach, 50.5, 0.0) == 0.0);
}

TEST_CASE("A parabolic relief starts without a kink, a linear one with its full slope", "[core][flank]") {
  Modification m = alone(parameter_of("tip_relief.amount"), 0.02);
  const double start = frame.tip_radius - 1.6, step = 1e-4;
  CHECK(near(removal(m, frame, start + step, 0.0), 0.02 * step / 1.6, 1e-13));
  m.tip_relief.shape = ReliefShape::Parabolic;
  CHECK(near(removal(m, frame, start + step, 0.0), 0.02 * std::pow(step / 1.6, 2), 1e-13));
  CHECK(near(removal(m, frame, frame.tip_radius, 0.0), 0.02));
}

TEST_CASE("Modifications add up and scale with their amounts", "[core][flank]") {
  const ReliefShape shape = GENERATE(ReliefShape::Linear, ReliefShape::Parabolic);
  const Modification all = everything(shape);
  for (double r = 46.5; r < 54.2; r += 0.33) {
    for (double z = -15.5; z < 16.0; z += 1.7) {
      double sum = 0.0;
      for (const ModificationDescriptor& p : modification_parameters) {
        if (!p.half.empty() || p.kind == ParameterKind::Extent) continue;
        Modification one = alone(p.parameter, get(all, p.parameter));
        one.tip_relief.shape = one.root_relief.shape = shape;
        sum += removal(one, frame, r, z);
      }
      CAPTURE(r, z);
      CHECK(near(removal(all, frame, r, z), sum, 2e-16 * 50));
    }
  }
}

TEST_CASE("The removal is continuous over the flank and beyond its ends", "[core][flank]") {
  const Modification m = everything(ReliefShape::Linear);
  // Lipschitz bounds: largest slope of each part added up, radially and axially.
  const double step = 1e-7;
  const double radial = 0.02 / 1.6 + 0.015 / 1.2 + 4 * 0.006 / 3.0 + 4 * 0.004 / 3.0 + 0.012 / active_height;
  const double axial = 0.010 / 5.0 + 6 * 0.008 / 15.0 + 0.005 / 30.0 + 0.007 / 30.0;
  for (const double r : {47.0, 48.2, 50.0, 52.4, 54.0, 51.3}) {
    for (const double z : {-15.0, -10.0, 0.0, 10.0, 15.0}) {
      CAPTURE(r, z);
      CHECK(near(removal(m, frame, r + step, z), removal(m, frame, r - step, z), 2 * step * radial));
      CHECK(near(removal(m, frame, r, z + step), removal(m, frame, r, z - step), 2 * step * axial));
    }
  }
}

TEST_CASE("The derivative for every parameter agrees with central differences away from kinks", "[core][flank]") {
  const ReliefShape shape = GENERATE(ReliefShape::Linear, ReliefShape::Parabolic);
  const Modification m = everything(shape);
  constexpr double kStep = 1e-5;            // mm
  constexpr double kDiscretisation = 2e-9;  // third derivative of the extents' t^2 times step^2, and round-off/step
  for (const ModificationDescriptor& p : modification_parameters) {
    for (const double r : {46.9, 47.5, 48.9, 51.1, 52.7, 53.9}) {
      for (const double z : {-14.0, -3.0, 6.0, 13.3}) {
        Modification base = m, up = m, down = m;
        // One value for both halves, as profile_crowning is defined.
        if (p.parameter == parameter_of("profile_crowning")) base.dedendum_crowning = base.addendum_crowning;
        const double value = get(base, p.parameter);
        set(up, p.parameter, value + kStep);
        set(down, p.parameter, value - kStep);
        const double difference = (removal(up, frame, r, z) - removal(down, frame, r, z)) / (2 * kStep);
        CAPTURE(std::string(p.key), r, z);
        CHECK(near(removal_derivative(base, frame, p.parameter, r, z), difference, kDiscretisation));
      }
    }
  }
}

TEST_CASE("Dual numbers carry the exact slope of the flank's removal", "[core][flank]") {
  const ReliefShape shape = GENERATE(ReliefShape::Linear, ReliefShape::Parabolic);
  const Modification m = everything(shape);
  ToothError error;
  error.helix_slope = 0.004;
  error.profile_slope = -0.006;
  error.twist = 0.002;
  constexpr double kStep = 1e-4, kDiscretisation = 1e-11;  // all parts at most quadratic: only round-off/step is left
  for (const double r : {47.5, 48.9, 51.1, 53.9}) {
    for (const double z : {-14.0, -3.0, 6.0, 13.3}) {
      const auto net = [&](auto at_r, auto at_z) { return removal(m, frame, at_r, at_z) - added_metal(error, frame, at_r, at_z); };
      const Dual<2> found = net(Dual<2>::variable(r, 0), Dual<2>::variable(z, 1));
      CAPTURE(r, z);
      CHECK(near(found.value, net(r, z)));
      CHECK(near(found.gradient[0], (net(r + kStep, z) - net(r - kStep, z)) / (2 * kStep), kDiscretisation));
      CHECK(near(found.gradient[1], (net(r, z + kStep) - net(r, z - kStep)) / (2 * kStep), kDiscretisation));
    }
  }
}

TEST_CASE("Manufacturing errors add metal as Haddad's equation 6.1 has it", "[core][flank][reference]") {
  ToothError error;
  error.helix_slope = 0.008;
  CHECK(near(added_metal(error, frame, 51.0, 15.0), 0.004));
  CHECK(near(added_metal(error, frame, 51.0, -15.0), -0.004));
  error = {};
  error.profile_slope = 0.008;
  CHECK(added_metal(error, frame, frame.reference_radius, 7.0) == 0.0);
  CHECK(near(added_metal(error, frame, 54.0, 0.0) - added_metal(error, frame, 47.0, 0.0), 0.008));
  error = {};
  error.twist = 0.008;
  CHECK(near(added_metal(error, frame, 49.5 + active_height, 15.0), 0.004));
}

TEST_CASE("Pitch deviations accumulate tooth by tooth or follow their list round the gear", "[core][flank]") {
  ManufacturingError error;
  error.pitch_step = 0.003;
  for (const int tooth : {-4, 0, 1, 17}) CHECK(near(pitch_deviation(error, tooth), 0.003 * tooth));
  error.cumulative_pitch = {0.0, 0.002, -0.001, 0.005};
  for (int tooth = -9; tooth < 10; ++tooth) {
    CHECK(pitch_deviation(error, tooth) == pitch_deviation(error, tooth + 4));
    CHECK(pitch_deviation(error, tooth) == error.cumulative_pitch[static_cast<std::size_t>((tooth + 12) % 4)]);
  }
}
