#include "studies/tasks/optimise/drawn_scenes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/studies/study_texts.hpp"
#include "tests/common/about.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

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
    CHECK(scene.error.pinion.twist == Approx(3.0 * units::um).epsilon(1e-14));  // as the study has it; round-off
    CHECK(scene.torques == study.scenes.front().torques);
    CHECK(scene.weight == 1.0);
  }
  // Means of a low-discrepancy sequence: errors of about 1 / samples of the range; sampling error.
  CHECK(mean == tests::about(4.0 * units::um, 0.02 * units::um));
  CHECK(std::sqrt(squares - mean * mean) == Approx(6.0 * units::um).epsilon(0.01));
  CHECK(helix == Approx(10.0 * units::um).epsilon(0.01));
  CHECK(tilt == tests::about(0.0, 0.005 * largest_tilt));
}

TEST_CASE("A draw has a scene in each operating state, with the same drawn values", "[studies][assessment][scatter]") {
  const std::string scenes = R"(
[[scenes]]
name = "drive"
[[scenes]]
name = "drive, bent"
misalignment.mesh_misalignment = 9
pinion.error.twist = 5
weight = 2
[[scenes]]
name = "coast"
working_flank = "left"
load.torque = 120
misalignment.intersecting = -2
)";
  const Study study = tolerant_study(scenes);
  const std::vector<OperatingState> states = operating_states(study, study.tolerances);
  REQUIRE(states.size() == 2);  // misalignment, errors and weights make none
  CHECK(states[0].scene.name == "drive");
  CHECK(states[0].weight == 1.0);
  CHECK(states[1].scene.name == "coast");
  CHECK(states[1].weight == Approx(1.0 / 3.0).epsilon(1e-14));  // round-off
  const std::vector<Scene> drawn = draw_scenes(study, {16, 1});
  REQUIRE(drawn.size() == 2 * 16);
  const double apart = 4.0 * units::arcmin;  // of the listed scenes; the drawn tilt is added to either
  for (std::size_t i = 0; i < 16; ++i) {
    const Scene &drive = drawn[2 * i], &coast = drawn[2 * i + 1];
    CHECK(drive.draw == static_cast<int>(i));
    CHECK(coast.draw == static_cast<int>(i));
    CHECK(drive.torques == study.scenes[0].torques);
    CHECK(coast.torques == study.scenes[2].torques);
    CHECK(coast.working_flank == WorkingFlank::Left);
    CHECK(drive.misalignment.mesh_misalignment == coast.misalignment.mesh_misalignment);
    CHECK(drive.error.pinion.helix_slope == coast.error.pinion.helix_slope);
    CHECK(drive.misalignment.intersecting - coast.misalignment.intersecting == Approx(apart).epsilon(1e-12));
  }
  // A torque that is drawn is the same in both: they differ in nothing but the flank.
  const std::string torque = "\n[optimise.tolerances]\n\"load.torque\" = { uniform = [100, 300] }\n",
                    two = "[[scenes]]\n[[scenes]]\nload.torque = 120\n";
  const Study of_torque = study_texts::read(torque + two);
  CHECK(operating_states(of_torque, of_torque.tolerances).size() == 1);
  CHECK(operating_states(of_torque, {}).size() == 2);
}

TEST_CASE("A draw that a key does not accept is refused before the run", "[studies][assessment]") {
  const auto with_torque = [](const std::string& distribution) {
    return "[optimise]\nobjective = \"peak_contact_stress\"\nover = \"worst\"\n[load]\ntorque = 300\n[optimise.variables]\n"
           "\"pinion.modification.lead_crowning\" = [0, 10]\n[optimise.validation]\nsamples = 1000\n[optimise.tolerances]\n\"load.torque\" = " +
           distribution + "\n";
  };
  const std::vector<Override> optimises{{"task", "\"optimise\""}};
  CHECK_NOTHROW(study_texts::read(with_torque("{ truncated_normal = [300, 200, 0, 900] }"), optimises));
  CHECK_NOTHROW(study_texts::read(with_torque("{ normal = [300, 50] }"), optimises));
  const StudyProblem negative = study_texts::problem_of(with_torque("{ normal = [300, 200] }"), optimises);  // 6.7 % of that lie below 0
  CHECK(negative.key == "optimise.tolerances.load.torque");
  CHECK(negative.line == 23);
  CHECK(negative.allowed.find("of 1000 has -") != std::string::npos);
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
