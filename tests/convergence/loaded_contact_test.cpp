#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

/// Without free ends: next to them the load turns as a logarithm does, which no order of Gauss' follows.
CycleSummary summary(const GearPair& gears, const FlankCondition& condition, double line_load, int intervals, int positions) {
  const MeshModel model =
      mesh_cases::model(gears, {{QuadratureRule::Gauss2, intervals}, equally_spaced_phases(positions)}, MeshEffects::all_but({"free_ends"}));
  return summarise(model, analyse_cycle(model, condition, mesh_cases::torque_for(gears, line_load)));
}

/// Order of error against number of intervals, by least squares over the logarithms.
double observed_order(const std::vector<int>& intervals, const std::vector<double>& errors) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(intervals.size());
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double u = std::log(intervals[i]), v = std::log(errors[i]);
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  return -(n * xy - x * y) / (n * xx - x * x);
}

FlankCondition crowned(double crowning_um, double misalignment_um) {
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = crowning_um * units::um;
  condition.misalignment.mesh_misalignment = misalignment_um * units::um;
  return condition;
}

}  // namespace

TEST_CASE("Where a spur line is in contact all along, two Gauss points an interval converge with the fourth order", "[convergence][load]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const FlankCondition condition = crowned(6, 4);
  const double exact = summary(gears, condition, 400, 160, 4).te_mean;
  const std::vector<int> intervals{5, 10, 20, 40};
  std::vector<double> errors;
  for (int n : intervals) errors.push_back(std::abs(summary(gears, condition, 400, n, 4).te_mean - exact) / exact);
  CAPTURE(errors);
  CHECK(errors[0] < 1e-6);
  CHECK(observed_order(intervals, errors) == tests::about(4.0, 0.2));
}

TEST_CASE("An evenly loaded spur line needs one interval", "[convergence][load]") {
  constexpr double kRoundOff = 1e-10;
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const CycleSummary one = summary(gears, {}, 150, 1, 8), many = summary(gears, {}, 150, 40, 8);
  CHECK(one.te_mean == Approx(many.te_mean).epsilon(kRoundOff));
  CHECK(one.te_peak_to_peak == Approx(many.te_peak_to_peak).epsilon(kRoundOff));
  CHECK(one.peak_line_load == Approx(many.peak_line_load).epsilon(kRoundOff));
}

TEST_CASE("Ends of contact inside the face leave the quadrature with an order of one or more", "[convergence][load]") {
  // A line's end falls anywhere in an interval: up to a point's share is counted too much or too little. Errors jump
  // with the place, so that only their trend has an order.
  const bool helical = GENERATE(false, true);
  const GearPair gears = helical ? mesh_cases::pair(18, 54, 30, 10, 120) : mesh_cases::pair(20, 40, 0, 4, 30);
  const FlankCondition condition = crowned(20, 30);
  const int positions = helical ? 6 : 4;
  const CycleSummary exact = summary(gears, condition, 60, 160, positions);
  const std::vector<int> intervals{5, 10, 20, 40};
  std::vector<double> te, load;
  for (int n : intervals) {
    const CycleSummary coarse = summary(gears, condition, 60, n, positions);
    te.push_back(std::abs(coarse.te_mean / exact.te_mean - 1.0));
    load.push_back(std::abs(coarse.peak_line_load / exact.peak_line_load - 1.0));
  }
  CAPTURE(helical, te, load);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    CHECK(te[i] < 0.05 / intervals[i]);
    CHECK(load[i] < 0.5 / intervals[i]);
  }
  CHECK(te.back() < te.front());
  CHECK(load.back() < load.front());
}

TEST_CASE("Intervals that end where lines do take the ripple off the transmission error", "[convergence][load][slow]") {
  // At fixed places a point's share of load enters and leaves at once, once every interval: the transmission error of an
  // aligned helical pair ripples by it. With located ends it is smooth, and a few intervals do.
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const auto peak_to_peak = [&](QuadratureRule rule, int intervals) {
    const MeshModel model = mesh_cases::model(gears, {{rule, intervals}, equally_spaced_phases(40)});
    return summarise(model, analyse_cycle(model, {}, mesh_cases::torque_for(gears, 80))).te_peak_to_peak;
  };
  const double exact = peak_to_peak(QuadratureRule::Graded, 40);
  CHECK(peak_to_peak(QuadratureRule::Gauss2, 160) == Approx(exact).epsilon(0.05));
  const double fixed = std::abs(peak_to_peak(QuadratureRule::Gauss2, 5) / exact - 1.0);
  const double graded = std::abs(peak_to_peak(QuadratureRule::Graded, 5) / exact - 1.0);
  CAPTURE(exact, fixed, graded);
  CHECK(graded < 0.1 * fixed);
}

TEST_CASE("Mean and first harmonic of the transmission error settle with the number of positions", "[convergence][load]") {
  // The first slope of f_t jumps where teeth gain and lose contact: second order for integrals over the pitch.
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  FlankCondition condition = crowned(20, 30);
  condition.modification.pinion.tip_relief = condition.modification.wheel.tip_relief = {30 * units::um, 3.0, ReliefShape::Parabolic};
  const auto at = [&](int positions) { return summary(gears, condition, 200, 10, positions); };
  const CycleSummary exact = at(256);
  for (int positions : {16, 32, 64}) {
    const CycleSummary coarse = at(positions);
    CAPTURE(positions);
    const double allowed = 8.0 / (positions * positions);
    CHECK(coarse.te_mean == Approx(exact.te_mean).epsilon(allowed));
    CHECK(coarse.te_harmonics[0] == Approx(exact.te_harmonics[0]).epsilon(allowed));
    // The peak itself is only sampled.
    CHECK(coarse.te_peak_to_peak == Approx(exact.te_peak_to_peak).epsilon(1.0 / positions));
  }
}
