#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/contact/gap/surface_gap.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/contact/contact_cases.hpp"

using namespace flankwright;
using units::um;

/// The spur pair of the paper on transmission error without the plane-of-action assumption (ETE, contact sought over the whole
/// flanks, against LDP, contact on the line of action): 27/43 teeth, m = 2 mm, parabolic relief by roll motion from the
/// pitch point to both tips.
namespace {

/// Parabola over the roll length from the pitch point to the tip, as the paper has it (the modification's own is over the radius).
class RollParabola final : public DeviationField {
 public:
  RollParabola(double start, double end, double amount) : start_(start), factor_(amount / ((end - start) * (end - start))) {}

  Jet at(double rho, double) const override {
    const double beyond = std::max(0.0, rho - start_);
    return {factor_ * beyond * beyond, 2.0 * factor_ * beyond, 0.0, beyond > 0.0 ? 2.0 * factor_ : 0.0, 0.0, 0.0};
  }

 private:
  double start_, factor_;
};

GearPair spur_pair() {
  PairData data;
  data.normal_module = 2.0;
  data.pinion.teeth = 27;
  data.wheel.teeth = 43;
  data.pinion.tip_diameter = 58.0;
  data.wheel.tip_diameter = 90.0;
  for (GearData* gear : {&data.pinion, &data.wheel}) {
    gear->face_width = 15.0;
    gear->rack.dedendum = 1.5;  // root diameters 48 and 80 mm
    gear->rack.root_radius = 0.25;
  }
  return make_gear_pair(data);
}

struct BothGaps {
  double plane, surface, by_parabola;  ///< where undisturbed flanks would touch, over the whole flanks, by both flanks' parabola [mm]
  double pinion_radius;                ///< found less that on the line of action [mm]
};

class ReliefStudy {
 public:
  explicit ReliefStudy(double amount) {
    for (Member m : {Member::Pinion, Member::Wheel}) {
      const Gear& gear = pair_[m];
      Modification& to = condition_.modification[m];
      to.topography = std::make_shared<RollParabola>(gear.roll_length_at(gear.working_pitch_radius), gear.roll_length_at(gear.tip_radius), amount);
    }
  }

  /// Of tooth pair 0 when it is `phase` base pitches beyond the theoretical start of contact A.
  BothGaps at(double phase) const {
    const double line_phase = phase + PathOfContact::extension;
    const PathOfContact path(pair_);
    for (const ContactPoint& point : contact_points(pair_, path, {QuadratureRule::Midpoint, 1}, line_phase, true, -7.5, 7.5)) {
      if (point.tooth != 0) continue;
      const Gap surface = SurfaceGap(pair_, condition_).at({point}, line_phase);
      return {contact_cases::undisturbed_gap(pair_, point, condition_), surface.total[0], plane_of_action_gap(pair_, {point}, condition_).total[0],
              surface.nearest[0].pinion_radius - point.pinion_radius};
    }
    return {not_given, not_given, not_given, not_given};
  }

  /// Where the gap of the plane of action of a pair that enters has come down to a value.
  double entering_phase(double gap) const {
    double before = 0.1, after = 0.8;  // from A towards the pitch point
    while (after - before > 1e-9) {
      const double middle = 0.5 * (before + after);
      (at(middle).plane > gap ? before : after) = middle;
    }
    return after;
  }

  double contact_ratio() const { return pair_.transverse_contact_ratio; }

 private:
  GearPair pair_{spur_pair()};
  FlankCondition condition_;
};

}  // namespace

TEST_CASE("ETE paper case 1: contact off the line of action changes the unloaded transmission error by 8.2 % at position 8", "[reference][contact]") {
  // Section 3.1: at position 8 the two programs differ most, by 1.221 um or 8.2 % of LDP's value, which was 14.9 um
  // then. The phases of the ten positions are not stated: position 8 is found by that value, on the pair that has entered and leads
  // (the pair about to leave passes the same value with 10.9 %).
  const ReliefStudy study(50 * um);
  const double phase = study.entering_phase(1.221 * um / 0.082);
  const BothGaps entering = study.at(phase), leaving = study.at(phase + 1.0);
  CAPTURE(phase, entering.plane / um, entering.surface / um, leaving.plane / um);
  CHECK(entering.plane < leaving.plane);
  const double difference = entering.plane - entering.surface;
  constexpr double kPrinted = 0.006;  // of 8.2 %, that is 8.15 .. 8.25
  constexpr double kModel = 0.01;     // programs of discrete points on the flanks, ETE 500 over the height
  CHECK(difference == Approx(1.221 * um).epsilon(kPrinted + kModel));
  CHECK(difference / entering.plane == Approx(0.082).epsilon(kPrinted + kModel));
  // Both flanks' parabola finds most of it.
  CHECK(std::abs(entering.by_parabola - entering.surface) <= 0.01 * entering.surface);
  // Figure 4: the actual point lies off the line of action; it is nearer to the pitch point, where less is removed.
  CHECK(entering.pinion_radius > 0.05);
}

TEST_CASE("ETE paper case 2: the initial gaps of the second pair deviate more than those of the first", "[reference][contact]") {
  // Section 3.2, figure 6 (10 um at the tips, no figures printed): around the transfer point the pair that leads agrees well, the one
  // that is about to touch deviates more, and far less than with 50 um of relief.
  const ReliefStudy study(10 * um), strong(50 * um);
  const double phase = study.entering_phase(3.0 * um);
  for (const double beyond : {0.0, 0.05, 0.1}) {
    const BothGaps first = study.at(phase + beyond), second = study.at(phase + beyond + 1.0);
    CAPTURE(phase, beyond, first.plane / um, first.surface / um, second.plane / um, second.surface / um);
    REQUIRE(phase + beyond + 1.0 < study.contact_ratio() + 0.3);
    CHECK(first.plane < second.plane);
    CHECK(second.plane - second.surface > 1.5 * (first.plane - first.surface));
    CHECK(first.plane - first.surface < 0.05 * first.plane);
    const BothGaps stronger = strong.at(phase + beyond);
    // What contact gains by leaving the line is slope^2/(2 kappa): of second order in the amount.
    CHECK((stronger.plane - stronger.surface) / (first.plane - first.surface) == Approx(25.0).epsilon(0.15));
  }
}
