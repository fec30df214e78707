#include "studies/tasks/optimise/drawn_scenes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/studies/study_texts.hpp"

namespace flankwright::studies {
namespace {

Study tolerant_study(const std::string& more = "") {
  return study_texts::read(R"(
[load]
torque = 300
[misalignment]
intersecting = 2
[pinion.error]
twist = 3
[optimise.tolerances]
"misalignment.mesh_misalignment" = { normal = [4, 6] }
"pinion.error.helix_slope" = { uniform = [-10, 10] }
"wheel.bearing_clearance" = { clearance = 40, span = 100 }
)" + more);
}

TEST_CASE("Drawn scenes are the nominal one with its toleranced values replaced or added to", "[studies][assessment]") {
  const Study study = tolerant_study();
  constexpr int samples = 2048;
  const std::vector<Scene> scenes = draw_scenes(study, {samples, 1});
  REQUIRE(scenes.size() == samples);
  double mean = 0.0, squares = 0.0, helix = 0.0, tilt = 0.0;
  const double largest_tilt = 0.040 / 100.0;
  for (const Scene& scene : scenes) {
    mean += scene.misalignment.mesh_misalignment / samples;
    squares += std::pow(scene.misalignment.mesh_misalignment, 2) / samples;
    helix = std::max(helix, std::abs(scene.error.pinion.helix_slope));
    tilt += (scene.misalignment.intersecting - 2.0 * units::arcmin) / samples;
    CHECK(std::abs(scene.misalignment.crossing) <= largest_tilt);
    CHECK(std::abs(scene.misalignment.intersecting - 2.0 * units::arcmin) <= largest_tilt * (1.0 + 1e-12));
    CHECK(scene.error.pinion.twist == Approx(3.0 * units::um));  // as the study has it
    CHECK(scene.torques == study.scenes.front().torques);
    CHECK(scene.weight == 1.0);
  }
  // Means of a low-discrepancy sequence: errors of about 1 / samples of the range; sampling error.
  CHECK(mean == Approx(4.0 * units::um).margin(0.02 * units::um));
  CHECK(std::sqrt(squares - mean * mean) == Approx(6.0 * units::um).epsilon(0.01));
  CHECK(helix == Approx(10.0 * units::um).epsilon(0.01));
  CHECK(tilt == Approx(0.0).margin(0.005 * largest_tilt));
}

TEST_CASE("A scene depends on the seed and its number only", "[studies][assessment][determinism]") {
  const Study study = tolerant_study();
  const std::vector<Scene> few = draw_scenes(study, {8, 1}), many = draw_scenes(study, {64, 1}), other = draw_scenes(study, {8, 2});
  for (std::size_t i = 0; i < few.size(); ++i) {
    CHECK(few[i].misalignment == many[i].misalignment);
    CHECK(few[i].misalignment != other[i].misalignment);
    CHECK(few[i].name == many[i].name);
  }
  CHECK(draw_scenes(study, {}).empty());
}

}  // namespace
}  // namespace flankwright::studies
