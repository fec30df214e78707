#include "core/rating/load_signal.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/base/error.hpp"
#include "tests/common/random.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

constexpr double one_turn = 2.0 * units::pi;

/// Samples of torque [N mm] and speed [rad/s] at even times from 0 to the end.
LoadSignal sampled(int samples, double end, const std::function<double(double)>& torque, const std::function<double(double)>& speed) {
  LoadSignal signal;
  for (int i = 0; i < samples; ++i) {
    const double t = end * i / (samples - 1);
    signal.time.push_back(t);
    signal.torque.push_back(torque(t));
    signal.speed.push_back(speed(t));
  }
  return signal;
}

struct SignalTotals {
  double duration{0.0}, revolutions{0.0};
};

SignalTotals totals_of(const LoadCount& count) {
  SignalTotals totals{count.idle_duration + count.standing_duration, count.idle_revolutions};
  for (const LoadLevel& level : count.levels) {
    totals.duration += level.duration;
    totals.revolutions += level.cycles;
  }
  return totals;
}

std::string refused_quantity(const std::function<void()>& count) {
  try {
    count();
  } catch (const InvalidInput& problem) {
    return problem.field();
  }
  return "";
}

/// Sum of cycles times torque^exponent: damage by Miner's rule in a unit of its own.
double damage_of(const LoadCount& count, double exponent) {
  double damage = 0.0;
  for (const LoadLevel& level : count.levels) damage += level.cycles * std::pow(level.torque, exponent);
  return damage;
}

}  // namespace

TEST_CASE("A torque that rises evenly is as long in each range of torques", "[core][rating][life]") {
  constexpr double round_off = 1e-12;
  constexpr int ranges = 8;
  // From 100 to 300 N mm in 40 s while the speed falls from 20 to 4 turns a second.
  const LoadSignal signal{{0.0, 40.0}, {100.0, 300.0}, {20.0 * one_turn, 4.0 * one_turn}};
  for (const bool falls : {false, true}) {
    LoadSignal of = signal;
    if (falls) {
      std::ranges::reverse(of.torque);
      std::ranges::reverse(of.speed);
      for (double& speed : of.speed) speed = -speed;  // either way round
    }
    const LoadCount count = count_time_at_level(of, ranges);
    REQUIRE(count.levels.size() == ranges);
    for (int k = 0; k < ranges; ++k) {
      const LoadLevel& level = count.levels[static_cast<std::size_t>(k)];
      CHECK(level.torque == Approx(100.0 + 25.0 * (k + 1)).epsilon(round_off));
      CHECK(level.duration == Approx(5.0).epsilon(round_off));
      CHECK(level.cycles == Approx(5.0 * (20.0 - 2.0 * (k + 0.5))).epsilon(round_off));
    }
    CHECK(count.idle_duration == 0.0);
  }
}

TEST_CASE("A sine is at its levels as long as its arcs say", "[core][rating][life]") {
  constexpr int samples = 20001, ranges = 10;
  const LoadSignal signal = sampled(
      samples, 4.0, [](double t) { return 500.0 + 300.0 * std::sin(one_turn * t); }, [](double) { return 3.0 * one_turn; });
  const LoadCount count = count_time_at_level(signal, ranges);
  REQUIRE(count.levels.size() == ranges);
  // A chord is off the arc by (pi/5000)^2/2 of the amplitude; near the crest that is a time of 1e-4 of a period.
  constexpr double discretisation = 2e-4;
  for (int k = 0; k < ranges; ++k) {
    const auto phase = [&](int edge) { return std::asin(-1.0 + 2.0 * edge / ranges); };
    const double duration = 4.0 * (phase(k + 1) - phase(k)) / units::pi;
    CHECK(count.levels[static_cast<std::size_t>(k)].duration == Approx(duration).epsilon(discretisation));
    CHECK(count.levels[static_cast<std::size_t>(k)].cycles == Approx(3.0 * duration).epsilon(discretisation));
  }
}

TEST_CASE("Blocks of constant torque are their own bins", "[core][rating][life]") {
  constexpr double round_off = 1e-9, step = 1e-9;  // s; what the steps take of 1 s
  LoadSignal signal;
  double t = 0.0;
  for (const auto& [torque, duration] : {std::pair{200.0, 10.0}, std::pair{1000.0, 1.0}, std::pair{0.0, 5.0}, std::pair{610.0, 4.0}}) {
    for (const double at : {t + step, t + duration}) {
      signal.time.push_back(at);
      signal.torque.push_back(torque);
      signal.speed.push_back(10.0 * one_turn);
    }
    t += duration;
  }
  const LoadCount count = count_time_at_level(signal, 7);
  const auto duration_at = [&](double torque) {
    const auto level = std::ranges::find(count.levels, torque, &LoadLevel::torque);
    return level == count.levels.end() ? -1.0 : level->duration;
  };
  CHECK(duration_at(1000.0) == Approx(1.0).epsilon(10 * round_off));
  CHECK(count.idle_duration == Approx(5.0).epsilon(round_off));
  // 610 and 200 lie within a range that steps cross as well: their range goes up to its end.
  const LoadCount constant = count_time_at_level({{0.0, 3.0, 7.0}, {50.0, 50.0, 50.0}, {one_turn, one_turn, one_turn}}, 20);
  REQUIRE(constant.levels.size() == 1);
  CHECK(constant.levels.front().torque == 50.0);
  CHECK(constant.levels.front().duration == 7.0);
  CHECK(constant.levels.front().cycles == Approx(7.0).epsilon(round_off));
}

