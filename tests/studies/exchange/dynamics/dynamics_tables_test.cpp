#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/exchange/dynamics/dynamics_tables.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"

namespace flankwright::studies {

namespace {

std::string study_text(const std::string& more) {
  return R"(title = "drive"
[pair]
normal_module = 3
helix_angle = 15
[pinion]
teeth = 9
face_width = 30
modification = { lead_crowning = 6, tip_relief = { amount = 30, height = 2, shape = "parabolic" } }
[wheel]
teeth = 13
face_width = 30
[load]
torque = 120
[fidelity]
compliance = "thin_slice"
effect_sizes = "off"
quadrature = { rule = "graded", intervals = 6 }
[cycle]
positions = 16
)" + more;
}

DynamicsRun excitation(const std::string& more) {
  const StudyResults results = run_study(parse_study(study_text(more), "drive.toml"));
  return mesh_excitation(results_document(results), "results.json", StoredFlanks::Final);
}

double te_at(const std::string& more, const std::string& torque) {
  return run_study(parse_study(study_text(more), "drive.toml", {{"load.torque", torque}}))
      .loaded.front()
      .cycle.positions.front()
      .load.transmission_error;
}

double force_at(const std::string& torque) {
  return run_study(parse_study(study_text(""), "drive.toml", {{"load.torque", torque}})).loaded.front().cycle.force;
}

}  // namespace

TEST_CASE("The excitation has the transmission error of the results and stiffness along the flank normal", "[studies][dynamics]") {
  const StudyResults results = run_study(parse_study(study_text(""), "drive.toml"));
  const DynamicsRun run = mesh_excitation(results_document(results), "results.json", StoredFlanks::Final);
  REQUIRE(run.cases.size() == 1);
  const MeshExcitation& of = run.cases.front();
  REQUIRE(of.cycle.size() == 16);
  for (std::size_t i = 0; i < of.cycle.size(); ++i) {
    CHECK(of.cycle[i].transmission_error == results.loaded.front().cycle.positions[i].load.transmission_error);  // the same analysis, bit for bit
  }
  // The tangent stiffness by two analyses at neighbouring torques: discretisation of order step^2.
  const double difference = (force_at("120.01") - force_at("119.99")) / (te_at("", "120.01") - te_at("", "119.99"));
  CHECK(of.cycle.front().tangent_stiffness == Approx(difference).epsilon(1e-5));
  // Contact stiffens with the load and more points come to carry: from first touch the secant lies below the tangent.
  for (const auto& position : of.cycle) CHECK(position.secant_stiffness < position.tangent_stiffness);
  // Where flanks touch at f_t = min(g), force over approach is what the results have per mm of face, transverse.
  const LoadedPosition& first = results.loaded.front().cycle.positions.front();
  const double approach = first.load.transmission_error - first.gap.total.minCoeff();
  CHECK(of.cycle.front().secant_stiffness == Approx(of.normal_force / approach).epsilon(1e-12));  // round-off
}

TEST_CASE("Without errors of single teeth there is no table of a revolution, and a word about it", "[studies][dynamics]") {
  const DynamicsRun run = excitation("");
  CHECK(run.cases.front().revolution.empty());
  REQUIRE(run.notes.size() == 1);
  CHECK(dynamics_files(run).size() == 3);
}

TEST_CASE("Over a wheel revolution the pitch errors of both gears come round", "[studies][dynamics]") {
  // Entry 3 of the pinion's nine is that of the tooth six pitches behind the reference pair, entry 10 of the wheel's thirteen three pitches behind.
  const DynamicsRun run =
      excitation("[pinion.error]\npitch = [0, 0, 0, -12, 0, 0, 0, 0, 0]\n[wheel.error]\npitch = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0]\n");
  const DynamicsRun perfect = excitation("");
  const MeshExcitation& of = run.cases.front();
  REQUIRE(of.revolution.size() == 13 * 16);
  std::vector<std::size_t> disturbed;
  for (std::size_t pitch = 0; pitch < 13; ++pitch) {
    double largest = 0.0;
    for (std::size_t i = 0; i < 16; ++i) {
      CHECK(of.revolution[16 * pitch + i].phase == Approx(static_cast<double>(pitch) + static_cast<double>(i) / 16.0).epsilon(1e-15));
      largest = std::max(largest, std::abs(of.revolution[16 * pitch + i].transmission_error - perfect.cases.front().cycle[i].transmission_error));
    }
    if (largest > 0.05 * units::um) disturbed.push_back(pitch);
  }
  // A pair is in mesh from its entry on for less than three pitches.
  CHECK(disturbed.front() == 3);
  CHECK(disturbed.back() <= 8);
  CHECK(std::ranges::find(disturbed, std::size_t{6}) != disturbed.end());
  CHECK(dynamics_files(run).size() == 4);
}

TEST_CASE("Harmonics are those of a known sum of cosines", "[studies][dynamics]") {
  std::vector<double> phases, values;
  for (int i = 0; i < 16; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 16.0;
    phases.push_back(i / 16.0);
    values.push_back(5.0 + 2.0 * std::cos(turn + 0.3) + 0.5 * std::cos(3.0 * turn - 1.2));
  }
  const std::vector<ExcitationHarmonic> harmonics = excitation_harmonics(phases, values, 10);
  REQUIRE(harmonics.size() == 7);  // 16 positions resolve no more
  CHECK(harmonics[0].amplitude == Approx(2.0).epsilon(1e-14));
  CHECK(harmonics[0].angle == Approx(0.3).epsilon(1e-13));
  CHECK(harmonics[2].amplitude == Approx(0.5).epsilon(1e-13));
  CHECK(harmonics[2].angle == Approx(-1.2).epsilon(1e-13));
  CHECK(std::abs(harmonics[1].amplitude) < 1e-14);  // round-off of the sum
}

TEST_CASE("What has no excitation is refused with the reason", "[studies][dynamics]") {
  CHECK_THROWS_AS(mesh_excitation(Json::object(), "results.json", StoredFlanks::Final), InvalidInput);
  const StudyResults unloaded = run_study(parse_study(study_text(""), "drive.toml", {{"load.torque", "0"}}));
  CHECK_THROWS_AS(mesh_excitation(results_document(unloaded), "results.json", StoredFlanks::Final), InvalidInput);
  const StudyResults phases = run_study(parse_study(study_text(""), "drive.toml", {{"cycle.phases", "[0, 0.5]"}}));
  CHECK_THROWS_AS(mesh_excitation(results_document(phases), "results.json", StoredFlanks::Final), InvalidInput);
}

}  // namespace flankwright::studies
