#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/tasks/optimise/results_store.hpp"

#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <memory>

#include "core/base/error.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/small_file_limit.hpp"
#include "tests/studies/small_studies.hpp"
#include "studies/analysis/run_study.hpp"

namespace flankwright::studies {
namespace {

using command_line::ScratchFolder;
using Row = std::vector<std::string>;

/// Rows of a query, every cell as SQLite prints it, NULL as "NULL".
std::vector<Row> query(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* opened = nullptr;
  REQUIRE(sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, sqlite3_close);
  std::vector<Row> rows;
  const auto add = [](void* to, int columns, char** cells, char**) {
    Row row;
    for (int i = 0; i < columns; ++i) row.emplace_back(cells[i] == nullptr ? "NULL" : cells[i]);
    static_cast<std::vector<Row>*>(to)->push_back(row);
    return 0;
  };
  CAPTURE(sql);
  REQUIRE(sqlite3_exec(database.get(), sql.c_str(), add, &rows, nullptr) == SQLITE_OK);
  return rows;
}

double number(const std::filesystem::path& file, const std::string& sql) {
  const std::vector<Row> rows = query(file, sql);
  REQUIRE(rows.size() == 1);
  return std::stod(rows.front().front());
}

const StudyResults& small_optimisation() {
  static const StudyResults results = run_study(parse_study(small::optimisation(), "small.toml"));
  return results;
}

}  // namespace

TEST_CASE("The store of an optimisation agrees with the results", "[studies][results][store]") {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "results.sqlite";
  const StudyResults& results = small_optimisation();
  const DesignResult& design = optimised(results).design;
  write_results_store(file, results);

  CHECK(query(file, "PRAGMA integrity_check") == std::vector<Row>{{"ok"}});
  CHECK(query(file, "SELECT value FROM run WHERE key = 'title'") == std::vector<Row>{{"small optimisation"}});
  CHECK(query(file, "SELECT value FROM run WHERE key IN ('task', 'file', 'solver', 'status', 'over') ORDER BY key") ==
        std::vector<Row>{{"small.toml"}, {"worst"}, {"nlopt:slsqp"}, {to_string(design.status)}, {"optimise"}});
  CHECK(number(file, "SELECT value FROM run WHERE key = 'evaluations'") == design.evaluations);
  CHECK(number(file, "SELECT value FROM run WHERE key = 'objective_after'") == Approx(design.after.objective).epsilon(1e-14));

  // Units of the report: um for amounts, mm for extents, N·m for torques. Tolerances are SQLite's 15 digits.
  constexpr double round_off = 1e-14;
  CHECK(query(file, "SELECT unit, lower, upper FROM variables WHERE path = 'pinion.modification.lead_slope'") ==
        std::vector<Row>{{"um", "-20.0", "20.0"}});
  CHECK(query(file, "SELECT unit, lower, upper FROM variables WHERE path LIKE '%length'") == std::vector<Row>{{"mm", "5.0", "30.0"}});
  for (const DesignVariable& v : optimised(results).task.variables) {
    const auto i = static_cast<std::size_t>(&v - optimised(results).task.variables.data());
    const std::string where = " FROM variables WHERE path = '" + v.path + "'";
    const double factor = std::string(v.unit()) == "um" ? 1e3 : 1.0;
    CHECK(number(file, "SELECT before" + where) == Approx(factor * design.before.variables[i]).epsilon(round_off));
    CHECK(number(file, "SELECT after" + where) == Approx(factor * design.after.variables[i]).epsilon(round_off));
  }
  CHECK(query(file, "SELECT name, torque_Nm, weight FROM scenes") ==
        std::vector<Row>{{"aligned", "1014.868", "1.0"}, {"bent", "1014.868", "2.0"}, {"bent back", "1014.868", "1.0"}});
  CHECK(number(file, "SELECT max(after) FROM scenes") == Approx(design.after.objective).epsilon(round_off));
  CHECK(number(file, "SELECT count(*) FROM history") == static_cast<double>(design.history.size()));
  // The search's own view, by half the intervals and then at the positions: discretisation.
  CHECK(number(file, "SELECT min(objective) FROM history WHERE constraint_violation <= 1e-6") == Approx(design.after.objective).epsilon(0.05));
  CHECK(query(file, "SELECT name, unit, minimum, maximum FROM constraints") == std::vector<Row>{{"te_peak_to_peak", "um", "NULL", "5.0"}});
}

TEST_CASE("Least values and sums of modifications are among the constraints", "[studies][results][store]") {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "results.sqlite";
  const StudyResults results = run_study(parse_study(small::optimisation() + R"(
effective_contact_ratio = { min = 1.5 }
"pinion.modification.lead_crowning + pinion.modification.end_relief.amount" = { min = 1, max = 30 }
)",
                                                     "small.toml"));
  write_results_store(file, results);
  CHECK(query(file, "SELECT name, unit, minimum, maximum FROM constraints ORDER BY rowid") ==
        std::vector<Row>{{"effective_contact_ratio", "1", "1.5", "NULL"},
                         {"te_peak_to_peak", "um", "NULL", "5.0"},
                         {"pinion.modification.lead_crowning + pinion.modification.end_relief.amount", "um", "1.0", "30.0"}});
  constexpr double round_off = 1e-12;
  CHECK(
      number(file, "SELECT after FROM constraints WHERE maximum = 30") ==
      Approx(number(file, "SELECT sum(after) FROM variables WHERE path LIKE '%lead_crowning' OR path LIKE '%end_relief.amount'")).epsilon(round_off));
}

TEST_CASE("Texts with quotes and numbers that were not computed survive the store", "[studies][results][store]") {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "results.sqlite";
  StudyResults results = small_optimisation();
  results.study.title = "Robert'); DROP TABLE run; -- \"ß\"";
  OptimiseResults found = optimised(results);
  found.design.history.front().objective = not_given;
  results.set_found(std::make_shared<const OptimiseResults>(found));
  write_results_store(file, results);
  CHECK(query(file, "SELECT value FROM run WHERE key = 'title'") == std::vector<Row>{{results.study.title}});
  CHECK(query(file, "SELECT objective FROM history WHERE evaluation = 1") == std::vector<Row>{{"NULL"}});
}

TEST_CASE("A store replaces the one before it whole and leaves nothing beside it", "[studies][results][store]") {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "results.sqlite";
  write_results_store(file, small_optimisation());
  write_results_store(file, small_optimisation());
  CHECK(number(file, "SELECT count(*) FROM scenes") == 3.0);
  CHECK(folder.names() == std::vector<std::string>{"results.sqlite"});
  {
    const SmallFileLimit limit(3000);
    CHECK_THROWS_AS(write_results_store(file, small_optimisation()), InvalidInput);
  }
  CHECK(number(file, "SELECT count(*) FROM scenes") == 3.0);
  CHECK(folder.names() == std::vector<std::string>{"results.sqlite"});
}

TEST_CASE("A store that cannot be written is refused with the folder's name", "[studies][results][store]") {
  const ScratchFolder folder;
  folder.file("file", "text");
  std::filesystem::create_directory(folder.path() / "taken");
  for (const char* place : {"no-such-folder/results.sqlite", "file/results.sqlite", "taken"}) {
    CAPTURE(place);
    try {
      write_results_store(folder.path() / place, small_optimisation());
      FAIL("was written");
    } catch (const InvalidInput& problem) {
      CHECK(problem.field() == "output folder");
      CHECK_THAT(problem.value(), Catch::EndsWith(place));
    }
  }
  CHECK(folder.names() == std::vector<std::string>{"file", "taken"});
}

}  // namespace flankwright::studies
