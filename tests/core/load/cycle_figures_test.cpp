#include "core/load/cycle/cycle_figures.hpp"

#include <catch2/catch.hpp>

#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

FlankCondition crowned_and_tilted() {
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 6 * units::um;
  condition.misalignment.mesh_misalignment = 5 * units::um;
  return condition;
}

/// The largest a curve really gets, by a thousand times as many samples.
template <class Curve>
double highest(const Curve& curve, int samples) {
  double value = curve(0.0);
  for (int i = 1; i < 1000 * samples; ++i) value = std::max(value, curve(i / (1000.0 * samples)));
  return value;
}

template <class Curve>
std::vector<double> sampled(const Curve& curve, int n) {
  std::vector<double> samples;
  for (int i = 0; i < n; ++i) samples.push_back(curve(static_cast<double>(i) / n));
  return samples;
}

}  // namespace

TEST_CASE("A gap common to the whole mesh is no deflection that the mean's error could hide in", "[core][load][cycle-figures]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const auto at = [&](double apart, double torque) {
    FlankCondition condition = crowned_and_tilted();
    condition.misalignment.centre_distance = apart;
    const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 2}, equally_spaced_phases(12)});
    const LoadedCycle cycle = analyse_cycle(model, condition, torque);
    return figures_of(cycle, summarise(model, cycle));
  };
  const double torque = mesh_cases::torque_for(gears, 200);
  for (double apart : {0.0, 0.2}) {
    const double error = figure_errors(at(apart, torque), at(apart, 1.01 * torque))[static_cast<std::size_t>(Figure::TeMean)];
    CAPTURE(apart);
    CHECK(error == Approx(0.01).epsilon(0.3));  // the mesh is nearly linear
  }
}

TEST_CASE("The error of sampled extremes is bounded for kinks, jumps and smooth maxima", "[core][load][cycle-figures]") {
  const int n = GENERATE(12, 16, 33, 64);
  const double shift = GENERATE(0.0, 0.013, 0.4111);
  const auto turned = [&](double x) { return x + shift - std::floor(x + shift); };
  const auto kink = [&](double x) { return -std::abs(turned(x) - 0.5); };
  const auto saw = [&](double x) { return turned(x); };
  const auto smooth = [&](double x) { return std::cos(2.0 * units::pi * turned(x)); };
  CAPTURE(n, shift);
  const auto check = [&](const auto& curve, double at_most) {
    const std::vector<double> samples = sampled(curve, n);
    const double hidden = highest(curve, n) - *std::max_element(samples.begin(), samples.end());
    const double bound = unseen_rise(samples);
    constexpr double kRoundOff = 1e-12;
    CHECK(bound >= hidden - kRoundOff);
    CHECK(bound <= at_most);
  };
  check(kink, 1.0 / n);  // the rise of one step
  check(saw, 1.0 / n + 1e-12);
  check(smooth, 10.0 / (n * n) * 2.0);  // second order: half the curvature, (2 pi)^2 / 2, times the square of the step
}
