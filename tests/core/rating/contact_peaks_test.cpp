#include "core/rating/contact_peaks.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/rating/line_region.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using mesh_cases::mesh_of;
using mesh_cases::torque_for;

namespace {

FlankCondition misaligned(double by) {
  FlankCondition condition;
  condition.misalignment.mesh_misalignment = by;
  return condition;
}

/// Every line of a position and what there is of it between A and E.
template <class Visit>
void for_lines(const MeshModel& model, double phase, const Visit& visit) {
  const LineRegion region(model);
  for (int tooth = -2; tooth <= static_cast<int>(region.path.last_line_phase()) + 2; ++tooth) {
    const LineInterval line = region.line(phase + tooth);
    visit(region, tooth, line.end - line.begin);
  }
}

}  // namespace

TEST_CASE("Located peaks do not depend on where the search starts", "[core][load][peaks]") {
  // Discretisation: a cusp of a few thousand MPa per base pitch, located to 2e-4 of it; sides of it are flatter.
  constexpr double kLocated = 1e-3;
  const auto [gears, by] = GENERATE(std::pair{mesh_cases::pair(18, 54, 30, 10, 120), 8.0}, std::pair{mesh_cases::pair(25, 31, 12, 2, 15), -6.0},
                                    std::pair{mesh_cases::pair(20, 40, 0, 4, 30), 5.0});
  const FlankCondition condition = misaligned(by * units::um);
  const auto located = [&, &gears = gears](double step) { return locate_peaks(mesh_of(gears), condition, torque_for(gears, 100), {.step = step}); };
  const ContactPeaks few = located(1.0 / 16), many = located(1.0 / 64);
  CHECK(few.positions < many.positions);
  for (const auto which : {&ContactPeaks::with_spikes, &ContactPeaks::without_spikes}) {
    CHECK((few.*which).contact_stress.value == Approx((many.*which).contact_stress.value).epsilon(kLocated));
    CHECK((few.*which).line_load.value == Approx((many.*which).line_load.value).epsilon(kLocated));
  }
}

TEST_CASE("No sampling of the cycle finds a higher peak than the one located, and a fine one nearly finds it", "[core][load][peaks]") {
  constexpr double kLocated = 1e-3;   // as above
  constexpr double kSampled = 0.005;  // discretisation: 400 positions
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const FlankCondition condition = misaligned(8 * units::um);
  const double torque = torque_for(gears, 100);
  const ContactPeaks located = locate_peaks(mesh_of(gears), condition, torque);
  const MeshModel model = mesh_of(gears)(equally_spaced_phases(400));
  const LoadedCycle cycle = analyse_cycle(model, condition, torque);
  double with = 0, without = 0;
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const ContactPeaks here = peaks_at(model, model.positions[i], cycle.positions[i]);
    with = std::max(with, here.with_spikes.contact_stress.value);
    without = std::max(without, here.without_spikes.contact_stress.value);
    CHECK(here.with_spikes.contact_stress.value == cycle.positions[i].contact_stress.maxCoeff());
  }
  CHECK(with <= located.with_spikes.contact_stress.value * (1 + kLocated));
  CHECK(with == Approx(located.with_spikes.contact_stress.value).epsilon(kSampled));
  CHECK(without <= located.without_spikes.contact_stress.value * (1 + kLocated));
  CHECK(without == Approx(located.without_spikes.contact_stress.value).epsilon(kSampled));
}

TEST_CASE("The station of a located peak carries the peak", "[core][load][peaks]") {
  constexpr double kRoundOff = 1e-9;  // the same position solved from another start
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const FlankCondition condition = misaligned(8 * units::um);
  const double torque = torque_for(gears, 100);
  const LinePeak peak = locate_peaks(mesh_of(gears), condition, torque).with_spikes.contact_stress;
  const MeshModel model = mesh_of(gears)({peak.phase});
  const LoadedCycle cycle = analyse_cycle(model, condition, torque);
  const ContactPeaks here = peaks_at(model, model.positions[0], cycle.positions[0]);
  CHECK(here.with_spikes.contact_stress.value == Approx(peak.value).epsilon(kRoundOff));
  CHECK(here.with_spikes.contact_stress.tooth == peak.tooth);
  CHECK(here.with_spikes.contact_stress.z == tests::about(peak.z, 1e-6));
}

