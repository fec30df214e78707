#include "core/rating/peak_gradient.hpp"

#include <catch2/catch.hpp>

#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using mesh_cases::mesh_of;
using mesh_cases::torque_for;

namespace {

constexpr double kTorque = 100;  // N/mm of mean line load
constexpr double kStep = 0.05 * units::um;
constexpr double kFineSearch = 2e-6;  // base pitches: what moves with a step must move further than the search resolves

FlankCondition crowned_and_relieved() {
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 5 * units::um;
  condition.modification.wheel.tip_relief = {8 * units::um, 3, ReliefShape::Linear};
  condition.misalignment.mesh_misalignment = 6 * units::um;
  return condition;
}

/// Parameters with a way to move each in a condition by one step.
struct Moved {
  MeshParameter parameter;
  std::function<void(FlankCondition&, double)> move;
};

std::vector<Moved> movable() {
  return {
      {GearParameter{Member::Pinion, parameter_of("lead_crowning")}, [](FlankCondition& c, double by) { c.modification.pinion.lead_crowning += by; }},
      {GearParameter{Member::Wheel, parameter_of("tip_relief.amount")},
       [](FlankCondition& c, double by) { c.modification.wheel.tip_relief.amount += by; }},
      {&Misalignment::mesh_misalignment, [](FlankCondition& c, double by) { c.misalignment.mesh_misalignment += by; }}};
}

RatedPeaks rated(const GearPair& gears, const FlankCondition& condition, ConditionPart part, const std::vector<MeshParameter>& parameters) {
  const double torque = torque_for(gears, kTorque);
  const MeshAt mesh = mesh_of(gears, {QuadratureRule::Graded, 3});
  const ContactPeaks peaks =
      locate_peaks(mesh, part(condition), torque, {.step = 1.0 / 12, .phase_tolerance = kFineSearch, .value_tolerance = 0.0, .worth = 0.995});
  return {peaks, peak_gradients_of_part(mesh, condition, part, torque, peaks, parameters)};
}

/// All parameters move at once, by a step each: what errors there are would have to cancel in every output.
void check_located(const GearPair& gears) {
  // Step^2 of the differences times curvature, and what the search resolves over the step.
  constexpr double kLocated = 2e-3;
  const FlankCondition condition = crowned_and_relieved();
  const std::vector<Moved> moved = movable();
  std::vector<MeshParameter> parameters;
  for (const Moved& m : moved) parameters.push_back(m.parameter);
  const ConditionPart parts[] = {perfect_part, lead_part, profile_part, whole_condition};
  std::vector<RatedPeaks> here;
  for (const ConditionPart part : parts) here.push_back(rated(gears, condition, part, parameters));
  const LoadFactorGradients gradients = load_factor_gradients(here[0], here[1], here[2], here[3]);
  const auto at = [&](double by) {
    FlankCondition c = condition;
    for (const Moved& m : moved) m.move(c, by);
    std::vector<RatedPeaks> list{here[0]};  // the perfect part stays
    for (std::size_t k = 1; k < here.size(); ++k) list.push_back(rated(gears, c, parts[k], {}));
    return list;
  };
  const std::vector<RatedPeaks> up = at(kStep), down = at(-kStep);
  const double scale = 0.1 * here[3].peaks.with_spikes.contact_stress.value / condition.misalignment.mesh_misalignment;
  for (const auto& pair : {std::pair{&ContactPeaks::with_spikes, &PeakGradients::with_spikes},
                           std::pair{&ContactPeaks::without_spikes, &PeakGradients::without_spikes}}) {
    for (std::size_t k = 0; k < here.size(); ++k) {
      CAPTURE(k, gears.data.helix_angle);
      const auto stress = [&](const RatedPeaks& r) { return (r.peaks.*pair.first).contact_stress.value; };
      const double difference = (stress(up[k]) - stress(down[k])) / (2 * kStep);
      CHECK(std::abs((here[k].gradients.*pair.second).contact_stress.sum() - difference) <= kLocated * (std::abs(difference) + scale));
    }
  }
  const LoadFactors high = load_factors(up[0].peaks, up[1].peaks, up[2].peaks, up[3].peaks);
  const LoadFactors low = load_factors(down[0].peaks, down[1].peaks, down[2].peaks, down[3].peaks);
  for (const auto& [exact, factor] : {std::pair{&LoadFactorGradients::Triple::lead, &LoadFactors::Triple::lead},
                                      std::pair{&LoadFactorGradients::Triple::profile, &LoadFactors::Triple::profile},
                                      std::pair{&LoadFactorGradients::Triple::combined, &LoadFactors::Triple::combined}}) {
    const auto check = [&](const LoadFactorGradients::Triple& slopes, const LoadFactors::Triple& above, const LoadFactors::Triple& below) {
      const double difference = (above.*factor - below.*factor) / (2 * kStep);
      CHECK(std::abs((slopes.*exact).sum() - difference) <= kLocated * (std::abs(difference) + 0.1 / condition.misalignment.mesh_misalignment));
    };
    check(gradients.without_spikes, high.without_spikes, low.without_spikes);
    check(gradients.line_load, high.line_load, low.line_load);
  }
  // Tip relief is no lead, crowning no profile, and none of them moves the perfect pair.
  CHECK(gradients.without_spikes.lead[1] == 0.0);
  CHECK(gradients.without_spikes.profile[0] == 0.0);
  CHECK(here[0].gradients.with_spikes.contact_stress.isZero());
}

}  // namespace

