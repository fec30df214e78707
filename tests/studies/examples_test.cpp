#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/results/expectations.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/command_line.hpp"

namespace flankwright::studies {
namespace {

std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const char* folder : {"/studies/examples", "/studies/examples/tutorial"}) {
    for (const auto& entry : std::filesystem::directory_iterator(std::string(FLANKWRIGHT_SOURCE_DIR) + folder)) {
      if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Coarser than the example itself, so that each takes a second at most.
const std::vector<std::string> reduced{"--set", "fidelity.quadrature.intervals=4",
                                       "--set", "cycle.positions=8",
                                       "--set", "cycle.peaks=sampled",
                                       "--set", "sweep.samples=110",
                                       "--set", "accuracy.finest.compliance=thin_slice",
                                       "--set", "accuracy.finest.gap=plane_of_action",
                                       "--set", "accuracy.finest.intervals=8",
                                       "--set", "accuracy.finest.positions=16"};

}  // namespace

TEST_CASE("Every example is valid, meets its expectations and runs without a complaint", "[studies][examples][slow]") {
  REQUIRE(examples().size() >= 3);
  const command_line::ScratchFolder folder;
  for (const std::string& file : examples()) {
    CAPTURE(file);
    CHECK(command_line::run(folder, {"check", file}).exit_code == 0);
    if (read_study(file).task == &find_task("fit")) continue;  // finite elements: a minute, below
    std::vector<std::string> arguments{"run", file};
    // One that says its own phases is judged at these.
    if (read_study(file).cycle.phases.empty()) arguments.insert(arguments.end(), reduced.begin(), reduced.end());
    const command_line::Ending ending = command_line::run(folder, arguments);
    CAPTURE(ending.out, ending.err);
    CHECK(ending.exit_code == 0);
    // One example shows on purpose how a designed parabola is lost.
    const bool is_parabola = file.ends_with("/parabolic-te.toml");
    // Some gears are said to need finite elements of their own.
    const auto outside =
        occurrences(ending.err, "warning: the pinion is outside the library") + occurrences(ending.err, "warning: the wheel is outside the library");
    // Of 110 samples Sobol indices are uncertain.
    const auto uncertain = occurrences(ending.err, "warning: The Sobol indices come from");
    // Contact on tip edges is said, once a study.
    const auto on_edges = ending.err.find("the tip edge of the") != std::string::npos ? 1 : 0;
    // Where the design of a transmission error has its highest stress there, that is said as well.
    const auto loads_edge = occurrences(ending.err, "warning: the highest contact stress of the design found");
    // Of a lead modification without a process it is said what grinding would make of it.
    const auto unground =
        occurrences(ending.err, "warning: the pinion's process is \"none\"") + occurrences(ending.err, "warning: the wheel's process is \"none\"");
    // So is a lead that the tool does not follow.
    const auto steep = occurrences(ending.err, "warning: of the design found, the ");
    // Of many load cases it is said which have their contact points, and of shafts under axial force what holds them where the example does not say.
    const auto of_many = occurrences(ending.err, "governing load cases of"), held = occurrences(ending.err, "to hold it rigidly along its axis");
    CHECK(occurrences(ending.err, "warning") - outside - uncertain - on_edges - loads_edge - unground - steep - of_many - held ==
          (is_parabola ? 1 : 0));
    CHECK(occurrences(ending.err, "\"beyond its limit\": the designed parabola") == (is_parabola ? 1 : 0));
  }
}

TEST_CASE("The fit of the example converges and meets what the study expects of it", "[.soak][studies][examples][fit]") {
  const command_line::ScratchFolder folder;
  const command_line::Ending ending = command_line::run(folder, {"run", FLANKWRIGHT_SOURCE_DIR "/studies/examples/fit-18.toml", "--out", "fit"});
  CAPTURE(ending.out, ending.err);
  CHECK(ending.exit_code == 0);
  CHECK(folder.names("fit") == std::vector<std::string>{"deflection_curves.csv", "fit_pinion.csv", "fit_residuals.csv", "gears.csv", "given.csv",
                                                        "report.html", "results.json", "used.csv"});
}

TEST_CASE("The robust example beats its start in the worst scene, and scenes become alike", "[studies][examples][physics]") {
  const Study study =
      read_study(FLANKWRIGHT_SOURCE_DIR "/studies/examples/helical-18-54.toml", {{"cycle.positions", "8"}, {"fidelity.quadrature.intervals", "4"}});
  const StudyResults results = run_study(study);
  REQUIRE(results.found<OptimiseResults>() != nullptr);
  const DesignReport &before = optimised(results).design.before, &after = optimised(results).design.after;
  CHECK(after.objective < 0.9 * before.objective);
  const auto [least, most] = std::minmax_element(after.scene_measures.begin(), after.scene_measures.end());
  const auto [least_before, most_before] = std::minmax_element(before.scene_measures.begin(), before.scene_measures.end());
  CHECK(*most - *least < 0.5 * (*most_before - *least_before));
}

TEST_CASE("The robust example takes a quarter off the worst stress, the quiet one nine tenths off the first harmonic",
          "[.soak][studies][examples][physics]") {
  const auto run = [](const char* name) { return run_study(read_study(std::string(FLANKWRIGHT_SOURCE_DIR "/studies/examples/") + name + ".toml")); };
  const StudyResults robust = run("robust-18-54");
  CHECK(optimised(robust).design.status == SolverStatus::Converged);
  CHECK(optimised(robust).design.runs.front().evaluations <= 150);
  CHECK(optimised(robust).design.after.objective <= 0.75 * optimised(robust).design.before.objective);
  CHECK(optimised(robust).design.optimality.residual <= 1e-6);
  const StudyResults quiet = run("quiet-18-54");
  CHECK(optimised(quiet).design.status == SolverStatus::Converged);
  CHECK(optimised(quiet).design.after.objective <=
        0.1 * optimised(quiet).design.before.scene_measures.front());  // the worst against the aligned pair
  CHECK(optimised(quiet).design.optimality.residual <= 1e-4);
}

TEST_CASE("The unloaded examples are at their published figures, at any number of positions", "[studies][examples][slow]") {
  for (const char* name : {"nasa-30-100", "nasa-30-100-parabolic-rack", "nasa-20-40-crowned", "parabolic-te", "real-17-44-longitudinal",
                           "real-17-44-three-dimensional", "real-17-44-one-sided-helix"}) {
    for (const char* positions : {"16", "32"}) {
      CAPTURE(name, positions);
      const Study study = read_study(std::string(FLANKWRIGHT_SOURCE_DIR "/studies/examples/") + name + ".toml", {{"cycle.positions", positions}});
      CHECK_FALSE(study.expect.empty());
      CHECK(differences(compare(study.expect, results_document(run_study(study)))) == "");
    }
  }
}

}  // namespace flankwright::studies
