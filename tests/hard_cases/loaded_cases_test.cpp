#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/hard_cases/hard_case.hpp"

using namespace flankwright;
using namespace flankwright::hard_cases;
using units::um;

namespace {

const studies::Override sampled_peaks{"cycle.peaks", "sampled"};

double largest_difference(const LoadedCycle& a, const LoadedCycle& b) {
  return (a.transmission_error() - b.transmission_error()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("Hard: misalignment passes through zero without a step", "[hard_cases][slow]") {
  constexpr double kRoundOff = 1e-13;  // mm
  for (double amount = 1.0; amount > 1e-13; amount *= 0.01) {
    const auto results = run("misalignment_through_zero", {{"scenes.0.misalignment.mesh_misalignment", in_digits(-amount)},
                                                           {"scenes.2.misalignment.mesh_misalignment", in_digits(amount)},
                                                           sampled_peaks});
    check_balances(results);
    CAPTURE(amount);
    REQUIRE(results.loaded.size() == 3);
    const LoadedCycle &minus = results.loaded[0].cycle, &aligned = results.loaded[1].cycle, &plus = results.loaded[2].cycle;
    CHECK(largest_difference(minus, plus) <= kRoundOff);
    // No gap changes by more than half the amount, and f_t by no more than the gaps do.
    CHECK(largest_difference(minus, aligned) <= 0.5 * amount * um + kRoundOff);
    const double load = results.loaded[1].summary.peak_line_load;
    for (const std::size_t i : {0u, 2u}) {
      // One micrometre moves the peak by some N/mm per um; in proportion to it below.
      CHECK(std::abs(results.loaded[i].summary.peak_line_load - load) <= 0.2 * load * amount + 1e-9 * load);
    }
    for (const std::size_t i : {0u, 2u}) {
      const double te = results.unloaded[i].mesh.largest - results.unloaded[1].mesh.largest;
      CHECK(std::abs(te) * results.pair.wheel.base_radius <= 0.5 * amount * um + kRoundOff);
    }
    CHECK(std::abs(results.unloaded[0].mesh.largest - results.unloaded[2].mesh.largest) <= 1e-12);  // rad
  }
}

TEST_CASE("Hard: a single contact point obeys its closed form", "[hard_cases]") {
  const auto results = run("single_contact_point");
  check_balances(results);
  const studies::LoadedResult& loaded = results.loaded.front();
  const MeshModel& model = results.models[loaded.model];
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadedPosition& position = loaded.cycle.positions[i];
    CAPTURE(position.phase);
    REQUIRE(at.points.size() == 1);
    const double w = loaded.cycle.force / at.weight[0];
    CHECK(std::abs(position.load.line_load[0] / w - 1.0) <= 1e-14);
    const double approach = position.gap.total[0] + at.influence(0, 0) * at.weight[0] * w + at.laws[0].deflection(w);
    CHECK(std::abs(position.load.transmission_error / approach - 1.0) <= 1e-14);
  }
}

TEST_CASE("Hard: over twelve decades of torque loads balance and f_t rises", "[hard_cases]") {
  std::string torques = "[0.0002";
  for (double torque = 0.002; torque < 3e8; torque *= 10.0) torques += ", " + in_digits(torque);
  const auto results = run("torque_of_twelve_decades", {{"load.torque", torques + "]"}, sampled_peaks});
  check_balances(results);
  REQUIRE(results.loaded.size() == 13);
  for (std::size_t i = 0; i < results.loaded.front().cycle.positions.size(); ++i) {
    const auto approach = [&](std::size_t torque) {
      const LoadedPosition& position = results.loaded[torque].cycle.positions[i];
      return position.load.transmission_error - position.gap.total.minCoeff();
    };
    for (std::size_t torque = 1; torque < results.loaded.size(); ++torque) CHECK(approach(torque) > approach(torque - 1));
    CHECK(approach(0) > 0.0);
    CHECK(approach(0) <= 1e-3 * approach(6));  // 1e-6 of the torque; less than in proportion, as contact grows
  }
}

TEST_CASE("Hard: a tooth that stands back carries nothing, however far", "[hard_cases]") {
  const auto back_by = [](double amount) {
    std::string pitch = "[0, " + in_digits(-amount);
    for (int i = 2; i < 22; ++i) pitch += ", 0";
    return run("unloaded_tooth", {{"pinion.error.pitch", pitch + "]"}, sampled_peaks});
  };
  const auto results = back_by(300.0), further = back_by(900.0), in_line = back_by(0.0);
  check_balances(results);
  check_balances(in_line);
  const MeshModel& model = results.models.front();
  bool would_carry = false;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const auto& points = model.positions[i].points;
    const LoadedPosition &one = results.loaded.front().cycle.positions[i], &two = further.loaded.front().cycle.positions[i];
    CHECK(one.load.transmission_error == two.load.transmission_error);
    CHECK(one.load.line_load == two.load.line_load);
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (points[j].tooth != 1) continue;
      CHECK(one.load.line_load[static_cast<Eigen::Index>(j)] == 0.0);
      would_carry = would_carry || in_line.loaded.front().cycle.positions[i].load.line_load[static_cast<Eigen::Index>(j)] > 0.0;
    }
  }
  CHECK(would_carry);
}