TEST_CASE("Peaks without spikes count long lines away from the tip edges, cut exactly", "[core][load][peaks]") {
  constexpr double kRoundOff = 1e-12;
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_of(gears)({0.6});
  const LineRegion region(model);
  const SpikeRule rule{0.5, 1.0};
  // Squares of stress linear along z, and all lines but one of them off: the peak is the value at the far cut.
  LoadedPosition loaded;
  loaded.phase = 0.6;
  const MeshPosition& at = model.positions[0];
  for (int tooth = 0; tooth < 4; ++tooth) {
    CAPTURE(tooth);
    loaded.peak_load = loaded.contact_stress = Eigen::VectorXd::Zero(at.weight.size());
    for (Eigen::Index i = 0; i < at.weight.size(); ++i) {
      const ContactPoint& point = at.points[static_cast<std::size_t>(i)];
      if (point.tooth != tooth) continue;
      loaded.peak_load[i] = 200 + point.z;
      loaded.contact_stress[i] = std::sqrt(200 + point.z);
    }
    const ContactPeaks peaks = peaks_at(model, at, loaded, rule);
    const LineInterval whole = region.line(0.6 + tooth), cut = region.line(0.6 + tooth, 10);
    if (whole.end - whole.begin < 0.5 * region.longest) {
      CHECK(peaks.without_spikes.line_load.value == 0);
      continue;
    }
    // A cut on the face lies beyond the last quadrature point: then that is the last that counts.
    double last = cut.end;
    if (cut.end == region.face_end) {
      last = cut.begin;
      for (const ContactPoint& point : at.points) {
        if (point.tooth == tooth && point.z <= cut.end) last = std::max(last, point.z);
      }
    }
    CHECK(peaks.without_spikes.line_load.value == Approx(200 + last).epsilon(kRoundOff));
    CHECK(peaks.without_spikes.contact_stress.value == Approx(std::sqrt(200 + last)).epsilon(kRoundOff));
    CHECK(peaks.with_spikes.line_load.value >= peaks.without_spikes.line_load.value);
  }
}

TEST_CASE("A rule that leaves nothing out leaves out only what lies beyond A and E", "[core][load][peaks]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);  // spur: no line has an end at a tip edge
  const MeshModel model = mesh_of(gears)(equally_spaced_phases(16));
  const LoadedCycle cycle = analyse_cycle(model, misaligned(5 * units::um), torque_for(gears, 200));
  for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
    double on_path = 0;
    for (std::size_t i = 0; i < model.positions[k].points.size(); ++i) {
      if (model.positions[k].points[i].clearance > 0) continue;
      on_path = std::max(on_path, cycle.positions[k].contact_stress[static_cast<Eigen::Index>(i)]);
    }
    const ContactPeaks peaks = peaks_at(model, model.positions[k], cycle.positions[k]);
    CHECK(peaks.without_spikes.contact_stress.value == on_path);
  }
}

TEST_CASE("At its events a line has just begun, just ended, or just the length of the rule", "[core][load][peaks]") {
  constexpr double kRoundOff = 1e-6;  // mm, of line ends on a path of a few hundred
  const GearPair gears = GENERATE(mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(25, 31, 12, 2, 15));
  const MeshModel model = mesh_of(gears)({0.0});
  const std::vector<double> events = line_events(model, 0.5);
  CHECK(events.size() <= 10);
  for (const double event : events) {
    CAPTURE(event);
    CHECK(event >= 0);
    CHECK(event < 1);
    bool found = false;
    for_lines(model, event, [&](const LineRegion& region, int tooth, double length) {
      const double low = region.path.phase_at(event + tooth, region.face_start), high = region.path.phase_at(event + tooth, region.face_end);
      for (const double edge : {0.0, region.first, region.last, region.path.region_length}) {
        found = found || std::abs(low - edge) < 1e-9 || std::abs(high - edge) < 1e-9;
      }
      found = found || std::abs(length - 0.5 * region.longest) < kRoundOff;
    });
    CHECK(found);
  }
}

TEST_CASE("A peak search refuses what it cannot do", "[core][load][peaks]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const auto with = [&](const PeakSearch& search) { return locate_peaks(mesh_of(gears), {}, torque_for(gears, 100), search); };
  CHECK_THROWS_AS(with({.step = 0.0}), InvalidInput);
  CHECK_THROWS_AS(with({.phase_tolerance = -1.0}), InvalidInput);
  CHECK_THROWS_AS(with({.spikes = {.line_share = 1.5}}), InvalidInput);
  CHECK_THROWS_AS(with({.spikes = {.end_distance = -1.0}}), InvalidInput);
}