TEST_CASE("Derivatives of located peaks and load factors are those of peaks sought again", "[core][load][peaks][gradient]") {
  check_located(mesh_cases::pair(20, 30, 20, 4, 30));
}

TEST_CASE("The same for a wide helical and a spur pair", "[core][load][peaks][gradient]") {
  // Not 120 mm: there two peaks of the line load are equal within a step, at z of -36 and -15 mm, and the derivative is that of one of them.
  check_located(GENERATE(mesh_cases::pair(18, 54, 30, 10, 100), mesh_cases::pair(20, 40, 0, 4, 30)));
}

TEST_CASE("Where one spur pair carries all, peak stress follows the root of the torque", "[core][load][peaks][gradient]") {
  constexpr double kRoundOff = 1e-9;
  const GearPair gears = mesh_cases::pair(40, 60, 0, 4, 30);
  const MeshAt mesh = [&](const std::vector<double>& phases) {
    return mesh_cases::model(gears, {{QuadratureRule::Graded, 5}, phases}, MeshEffects::all_but({"extended_contact_region", "free_ends"}));
  };
  const double torque = torque_for(gears, kTorque);
  const ContactPeaks peaks = locate_peaks(mesh, {}, torque);
  const PeakGradients gradients = peak_gradients(mesh, {}, torque, peaks, {PinionTorque{}});
  CHECK(gradients.without_spikes.contact_stress[0] * torque / peaks.without_spikes.contact_stress.value == tests::about(0.5, kRoundOff));
  CHECK(gradients.without_spikes.line_load[0] * torque / peaks.without_spikes.line_load.value == tests::about(1.0, kRoundOff));
}

