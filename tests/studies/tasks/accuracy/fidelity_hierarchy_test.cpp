#include "studies/tasks/accuracy/fidelity_hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "studies/tasks/accuracy/accuracy_json.hpp"
#include "studies/tasks/accuracy/accuracy_tables.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

/// A pair by thin slices, coarse enough for a fraction of a second.
std::string hierarchy_text(double helix_angle_deg, const std::string& modification = "", const std::string& fidelity = "") {
  return R"(task = "accuracy"
[pair]
normal_module = 4
helix_angle = )" +
         std::to_string(helix_angle_deg) +
         R"(
[pinion]
teeth = 20
face_width = 30
[pinion.modification]
)" + modification +
         R"(
[wheel]
teeth = 40
face_width = 30
[load]
torque = 200
[cycle]
positions = 12
[fidelity]
compliance = "thin_slice"
)" + fidelity +
         R"(
[accuracy.finest]
compliance = "thin_slice"
gap = "plane_of_action"
intervals = 8
positions = 48
)";
}

FidelityHierarchy hierarchy_of(double helix_angle_deg, const std::string& modification = "", const std::string& fidelity = "") {
  const StudyResults results = run_study(parse_study(hierarchy_text(helix_angle_deg, modification, fidelity), "levels.toml"));
  REQUIRE(results.requirements.empty());
  REQUIRE(results.found<FidelityHierarchy>() != nullptr);
  return *results.found<FidelityHierarchy>();
}

const HierarchyStep& step(const FidelityHierarchy& hierarchy, const std::string& name) {
  const auto found = std::ranges::find_if(hierarchy.steps, [&](const HierarchyStep& s) { return s.result.level.name == name; });
  REQUIRE(found != hierarchy.steps.end());
  return *found;
}

double error(const HierarchyStep& step, Figure figure) { return step.error[static_cast<std::size_t>(figure)]; }

}  // namespace

TEST_CASE("The finest level has no error, every other one has its own, and these fall with intervals and positions",
          "[studies][accuracy][levels][slow]") {
  const FidelityHierarchy hierarchy = hierarchy_of(20.0, "lead_crowning = 6\n");
  CHECK(largest(hierarchy.reference.error) == 0.0);
  CHECK(hierarchy.reference.best);
  for (const HierarchyStep& s : hierarchy.steps) {
    CAPTURE(s.result.level.name);
    CHECK(s.result.usable());
    CHECK(s.result.seconds > 0.0);
    CHECK(s.first_seconds == s.result.seconds);  // thin slices keep nothing
    CHECK(std::isfinite(largest(s.error)));
  }
  // Rigid teeth yield by the flanks' contact alone, less than half of what the mesh does.
  CHECK(error(step(hierarchy, "rigid"), Figure::TeMean) > 0.5);
  CHECK(error(step(hierarchy, "rigid"), Figure::TeMean) < 1.0);

  CHECK(error(step(hierarchy, "graded 4"), Figure::PeakLineLoad) <= error(step(hierarchy, "graded 2"), Figure::PeakLineLoad));
  // Integrals over lines and over the cycle are close from the start, and need not come closer with every step.
  constexpr double discretisation = 2e-3;
  for (const char* level : {"graded 2", "graded 4"}) CHECK(error(step(hierarchy, level), Figure::TeMean) < discretisation);
  for (const char* level : {"12 positions", "24 positions"}) {
    CHECK(error(step(hierarchy, level), Figure::TeHarmonic1) < discretisation);
    CHECK(error(step(hierarchy, level), Figure::TePeakToPeak) <
          error(step(hierarchy, "peaks of the positions"), Figure::TePeakToPeak) + discretisation);
  }
  // Ends of lines within intervals cost more than intervals that end there.
  CHECK(error(step(hierarchy, "gauss2 5"), Figure::TePeakToPeak) > error(step(hierarchy, "graded 4"), Figure::TePeakToPeak));
}

TEST_CASE("Without modification, misalignment and free ends spur lines carry evenly: quadrature has no error",
          "[studies][accuracy][levels][closed-form]") {
  const FidelityHierarchy hierarchy = hierarchy_of(0.0, "", R"(effects = ["bending", "hertzian_contact", "tip_corner", "extended_contact_region"])");
  constexpr double kRoundOff = 1e-9;
  const HierarchyStep& at_positions = step(hierarchy, "peaks of the positions");  // as rules of fixed points have the transmission error
  for (const HierarchyStep& s : hierarchy.steps) {
    const FidelityLevel& level = s.result.level;
    const bool quadrature_only = level.kind == ErrorKind::Discretisation && level.positions == 48 && level.located_peaks;
    CAPTURE(level.name);
    if (!quadrature_only) continue;
    for (std::size_t i = 0; i < s.error.size(); ++i) {
      const bool has_extremes = level.quadrature.rule == QuadratureRule::Graded || i != static_cast<std::size_t>(Figure::TePeakToPeak);
      CHECK(std::abs(s.error[i] - (has_extremes ? 0.0 : at_positions.error[i])) < kRoundOff);
    }
  }
  // The finest's peak line load is the force over the usable face width of one tooth pair.
  const GearPair pair = make_gear_pair(
      parse_study("[pair]\nnormal_module = 4\n[pinion]\nteeth = 20\nface_width = 30\n[wheel]\nteeth = 40\nface_width = 30\n", "spur.toml").pair);
  const double force = 200e3 / pair.pinion.base_radius;
  CHECK(hierarchy.reference.result.scenes[0][Figure::PeakLineLoad] == Approx(force / pair.pinion.face.width()).epsilon(kRoundOff));
}

