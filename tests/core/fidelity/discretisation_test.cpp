#include "core/fidelity/discretisation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/common/random.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

struct LoadCase {
  GearPair gears;
  FlankCondition condition;
  double torque{0.0};

  MeshOfResolution mesh() const {
    return [this](const MeshResolution& resolution) { return mesh_cases::model(gears, resolution); };
  }
  CycleFigures figures(const Quadrature& quadrature, int positions) const {
    const MeshModel model = mesh()({quadrature, equally_spaced_phases(positions)});
    const LoadedCycle cycle = analyse_cycle(model, condition, torque);
    const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh()({quadrature, phases}); };
    return figures_of(model, cycle, resolve_cycle(model, cycle, at, condition, torque, {}).summary);
  }
};

/// Pairs, flanks, misalignments and torques of all sorts; a quarter of the pairs are spur gears.
/// @param widest  face width [m_n]
LoadCase random_case(unsigned seed, double widest = 15.0) {
  tests::Random32 random(seed);
  const auto amount = [&](double low, double high) { return random(low, high) * units::um; };
  const double module = random(1.0, 10.0), helix = random.chance(0.25) ? 0.0 : random(5.0, 32.0);
  const int teeth = static_cast<int>(random(17.0, 50.0));
  LoadCase drawn{mesh_cases::pair(teeth, static_cast<int>(teeth * random(1.0, 4.0)), helix, module, module * random(4.0, widest)), {}};
  FlankCondition& c = drawn.condition;
  if (random.chance(0.6)) c.modification.pinion.lead_crowning = amount(2, 15);
  if (random.chance(0.4)) c.modification.pinion.addendum_crowning = c.modification.pinion.dedendum_crowning = amount(1, 10);
  for (Modification* modification : {&c.modification.pinion, &c.modification.wheel}) {
    if (!random.chance(0.4)) continue;
    const ReliefShape shape = random.chance(0.5) ? ReliefShape::Linear : ReliefShape::Parabolic;
    modification->tip_relief = {amount(3, 30), module * random(0.2, 0.6), shape};
  }
  if (random.chance(0.7)) c.misalignment.mesh_misalignment = amount(-20, 20);
  if (random.chance(0.3)) c.error.pinion.helix_slope = amount(-8, 8);
  drawn.torque = mesh_cases::torque_for(drawn.gears, module * random(4.0, 40.0));
  return drawn;
}

struct Honesty {
  int drawn{0}, within{0}, not_kept{0};
  int honest{0};  ///< within the stated error, and not less than a tenth of it
  int over_tenfold{0};
};

/// Chooses for random load cases and compares with at least three times the intervals and four times the positions.
Honesty honesty(unsigned first, int count, double widest, const DiscretisationSearch& search) {
  Honesty result;
  for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
    const LoadCase drawn = random_case(seed, widest);
    const Discretisation chosen = choose_discretisation(drawn.mesh(), QuadratureRule::Graded, drawn.condition, drawn.torque, search);
    const Quadrature finer{QuadratureRule::Graded, std::max(16, 3 * chosen.quadrature.intervals)};
    const CycleFigures truth = drawn.figures(finer, std::max(64, 4 * chosen.positions));
    const double error = largest(figure_errors(drawn.figures(chosen.quadrature, chosen.positions), truth));
    const double stated = largest(chosen.error());
    UNSCOPED_INFO(seed << ": stated " << 100 * stated << " %, found " << 100 * error << " % with " << chosen.quadrature.intervals << " intervals, "
                       << chosen.positions << " positions" << (chosen.kept ? "" : ", not kept"));
    ++result.drawn;
    const bool within = error <= stated, tenfold = stated > 10.0 * error;
    result.within += within ? 1 : 0;
    result.honest += within && !tenfold ? 1 : 0;
    result.over_tenfold += tenfold ? 1 : 0;
    result.not_kept += chosen.kept ? 0 : 1;
  }
  return result;
}

}  // namespace

TEST_CASE("Estimated errors of a resolution hold on random load cases", "[core][load][discretisation]") {
  const Honesty found = honesty(1000, 20, 6.0, {.accuracy = 0.05, .most_intervals = 24, .most_positions = 64});
  CAPTURE(found.within, found.over_tenfold, found.not_kept);
  CHECK(found.within >= 19);  // 95 %: differences may cancel by chance
  CHECK(found.over_tenfold <= 5);
}

TEST_CASE("Estimated errors of a resolution hold on 200 random load cases", "[core][load][discretisation][.soak]") {
  const Honesty found = honesty(0, 200, 15.0, {.accuracy = 0.01});
  WARN("within " << found.within << " of " << found.drawn << ", honest " << found.honest << ", over tenfold " << found.over_tenfold << ", not kept "
                 << found.not_kept);
  CHECK(found.within >= 190);  // 95 %: differences may cancel by chance
  CHECK(found.over_tenfold <= 50);
}