TEST_CASE("K_Hbeta by line loads has exact derivatives where its peak stays at a face end", "[core][load][peaks][gradient]") {
  // Bending slices of a spur pair without Hertzian deflection: the peak stays at its end of the face and at the phase where single contact begins, so that only
  // the step of the differences, of a rational function, and round-off are left.
  constexpr double kDifference = 1e-6, step = 1e-3 * units::um;
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshAt mesh = [&](const std::vector<double>& phases) {
    return mesh_cases::model(gears, {{QuadratureRule::Graded, 5}, phases},
                             MeshEffects::all_but({"hertzian_contact", "extended_contact_region", "free_ends"}));
  };
  const double torque = torque_for(gears, 300);
  const std::vector<MeshParameter> parameters{&Misalignment::mesh_misalignment, PinionTorque{}};
  // With rims on webs the perfect pair is set against what they open, which grows with the torque.
  const double opening_per_torque = GENERATE(0.0, -6.0) * units::um / torque;
  const auto rated_at = [&](double misalignment, double by_torque, ConditionPart part, const std::vector<MeshParameter>& by) {
    FlankCondition condition;
    condition.misalignment.mesh_misalignment = misalignment;
    const FlankCondition of_part = part_without_rims(condition, part, opening_per_torque * by_torque);
    const ContactPeaks peaks = locate_peaks(mesh, of_part, by_torque, {.phase_tolerance = kFineSearch, .value_tolerance = 0.0});
    return RatedPeaks{peaks, peak_gradients_of_part(mesh, condition, part, by_torque, peaks, by, opening_per_torque)};
  };
  const double here = 4 * units::um;
  const RatedPeaks perfect = rated_at(here, torque, perfect_part, parameters), lead = rated_at(here, torque, lead_part, parameters);
  const LoadFactorGradients gradients = load_factor_gradients(perfect, lead, perfect, lead);
  const auto factor = [&](double misalignment, double by_torque) {
    const ContactPeaks base = rated_at(misalignment, by_torque, perfect_part, {}).peaks,
                       found = rated_at(misalignment, by_torque, lead_part, {}).peaks;
    return load_factors(base, found, base, found).line_load.lead;
  };
  const double by_misalignment = (factor(here + step, torque) - factor(here - step, torque)) / (2 * step);
  CHECK(gradients.line_load.lead[0] == Approx(by_misalignment).epsilon(kDifference));
  const double torque_step = 1e-3 * torque;
  const double by_torque = (factor(here, torque + torque_step) - factor(here, torque - torque_step)) / (2 * torque_step);
  CHECK(gradients.line_load.lead[1] == Approx(by_torque).epsilon(2.0 * kDifference));  // its second order is 1e-6 of it
}

TEST_CASE("A peak at which another point just gains contact follows every parameter with both its sides", "[core][load][peaks][gradient]") {
  // Step^2 of the differences times curvature, and what the search resolves over the step.
  constexpr double kDifference = 5e-3;
  const GearPair gears = mesh_cases::pair(20, 30, 20, 4, 40);
  const double torque = torque_for(gears, 200);
  // At fixed points along the face few points represent a line: each that gains contact takes load off the others.
  const MeshAt mesh = mesh_of(gears, {QuadratureRule::Gauss2, 4});
  FlankCondition condition = crowned_and_relieved();
  std::vector<Moved> moved = movable();
  std::vector<MeshParameter> parameters;
  for (const Moved& m : moved) parameters.push_back(m.parameter);
  parameters.push_back(PinionTorque{});
  const auto peaks = [&](const FlankCondition& c, double by_torque) {
    return locate_peaks(mesh, c, by_torque, {.step = 1.0 / 12, .phase_tolerance = kFineSearch, .value_tolerance = 0.0, .worth = 0.995});
  };
  const ContactPeaks here = peaks(condition, torque);
  const PeakGradients gradients = peak_gradients(mesh, condition, torque, here, parameters);
  int kinks = 0;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double step = p < moved.size() ? kStep : 2e-3 * torque;
    const auto at = [&](double by) {
      FlankCondition c = condition;
      if (p < moved.size()) moved[p].move(c, by);
      return peaks(c, p < moved.size() ? torque : torque + by);
    };
    const ContactPeaks up = at(step), down = at(-step);
    for (const auto& [pair, exact] :
         {std::pair{&ContactPeaks::with_spikes, &gradients.with_spikes}, std::pair{&ContactPeaks::without_spikes, &gradients.without_spikes}}) {
      for (const auto& [of, slopes] :
           {std::pair{&ContactPeaks::Pair::contact_stress, &exact->contact_stress}, std::pair{&ContactPeaks::Pair::line_load, &exact->line_load}}) {
        const auto read = [&, pair = pair, of = of](const ContactPeaks& found) -> const LinePeak& { return (found.*pair).*of; };
        const double difference = (read(up).value - read(down).value) / (2 * step);
        CAPTURE(p, read(here).phase, read(up).phase, read(here).value);
        CHECK(std::abs((*slopes)[static_cast<Eigen::Index>(p)] - difference) <=
              kDifference * (std::abs(difference) + 1e-4 * read(here).value / step));
        // Only geometry holds a phase; one that goes with the torque is that of contact just gained or lost, or of a smooth maximum.
        if (p == moved.size()) kinks += std::abs(read(up).phase - read(down).phase) > 10 * kFineSearch ? 1 : 0;
      }
    }
  }
  CHECK(kinks > 0);
}
