#include "core/load/cycle_resolution.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/transmission_error.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;
using mesh_cases::mesh_of;
using mesh_cases::torque_for;

namespace {

std::vector<double> cosine(int positions, int order, double amplitude) {
  std::vector<double> samples;
  for (int i = 0; i < positions; ++i) samples.push_back(amplitude * std::cos(2 * units::pi * order * i / positions));
  return samples;
}

std::vector<double> transmission_error(const MeshAt& mesh_at, double torque, int positions) {
  const Eigen::VectorXd error = analyse_cycle(mesh_at(equally_spaced_phases(positions)), {}, torque).transmission_error();
  return {error.begin(), error.end()};
}

}  // namespace

TEST_CASE("What half the positions resolve does not change, what they alias does", "[core][load][resolution]") {
  constexpr double kRoundOff = 1e-14;
  CHECK(cycle_convergence(cosine(32, 3, 2.0)).harmonic_change == Approx(0).margin(kRoundOff));
  // 16 positions take order 13 for order 3.
  CHECK(cycle_convergence(cosine(32, 13, 2.0)).harmonic_change == Approx(2.0).epsilon(kRoundOff));
  CHECK(cycle_convergence(cosine(32, 16, 1.0)).peak_to_peak_change == Approx(2.0).epsilon(kRoundOff));
  CHECK(cycle_convergence(cosine(32, 3, 2.0)).positions == 32);
  CHECK(std::isnan(cycle_convergence(cosine(31, 3, 2.0)).harmonic_change));
  CHECK(std::isnan(cycle_convergence({1, 2}).harmonic_change));
}

TEST_CASE("Chosen positions resolve the harmonics to what was asked", "[core][load][resolution]") {
  const GearPair gears = GENERATE(mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(20, 40, 0, 4, 30));
  const MeshAt mesh_at = mesh_of(gears, {QuadratureRule::Graded, 4});
  const double torque = torque_for(gears, 100);
  const ResolutionChoice choice = choose_positions(mesh_at, {}, torque, {.relative = 0.02});
  REQUIRE(choice.converged);
  const int n = choice.convergence.positions;
  const std::vector<double> chosen = harmonic_amplitudes(transmission_error(mesh_at, torque, n));
  const std::vector<double> fine = transmission_error(mesh_at, torque, 8 * n);
  const std::vector<double> true_ones = harmonic_amplitudes(fine);
  const auto [low, high] = std::ranges::minmax(fine);
  CAPTURE(n, choice.convergence.harmonic_change, high - low);
  CHECK(choice.convergence.harmonic_change <= 0.02 * (high - low));
  for (std::size_t k = 0; k < true_ones.size(); ++k) CHECK(std::abs(chosen[k] - true_ones[k]) <= 0.02 * (high - low));
}

TEST_CASE("A search that may not double says what it found", "[core][load][resolution]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshAt mesh_at = mesh_of(gears, {});
  const double torque = torque_for(gears, 100);
  const ResolutionChoice choice = choose_positions(mesh_at, {}, torque, {.fewest = 32, .most = 64, .relative = 0, .absolute = 1e-15});
  CHECK_FALSE(choice.converged);
  CHECK(choice.convergence.positions == 64);
  // Doubling keeps what was solved: the merged curve is that of 64 positions at once.
  const CycleConvergence at_once = cycle_convergence(transmission_error(mesh_at, torque, 64));
  CHECK(choice.convergence.harmonic_change == Approx(at_once.harmonic_change).margin(1e-12));
  CHECK_THROWS_AS(choose_positions(mesh_at, {}, torque, {.fewest = 8}), InvalidInput);
  CHECK_THROWS_AS(choose_positions(mesh_at, {}, torque, {.absolute = 0}), InvalidInput);
}