TEST_CASE("Time and revolutions of a signal are conserved, whatever it does", "[core][rating][life]") {
  constexpr double round_off = 1e-11;
  tests::Random random(3);
  for (const int ranges : {1, 3, 20, 200}) {
    LoadSignal signal;
    double t = -5.0, revolutions = 0.0, reversed = 0.0;
    for (int i = 0; i < 500; ++i) {
      signal.time.push_back(t += random(1e-4, 2.0));
      signal.torque.push_back(100.0 + 200.0 * random.normal());
      signal.speed.push_back(50.0 * random.normal());
      if (i == 0) continue;
      const auto at = [&](const std::vector<double>& of, int back) { return of[of.size() - 1 - static_cast<std::size_t>(back)]; };
      const double dt = at(signal.time, 0) - at(signal.time, 1), a = at(signal.torque, 1), b = at(signal.torque, 0);
      const double from = at(signal.speed, 1), to = at(signal.speed, 0);  // where they differ in sign the pinion turns back on the way
      const double mean_speed = from * to < 0.0 ? (from * from + to * to) / (2.0 * std::abs(from - to)) : std::abs(from + to) / 2.0;
      revolutions += dt * mean_speed / one_turn;
      if (a < 0.0 && b < 0.0) reversed += dt;
      if ((a < 0.0) != (b < 0.0)) reversed += dt * std::min(a, b) / (std::min(a, b) - std::max(a, b));
    }
    const LoadCount count = count_time_at_level(signal, ranges);
    CHECK(totals_of(count).duration == Approx(signal.duration()).epsilon(round_off));
    CHECK(totals_of(count).revolutions == Approx(revolutions).epsilon(round_off));
    CHECK(count.reversed_duration == Approx(reversed).epsilon(round_off));
    CHECK(count.idle_duration == Approx(reversed).epsilon(round_off));  // no torque is 0 for a while
    CHECK(count.levels.back().torque == *std::ranges::max_element(signal.torque));
    CHECK(std::ranges::is_sorted(count.levels, std::less(), &LoadLevel::torque));
  }
}

TEST_CASE("Bins leave out no damage, and the finer they are the less they add", "[core][rating][life]") {
  constexpr double exponent = 6.6;  // of torque, where stress grows as its root and the S-N curve has 13.2
  const LoadSignal signal = sampled(
      5001, 10.0, [](double t) { return 500.0 + 300.0 * std::sin(one_turn * t / 10.0); }, [](double) { return 5.0 * one_turn; });
  double exact = 0.0;  // mid-point rule on the samples: 1e-7 off
  for (std::size_t i = 0; i + 1 < signal.time.size(); ++i) {
    exact += 5.0 * (signal.time[i + 1] - signal.time[i]) * std::pow(0.5 * (signal.torque[i] + signal.torque[i + 1]), exponent);
  }
  double before = 0.0;
  for (const int ranges : {10, 20, 40, 80, 160}) {
    const double excess = damage_of(count_time_at_level(signal, ranges), exponent) / exact - 1.0;
    CHECK(excess > 0.0);
    if (before > 0.0) CHECK(excess == Approx(before / 2.0).epsilon(0.2));  // of first order in the width of a bin
    before = excess;
  }
  CHECK(before < 0.02);
}

TEST_CASE("A load on gears that stand brings no load cycles", "[core][rating][life]") {
  // 4 s at 300 without turning, a second of coming to speed, 5 s at 100.
  const LoadSignal signal{{0.0, 4.0, 5.0, 10.0}, {300.0, 300.0, 100.0, 100.0}, {0.0, 0.0, 2.0 * one_turn, 2.0 * one_turn}};
  const LoadCount count = count_time_at_level(signal, 2);
  CHECK(totals_of(count).duration == Approx(10.0).epsilon(1e-12));
  CHECK(totals_of(count).revolutions == Approx(11.0).epsilon(1e-12));
  const LoadCount all_standing_above = count_time_at_level({{0.0, 4.0, 4.5, 10.0}, {300.0, 300.0, 100.0, 100.0}, {0.0, 0.0, 0.0, 2.0 * one_turn}}, 2);
  REQUIRE(all_standing_above.levels.size() == 1);
  CHECK(all_standing_above.levels.front().torque == 100.0);
  CHECK(all_standing_above.standing_duration == Approx(4.5).epsilon(1e-12));
  CHECK(totals_of(all_standing_above).duration == Approx(10.0).epsilon(1e-12));
}

