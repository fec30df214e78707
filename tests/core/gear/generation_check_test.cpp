#include "core/gear/generation_check.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/gear/rack_envelope.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/common/random.hpp"

using namespace flankwright;
using units::deg;

namespace {

PairData data_of(int teeth, double helix_angle) {
  PairData data;
  data.normal_module = 3.0;
  data.helix_angle = helix_angle;
  data.pinion.teeth = teeth;
  data.wheel.teeth = 47;
  data.pinion.face_width = data.wheel.face_width = 20.0;
  return data;
}

std::vector<std::string> fields(const PairData& data) {
  std::vector<std::string> names;
  for (const InvalidInput& problem : find_problems(data)) names.push_back(problem.field());
  return names;
}

/// Marks of a section that has been accepted, over the whole of what must be generated.
template <class Section>
void check_regular(const Section& section, const Gear& gear) {
  const RollingCircle circle(gear);
  const GeneratedRange range(gear, GeneratedRange::regular_margin);
  for (int i = 0; i <= 24; ++i) {
    const double rho = range.active + i / 24.0 * (range.highest - range.active);
    for (int k = 0; k <= 6; ++k) {
      const double z = k / 6.0 * range.half_width;
      const auto parameter = tool_parameter(section, circle, rho, z);
      REQUIRE(parameter);
      const auto mark = generated_point(section, circle, Dual<1>::variable(*parameter, 0), Dual<1>(z));
      REQUIRE(std::abs(mark.roll.value - rho) <= 1e-13 * (rho + gear.base_radius));
      REQUIRE(mark.roll.gradient[0] > 0.0);
      REQUIRE(mark.deviation.value >= -1e-14);  // round-off
    }
  }
}

}  // namespace

TEST_CASE("The largest parabola coefficient is a cusp at the start of the active profile", "[core][gear]") {
  const int teeth = GENERATE(17, 30, 80);
  const double helix_angle = GENERATE(0.0, 20.0) * deg;
  PairData data = data_of(teeth, helix_angle);
  const double limit = largest_parabola_coefficient(make_gear_pair(data).pinion, data);
  CAPTURE(teeth, helix_angle, limit);
  data.pinion.generation = ParabolicRack{0.999 * limit};
  CHECK(fields(data).empty());
  const GearPair pair = make_gear_pair(data);
  const ParabolicSection section(ParabolicRack{0.999 * limit}, data);
  check_regular(section, pair.pinion);
  for (const double factor : {1.001, 1.1, 2.0, 10.0}) {
    data.pinion.generation = ParabolicRack{factor * limit};
    CHECK(fields(data) == std::vector<std::string>{"pinion.generation.coefficient"});
  }
}

TEST_CASE("At the spur limit the curvatures of rack and rolling meet", "[core][gear][closed-form]") {
  const PairData data = data_of(20, 0.0);
  const Gear gear = make_gear_pair(data).pinion;
  const double a = largest_parabola_coefficient(gear, data);
  const RollingCircle circle(gear);
  const auto u = tool_parameter(ParabolicSection({a}, data), circle, GeneratedRange(gear, GeneratedRange::regular_margin).active, 0.0);
  REQUIRE(u);
  // The envelope has a cusp where r sin(alpha*) + l - kappa l^2 = 0 (Euler-Savary), alpha* the rack's pressure angle there, l the
  // distance from the pitch point.
  const double alpha = data.pressure_angle, star = alpha + std::atan(2 * a * *u);
  const double l = (*u * std::cos(alpha) - a * *u * *u * std::sin(alpha)) / std::sin(star);
  const double kappa = 2 * a / std::pow(1 + 4 * a * a * *u * *u, 1.5);
  // The root of a double zero: accurate to the square root of round-off.
  CHECK(std::abs(gear.reference_radius * std::sin(star) + l - kappa * l * l) <= 1e-5);
}

TEST_CASE("Accepted tools of revolution generate the whole flank", "[core][gear]") {
  tests::Random32 random(20260501);
  int accepted = 0;
  for (int i = 0; i < 300; ++i) {
    PairData data = data_of(static_cast<int>(random.coarse(14, 60)), 0.0);
    data.pinion.profile_shift = data.pinion.teeth < 20 ? 0.3 : random.coarse(-0.2, 0.4);
    const RevolutionTool tool{random.coarse(30, 89) * deg, std::exp(random.coarse(0.0, 5.0)), std::exp(random.coarse(2.0, 10.0))};
    data.pinion.generation = tool;
    if (!find_problems(data).empty()) continue;
    ++accepted;
    const GearPair pair = make_gear_pair(data);
    CAPTURE(data.pinion.teeth, tool.half_apex / deg, tool.distance, tool.arc_radius);
    check_regular(RevolutionSection(tool, data, data.pinion), pair.pinion);
  }
  CHECK(accepted > 50);
  CHECK(accepted < 290);
}

TEST_CASE("A tool of revolution that is refused is accepted at the limit it is given", "[core][gear]") {
  PairData data = data_of(25, 0.0);
  data.wheel.generation = RevolutionTool{80 * deg, 1.0};
  const std::vector<InvalidInput> small = find_problems(data);
  REQUIRE(small.size() == 1);
  CHECK(small[0].field() == "wheel.generation.distance");
  const double distance = std::stod(small[0].allowed().substr(std::string("at least ").size()));
  CHECK(distance > 1.0);
  data.wheel.generation = RevolutionTool{80 * deg, 1.0001 * distance};
  CHECK(fields(data).empty());
  data.wheel.generation = RevolutionTool{80 * deg, 30.0, 5.0};
  const std::vector<InvalidInput> round = find_problems(data);
  REQUIRE(round.size() == 1);
  CHECK(round[0].field() == "wheel.generation.arc_radius");
  const double radius = std::stod(round[0].allowed().substr(std::string("at least ").size()));
  data.wheel.generation = RevolutionTool{80 * deg, 30.0, 1.0001 * radius};
  CHECK(fields(data).empty());
}

TEST_CASE("Generating tools out of range are refused by field", "[core][gear]") {
  PairData data = data_of(25, 0.0);
  const auto refused = [&](const Generation& generation) {
    data.pinion.generation = generation;
    return fields(data);
  };
  using Names = std::vector<std::string>;
  const double nan = not_given;
  CHECK(refused(StraightRack{}).empty());
  CHECK(refused(ParabolicRack{0.0}).empty());
  CHECK(refused(ParabolicRack{-1e-6}) == Names{"pinion.generation.coefficient"});
  CHECK(refused(ParabolicRack{nan}) == Names{"pinion.generation.coefficient"});
  CHECK(refused(RevolutionTool{0.0, 20.0}) == Names{"pinion.generation.half_apex"});
  CHECK(refused(RevolutionTool{90 * deg, 20.0}) == Names{"pinion.generation.half_apex"});
  CHECK(refused(RevolutionTool{80 * deg, -1.0}) == Names{"pinion.generation.distance"});
  CHECK(refused(RevolutionTool{80 * deg, 20.0, 0.0}) == Names{"pinion.generation.arc_radius"});
  CHECK(refused(RevolutionTool{nan, nan, nan}).size() == 3);
  data.helix_angle = 15 * deg;
  CHECK(refused(RevolutionTool{80 * deg, 20.0}) == Names{"pinion.generation.kind"});
}