TEST_CASE("A line that is loaded evenly needs no more than the fewest intervals", "[core][load][discretisation]") {
  // Aligned, unmodified spur flanks without free ends: the load is the same along the line, whatever the quadrature.
  const LoadCase even{mesh_cases::pair(20, 40, 0, 4, 30), {}, 200e3};
  const MeshOfResolution endless = [&](const MeshResolution& resolution) {
    return mesh_cases::model(even.gears, resolution, MeshEffects::all_but({"free_ends"}));
  };
  const DiscretisationSearch search{.accuracy = 0.01};
  const Discretisation chosen = choose_discretisation(endless, QuadratureRule::Graded, even.condition, even.torque, search);
  CHECK(chosen.quadrature.intervals == search.fewest_intervals);
  constexpr double kRoundOff = 1e-9;
  CHECK(largest(chosen.quadrature_error) < kRoundOff);
  CHECK(largest(chosen.position_error) > kRoundOff);  // teeth come and go between positions
}

TEST_CASE("More accuracy never takes a coarser resolution, and what is kept is within it", "[core][load][discretisation]") {
  const LoadCase drawn = random_case(7, 6.0);
  int cost = 0;
  for (double accuracy : {0.3, 0.1, 0.03}) {
    const Discretisation chosen = choose_discretisation(drawn.mesh(), QuadratureRule::Graded, drawn.condition, drawn.torque, {.accuracy = accuracy});
    CAPTURE(accuracy, chosen.quadrature.intervals, chosen.positions);
    CHECK(chosen.kept == (headline(chosen.error()) <= accuracy));
    CHECK(chosen.quadrature.intervals * chosen.positions >= cost);
    cost = chosen.quadrature.intervals * chosen.positions;
  }
}

TEST_CASE("Intervals or positions that are not to be chosen stay as given", "[core][load][discretisation]") {
  const LoadCase drawn = random_case(3, 6.0);
  const DiscretisationSearch search{.accuracy = 0.05, .fewest_intervals = 5, .choose_intervals = false};
  const Discretisation chosen = choose_discretisation(drawn.mesh(), QuadratureRule::Gauss2, drawn.condition, drawn.torque, search);
  CHECK(chosen.quadrature.rule == QuadratureRule::Gauss2);
  CHECK(chosen.quadrature.intervals == 5);
  CHECK(largest(chosen.quadrature_error) == 0.0);  // what is given counts as exact
  CHECK(chosen.positions >= search.fewest_positions);
}

TEST_CASE("Load cases sought together keep what each of them needs, whoever solves them", "[core][load][discretisation]") {
  // One pair, evenly loaded and tilted: the tilted one needs more.
  const GearPair gears = mesh_cases::pair(20, 40, 15, 4, 30);
  FlankCondition tilted;
  tilted.misalignment.mesh_misalignment = 15 * units::um;
  tilted.modification.pinion.lead_crowning = 5 * units::um;
  const LoadCase easy{gears, {}, mesh_cases::torque_for(gears, 300)}, hard{gears, tilted, mesh_cases::torque_for(gears, 60)};
  const std::vector<ResolutionCase> cases{{easy.mesh(), easy.condition, easy.torque}, {hard.mesh(), hard.condition, hard.torque}};
  DiscretisationSearch search{.accuracy = 0.02};
  const Discretisation both = choose_discretisation(cases, QuadratureRule::Graded, search);
  REQUIRE(both.kept);
  CHECK(headline(both.error()) <= search.accuracy);
  for (const LoadCase* each : {&easy, &hard}) {
    const Discretisation alone = choose_discretisation(each->mesh(), QuadratureRule::Graded, each->condition, each->torque, search);
    CHECK(both.quadrature.intervals * both.positions >= alone.quadrature.intervals * alone.positions);
  }
  // The last first: no bit depends on the order.
  search.for_each = [](std::size_t count, const std::function<void(std::size_t)>& work) {
    for (std::size_t i = count; i > 0; --i) work(i - 1);
  };
  const Discretisation turned = choose_discretisation(cases, QuadratureRule::Graded, search);
  CHECK(turned.error() == both.error());
  CHECK(turned.governing == both.governing);
}

TEST_CASE("Errors of other causes leave a resolution less", "[core][load][discretisation]") {
  const LoadCase drawn = random_case(7, 6.0);
  const auto sought = [&](double spent) {
    DiscretisationSearch search{.accuracy = 0.1};
    search.spent.fill(spent);
    return choose_discretisation(drawn.mesh(), QuadratureRule::Graded, drawn.condition, drawn.torque, search);
  };
  const Discretisation whole = sought(0.0), less = sought(0.095);
  REQUIRE((whole.kept && less.kept));
  CHECK(headline(less.error()) <= std::sqrt(0.1 * 0.1 - 0.095 * 0.095));
  CHECK(less.quadrature.intervals * less.positions >= whole.quadrature.intervals * whole.positions);
}