TEST_CASE("The finest level has the transmission error of an analysis with its settings, extremes between the positions included",
          "[studies][accuracy][levels]") {
  const FidelityHierarchy hierarchy = hierarchy_of(0.0);  // of spur gears, whose extremes lie at kinks
  const StudyResults alone = run_study(parse_study(hierarchy_text(0.0), "alone.toml",
                                                   {{"task", "analyse"},
                                                    {"cycle.positions", "48"},
                                                    {"fidelity.gap", "plane_of_action"},
                                                    {"fidelity.quadrature", "{ rule = \"graded\", intervals = 8 }"}}));
  const double shown = alone.loaded.front().summary.te_peak_to_peak;
  CHECK(hierarchy.reference.result.scenes[0][Figure::TePeakToPeak] == Approx(shown).epsilon(1e-12));
  CHECK(error(step(hierarchy, "peaks of the positions"), Figure::TePeakToPeak) > 1e-3);
}

TEST_CASE("A level as good as another in cost and error, and better in one, keeps that one from the front", "[studies][accuracy][levels]") {
  CHECK(pareto_best({1, 2, 3, 2}, {5, 3, 4, 3}) == std::vector<bool>{true, true, false, true});
  CHECK(pareto_best({1, 1}, {2, 1}) == std::vector<bool>{false, true});
}

TEST_CASE("JSON and tables of a hierarchy name every level once", "[studies][accuracy][levels]") {
  const FidelityHierarchy hierarchy = hierarchy_of(0.0);
  const Json json = hierarchy_json(hierarchy);
  REQUIRE(json.at("rungs").size() == hierarchy.steps.size() + 1);
  CHECK(json.at("rungs").at(0).at("name") == json.at("reference"));
  CHECK(json.at("rungs").at(1).at("error_percent").contains("te_harmonic_5"));
  CHECK(json.at("rungs").at(1).at("outputs").size() == 1);
  const std::vector<NamedText> tables = hierarchy_tables(hierarchy);
  REQUIRE(tables.size() == 2);
  CHECK(std::ranges::count(tables[0].text, '\n') == static_cast<long>(hierarchy.steps.size()) + 2);
}

TEST_CASE("A curve from outside that a level's own is has no difference from it, and a constant more is one of the mean alone",
          "[studies][accuracy][levels]") {
  // Positions of the curve are positions of the finest level; peaks between them do not count.
  const FidelityHierarchy hierarchy = hierarchy_of(20.0);
  FidelityLevel level = hierarchy.reference.result.level;
  const Study study = parse_study(hierarchy_text(20.0), "levels.toml");
  const ProgressReport silent;
  const GearPair pair = make_gear_pair(study.pair);
  LevelRunner runner({.study = study, .pair = pair, .scenes = hierarchy.scenes}, silent);
  constexpr int positions = 6;
  std::vector<double> te;
  const MeshModel model = runner.mesh(level, hierarchy.scenes[0])({level.quadrature, equally_spaced_phases(positions)});
  for (const LoadedPosition& position : analyse_cycle(model, hierarchy.scenes[0].condition, hierarchy.scenes[0].torque).positions)
    te.push_back(position.load.transmission_error);

  constexpr double more = 1.5;  // um
  const auto with_curve = [&](double shift) {
    std::string values;
    for (const double value : te) values += fmt::format("{}{:.17g}", values.empty() ? "" : ", ", value / units::um + shift);
    return hierarchy_of(20.0, "", fmt::format("[accuracy.outside]\nname = \"rig\"\ntransmission_error = [{}]\n", values));
  };
  constexpr double round_off = 1e-10;
  const FidelityHierarchy same = with_curve(0.0), shifted = with_curve(more);
  REQUIRE(same.outside);
  CHECK(same.outside->name == "rig");
  CHECK(same.outside->positions == positions);
  const auto of = [](const HierarchyStep& s, Figure f) { return s.from_outside[static_cast<std::size_t>(f)]; };
  for (const Figure f : {Figure::TeMean, Figure::TePeakToPeak, Figure::TeHarmonic1, Figure::TeHarmonic2}) {
    CAPTURE(name_of(f));
    CHECK(std::abs(of(same.reference, f)) < round_off);
  }
  // The curve's positions do not resolve all harmonics, and it has no stress.
  CHECK(std::isnan(of(same.reference, Figure::TeHarmonic5)));
  CHECK(std::isnan(of(same.reference, Figure::PeakContactStress)));

  const double approach = same.reference.result.scenes[0].mean_approach;
  CHECK(of(shifted.reference, Figure::TeMean) == Approx(-more * units::um / approach).epsilon(1e-9));
  CHECK(std::abs(of(shifted.reference, Figure::TePeakToPeak)) < round_off);
  // The sign: rigid teeth yield less than the finest level.
  CHECK(of(step(same, "rigid"), Figure::TeMean) < -0.5);
  // Fewer positions change nothing where all levels are compared at those of the curve.
  CHECK(std::abs(of(step(same, "12 positions"), Figure::TePeakToPeak)) < round_off);

  const Json json = hierarchy_json(shifted);
  CHECK(json.at("outside").at("te_mean_um").get<double>() == Approx(more + same.outside->value[0] / units::um).epsilon(1e-12));
  CHECK(json.at("rungs").at(0).at("from_outside_percent").at("te_mean").get<double>() == Approx(-100.0 * more * units::um / approach).epsilon(1e-9));
  CHECK_FALSE(json.at("rungs").at(0).at("from_outside_percent").contains("te_harmonic_5"));
  CHECK(hierarchy_tables(shifted)[0].text.find("te_mean_from_outside_percent") != std::string::npos);
  CHECK(hierarchy_json(hierarchy).contains("outside") == false);
}
