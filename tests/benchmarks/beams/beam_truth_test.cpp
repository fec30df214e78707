#include <catch2/catch.hpp>

#include "tests/benchmarks/beams/beam_answer.hpp"
#include "tests/benchmarks/calculix.hpp"

using namespace flankwright;
using namespace flankwright::beam_truth;

TEST_CASE("Shafts deflect as CalculiX' beam elements do", "[core][compliance][shaft][calculix]") {
  if (!calculix::is_installed()) {
    WARN("skipped: CalculiX (ccx, Debian package calculix-ccx) is not installed");
    return;
  }
  const BeamCase of = beam_cases()[static_cast<std::size_t>(GENERATE(0, 1))];
  CAPTURE(of.name);
  const auto folder = std::filesystem::temp_directory_path() / ("flankwright_beam_" + std::to_string(std::rand()));
  const BeamAnswer outside = run_calculix(of, 0.125, folder);
  std::filesystem::remove_all(folder);
  REQUIRE(outside.solved);
  const BeamAnswer own = own_answer(of);
  const BeamDifference apart = difference(outside, own);
  // Discretisation and model: of CalculiX' rigid joints where diameters meet about half of it is left at this element length.
  constexpr double asked = 0.01;
  CHECK(apart.deflection < asked);
  CHECK(apart.reaction < asked);
  // Two supports: by the balance of moments, in both.
  if (of.supports.size() == 2) {
    const double second = -of.force * (of.force_position - of.supports[0]) / (of.supports[1] - of.supports[0]);
    CHECK(own.reaction[1] == Approx(second).epsilon(1e-9));      // round-off
    CHECK(outside.reaction[1] == Approx(second).epsilon(1e-5));  // seven digits are printed
  }
}