TEST_CASE("Hard: reliefs far beyond the deflection leave one pair in contact", "[hard_cases]") {
  const auto teeth_in_contact = [](const studies::StudyResults& results) {
    std::vector<std::ptrdiff_t> counts;
    for (std::size_t i = 0; i < results.models.front().positions.size(); ++i) {
      const std::vector<double> all = shares(results.models.front(), results.loaded.front().cycle, i);
      counts.push_back(std::ranges::count_if(all, [](double share) { return share > 0.0; }));
    }
    return counts;
  };
  const auto results = run("relief_beyond_deflection", {sampled_peaks}),
             half = run("relief_beyond_deflection", {sampled_peaks, {"load.torque", "25"}});
  check_balances(results);
  check_balances(half);
  const auto counts = teeth_in_contact(results), of_half = teeth_in_contact(half);
  CHECK(std::ranges::count(counts, 1) >= 8);
  for (std::size_t i = 0; i < counts.size(); ++i) CHECK(of_half[i] <= counts[i]);
}

TEST_CASE("Hard: an edge that runs along its mate before the path begins carries load", "[hard_cases]") {
  const std::string gap = GENERATE("plane_of_action", "whole_surface");
  const auto results = run("edge_before_the_path", {{"load.torque", "[1e-9, 40]"}, {"fidelity.gap", gap}, {"cycle.positions", "16"}, sampled_peaks});
  check_balances(results);
  CAPTURE(gap);
  const FlankAssembly scene = assemble_flanks(results.pair, {.modification = results.study.modification});
  const PathOfContact path(results.pair);
  const LoadedCycle &light = results.loaded[0].cycle, &heavy = results.loaded[1].cycle;
  double on_edge = 0.0;  // N/mm
  for (std::size_t i = 0; i < light.positions.size(); ++i) {
    const MeshPosition& at = results.models[results.loaded[1].model].positions[i];
    const double phi1 = path.pinion_angle_at(at.phase, results.pair);
    double te = -1.0;
    for (int tooth = -3; tooth <= 5; ++tooth) {
      const ToothContact contact = find_tooth_contact(scene, tooth, phi1);
      if (contact.exists()) te = std::max(te, contact.transmission_error);
    }
    // The first touch, by edges too. Model: the plane of action has it where undisturbed flanks touch, the relief of 80 um moves it.
    const double lag = -te * results.pair.wheel.base_radius, smallest = light.positions[i].gap.total.minCoeff();
    CAPTURE(at.phase, lag, smallest);
    CHECK(std::abs(smallest - lag) <= (gap == "whole_surface" ? 1e-11 : 0.03 * 80.0 * um));
    for (std::size_t j = 0; j < at.points.size(); ++j) {
      if (at.points[j].phase < path.before) on_edge = std::max(on_edge, heavy.positions[i].load.line_load[static_cast<Eigen::Index>(j)]);
    }
  }
  CHECK(on_edge > 0.1 * results.loaded[1].summary.peak_line_load);
}

TEST_CASE("Hard: quadrature points that nearly coincide share their load evenly", "[hard_cases]") {
  const Settings settings{sampled_peaks, {"cycle.positions", "3"}};
  Settings single = settings;
  single.push_back({"fidelity.quadrature.intervals", "1"});
  const auto results = run("nearly_equal_points", settings), few = run("nearly_equal_points", single);
  check_balances(results);
  // 3 um of face over the shaft's length: what bends within it, relative to what bends.
  constexpr double kModel = 1e-4;
  CHECK(largest_difference(results.loaded.front().cycle, few.loaded.front().cycle) <= kModel * few.loaded.front().summary.te_mean);
  const MeshModel& model = results.models.front();
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const Eigen::VectorXd& loads = results.loaded.front().cycle.positions[i].load.line_load;
    const auto& points = model.positions[i].points;
    for (std::size_t j = 1; j < points.size(); ++j) {
      if (points[j].tooth != points[j - 1].tooth) continue;
      const auto row = static_cast<Eigen::Index>(j);
      CHECK(std::abs(loads[row] - loads[row - 1]) <= kModel * loads.maxCoeff());
    }
  }
}

TEST_CASE("Hard: faces that a tilt moves past each other touch nowhere, and it is said so", "[hard_cases]") {
  // The wheel's rim, some 76 mm from its axis, moves along the face by 60 arcmin of it, 1.3 mm: the faces are 0.7 mm wide.
  const auto tilted_by = [](const std::string& minutes) {
    return run("any_face_width", {{"pinion.face_width", "0.7"},
                                  {"wheel.face_width", "0.7"},
                                  {"fidelity.gap", "whole_surface"},
                                  {"fidelity.effects", "auto"},
                                  {"misalignment.intersecting", minutes},
                                  sampled_peaks});
  };
  const auto apart = tilted_by("-60");
  for (const LoadedPosition& position : apart.loaded.front().cycle.positions) CHECK(position.load.status == LoadStatus::NoContactPoints);
  const UnloadedMesh& mesh = apart.unloaded.front().mesh;
  CHECK(mesh.missing > 0);
  CHECK(std::isnan(mesh.peak_to_peak));
  REQUIRE(apart.requirements.size() == 2);
  CHECK(apart.requirements[0].find("no tooth pair touches") != std::string::npos);
  CHECK(apart.requirements[1].find("no point of the flanks can touch the mate") != std::string::npos);
  const auto still_facing = tilted_by("-20");
  CHECK(still_facing.loaded.front().cycle.usable());
  CHECK(still_facing.unloaded.front().mesh.missing == 0);
}
