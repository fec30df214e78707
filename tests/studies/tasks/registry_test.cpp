#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <set>

#include "studies/analysis/run_study.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/study_template.hpp"

namespace flankwright::studies {

namespace {

/// What the task below finds.
struct Count {
  int teeth{0};
};

void count(StudyRun& run) {
  StudyResults& results = run.results();
  results.set_found(std::make_shared<const Count>(Count{results.pair.pinion.data.teeth + results.pair.wheel.data.teeth}));
  results.notes.push_back("counted");
}

const Task counting_task{.name = "counting",
                         .run = count,
                         .add_json = [](const StudyResults& results, Json& json) { json["teeth_of_both"] = results.found<Count>()->teeth; },
                         .tables = [](const StudyResults&) -> std::vector<NamedText> {
                           return {{"counting.csv", "teeth\n"}};
                         },
                         .summary = [](const StudyResults&) { return std::string("counted\n"); }};

}  // namespace

TEST_CASE("Every task has a name of its own and all that a run needs", "[studies][task]") {
  std::set<std::string> names;
  for (const Task* task : registered_tasks()) {
    CAPTURE(task->name);
    CHECK(names.insert(task->name).second);
    CHECK(&find_task(task->name) == task);
    CHECK(task->run != nullptr);
    CHECK(task->summary != nullptr);
    CHECK(parse_study(study_template(task->name), "template.toml").task == task);
  }
  CHECK_THROWS_AS(find_task("guess"), InvalidInput);
}

TEST_CASE("A new task is one struct and no other code", "[studies][task]") {
  Study study = parse_study(study_template("geometry"), "geometry.toml");
  study.task = &counting_task;
  const StudyResults results = run_study(study);
  CHECK(results.notes.back() == "counted");
  CHECK(summary_table(results) == "counted\n");
  CHECK(csv_tables(results).back().name == "counting.csv");
  const Json json = results_document(results);
  CHECK(json.at("task") == "counting");
  CHECK(json.at("teeth_of_both") == 60);
  CHECK(run_study(parse_study(study_template("geometry"), "geometry.toml")).found<Count>() == nullptr);
}

TEST_CASE("The task geometry analyses nothing and prints the sizes of results.json", "[studies][task]") {
  const StudyResults results = run_study(parse_study(study_template("geometry"), "geometry.toml"));
  CHECK(results.loaded.empty());
  CHECK(results.unloaded.empty());
  CHECK(results.requirements.empty());
  // d = z m_n / cos(beta) with z = 20, m_n = 4 mm, beta = 15 deg.
  const double reference_diameter = 20 * 4 / std::cos(15 * units::deg);
  CHECK(results_document(results).at("geometry").at("pinion").at("reference_diameter_mm").get<double>() ==
        Approx(reference_diameter).epsilon(1e-14));  // round-off
  CHECK_THAT(summary_table(results), Catch::Contains("reference diameter") && Catch::Contains("82.8221") && Catch::Contains("eps_alpha"));
  // An accuracy has nothing that it could be of.
  const StudyResults within =
      run_study(parse_study(study_template("geometry") + "[load]\ntorque = 100\n[fidelity]\naccuracy = \"1 %\"\n", "geometry.toml"));
  CHECK_FALSE(within.fidelity_choice);
  CHECK(within.loaded.empty());
}

}  // namespace flankwright::studies