TEST_CASE("The speed of a level is that of its load cycles, however long the pinion stands or creeps under its torque", "[core][rating][life]") {
  constexpr double round_off = 1e-12, turns = 25.0, step = 1e-9;  // of the pinion in a second; of speed [s]
  for (const double creep : {0.0, 0.01}) {
    const LoadSignal hoist{
        {0.0, 10.0, 10.0 + step, 100.0}, {300.0, 300.0, 300.0, 300.0}, {turns * one_turn, turns * one_turn, creep * one_turn, creep * one_turn}};
    const LoadCount count = count_time_at_level(hoist, 5);
    REQUIRE(count.levels.size() == 1);
    const double fast = 10.0 * turns, slow = 90.0 * creep;  // revolutions
    CHECK(count.levels.front().cycles == Approx(fast + slow).epsilon(step * turns));
    CHECK(count.levels.front().speed == Approx(one_turn * (fast * turns + slow * creep) / (fast + slow)).epsilon(step * turns));
    CHECK(count.standing_duration == tests::about(creep > 0.0 ? 0.0 : 90.0, 2.0 * step));
  }
  // A speed that rises evenly from 0: two thirds of its end, by the revolutions that it makes.
  CHECK(count_time_at_level({{0.0, 8.0}, {1.0, 1.0}, {0.0, 3.0}}, 1).levels.front().speed == Approx(2.0).epsilon(round_off));
}

TEST_CASE("Swings from 0 count with their height, smaller ones less than their top", "[core][rating][life]") {
  // Two swings from 0 to 100, one to 40, and a ripple from 80 to 100 on one of them.
  const LoadSignal signal{{0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 100, 80, 100, 0, 40, 0, 100, 0}, {}};
  const LoadCount count = count_rainflow(signal, 200);
  REQUIRE(count.levels.size() == 3);
  CHECK(count.levels[0].torque == 40.0);
  CHECK(count.levels[0].cycles == 1.0);
  CHECK(count.levels[1].torque == Approx(std::sqrt(100.0 * 20.0)).epsilon(1e-12));
  CHECK(count.levels[1].cycles == 1.0);
  CHECK(count.levels[2].torque == Approx(100.0).epsilon(1e-12));
  CHECK(count.levels[2].cycles == 2.0);
  // What loads the other flank is no part of a swing.
  LoadSignal alternating = signal;
  for (double& torque : alternating.torque) torque = torque == 0.0 ? -70.0 : torque;
  const LoadCount same = count_rainflow(alternating, 200);
  REQUIRE(same.levels.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) CHECK(same.levels[k].torque == count.levels[k].torque);
}

TEST_CASE("What is wrong with a signal is told by its quantity", "[core][rating][life]") {
  const auto at_level = [](const LoadSignal& signal) { return refused_quantity([&] { count_time_at_level(signal, 5); }); };
  CHECK(at_level({{0.0}, {1.0}, {1.0}}) == "time");
  CHECK(at_level({{0.0, 1.0, 1.0}, {1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}}) == "time");
  CHECK(at_level({{0.0, 1.0}, {1.0, NAN}, {1.0, 1.0}}) == "torque");
  CHECK(at_level({{0.0, 1.0}, {1.0}, {1.0, 1.0}}) == "torque");
  CHECK(at_level({{0.0, 1.0}, {1.0, 2.0}, {}}) == "speed");
  CHECK(at_level({{0.0, 1.0}, {1.0, 2.0}, {1.0}}) == "speed");
  CHECK(at_level({{0.0, 1.0}, {1.0, 2.0}, {1.0, 1.0}}).empty());
  CHECK(refused_quantity([] { count_time_at_level({{0.0, 1.0}, {1.0, 2.0}, {1.0, 1.0}}, 0); }) == "ranges");
}

TEST_CASE("A signal that loads only the other flank, or only a pinion that stands, has no levels", "[core][rating][life]") {
  const LoadCount reversed = count_time_at_level({{0.0, 8.0}, {-2.0, -1.0}, {one_turn, one_turn}}, 5);
  CHECK(reversed.levels.empty());
  CHECK(reversed.reversed_duration == 8.0);
  CHECK(reversed.idle_duration == 8.0);
  CHECK(reversed.idle_revolutions == Approx(8.0).epsilon(1e-12));  // round-off
  const LoadCount standing = count_time_at_level({{0.0, 8.0}, {1.0, 2.0}, {0.0, 0.0}}, 5);
  CHECK(standing.levels.empty());
  CHECK(standing.standing_duration == Approx(8.0).epsilon(1e-12));
  CHECK(count_rainflow({{0.0, 1.0, 2.0}, {-3.0, -2.0, -3.0}, {}}, 5).levels.empty());
}
