#include "studies/tasks/optimise/results_store.hpp"

#include <unistd.h>

#include <cmath>
#include <string>
#include <system_error>

#include "core/base/error.hpp"
#include "studies/base/database.hpp"
#include "studies/base/version.hpp"
#include "studies/tasks/optimise/listed_scenes.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

// The values of `run` have no type of their own: text and numbers stay what they are.
constexpr const char* tables = R"(
CREATE TABLE run (key TEXT PRIMARY KEY, value);
CREATE TABLE variables (path TEXT PRIMARY KEY, unit TEXT, lower REAL, upper REAL, before REAL, after REAL);
CREATE TABLE scenes (name TEXT, torque_Nm REAL, weight REAL, before REAL, after REAL);
CREATE TABLE history (evaluation INTEGER PRIMARY KEY, objective REAL, constraint_violation REAL);
CREATE TABLE constraints (name TEXT, unit TEXT, minimum REAL, maximum REAL, before REAL, after REAL);
)";

void add_run(Database& database, const StudyResults& results) {
  const DesignResult& design = optimised(results).design;
  const DesignTask& task = optimised(results).task;
  Statement insert(database, "INSERT INTO run VALUES (?, ?)");
  insert.row("title", results.study.title);
  insert.row("task", "optimise");
  insert.row("version", version());
  insert.row("file", results.study.file);
  insert.row("seconds", results.seconds);
  insert.row("objective", task.objective_name());
  insert.row("objective_unit", task.objective_unit());
  insert.row("over", to_string(task.over));
  insert.row("objective_before", design.before.objective);
  insert.row("objective_after", design.after.objective);
  insert.row("solver", design.solver);
  insert.row("formulation", design.formulation);
  insert.row("status", to_string(design.status));
  insert.row("message", design.message);
  insert.row("evaluations", design.evaluations);
  insert.row("gradient_evaluations", design.gradient_evaluations);
  insert.row("failures", design.failures);
  insert.row("rounds", design.rounds);
  insert.row("solver_seconds", design.seconds);
}

void add_tables(Database& database, const StudyResults& results) {
  const DesignResult& design = optimised(results).design;
  const DesignTask& task = optimised(results).task;
  Statement variables(database, "INSERT INTO variables VALUES (?, ?, ?, ?, ?, ?)");
  for (std::size_t i = 0; i < task.variables.size(); ++i) {
    const DesignVariable& v = task.variables[i];
    variables.row(v.path, v.unit(), v.outside(v.lower), v.outside(v.upper), v.outside(design.before.variables[i]),
                  v.outside(design.after.variables[i]));
  }
  Statement scenes(database, "INSERT INTO scenes VALUES (?, ?, ?, ?, ?)");
  const ListedScenes listed(task);
  for (const std::size_t s : listed.indices()) {
    const DesignScene& scene = task.scenes[s];
    scenes.row(scene.name, listed.torque(scene), listed.weight(scene), design.before.scene_measures[s], design.after.scene_measures[s]);
  }
  Statement history(database, "INSERT INTO history VALUES (?, ?, ?)");
  for (const SolverStep& step : design.history) {
    history.row(step.evaluation, step.objective, step.constraint_violation);
  }
  Statement constraints(database, "INSERT INTO constraints VALUES (?, ?, ?, ?, ?, ?)");
  const auto bound = [](double limit, double factor) { return std::isfinite(limit) ? limit * factor : not_given; };
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const OutputConstraint& of = task.constraints[c];
    const double factor = of.output.outside_factor();
    constraints.row(of.output.name, of.output.unit(), bound(of.minimum, factor), bound(of.maximum, factor),
                    design.before.constraint_values[c] * factor, design.after.constraint_values[c] * factor);
  }
  for (std::size_t c = 0; c < task.modification_constraints.size(); ++c) {
    const ModificationConstraint& of = task.modification_constraints[c];
    const double factor = of.outside_factor();
    constraints.row(of.name, of.unit(), bound(of.minimum, factor), bound(of.maximum, factor), design.before.modification_values[c] * factor,
                    design.after.modification_values[c] * factor);
  }
}

/// A file that is removed when this goes, unless it was moved to its place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& place) : place_(place), path_(place.string() + ".tmp" + std::to_string(::getpid())) { remove(); }
  ~TemporaryFile() { remove(); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return path_; }
  void move_to_place() {
    std::error_code error;
    fs::rename(path_, place_, error);
    if (error) throw InvalidInput("output folder", place_.string(), "a place that can be written (" + error.message() + ")");
  }

 private:
  void remove() const {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }

  fs::path place_, path_;
};

}  // namespace

void write_results_store(const fs::path& file, const StudyResults& results) {
  TemporaryFile temporary(file);
  {
    Database database(temporary.path(), file);
    // Nothing to roll back to in a file that is thrown away on failure, hence no journal beside it.
    database.execute("PRAGMA journal_mode = OFF; PRAGMA synchronous = FULL; BEGIN;");
    database.execute(tables);
    add_run(database, results);
    add_tables(database, results);
    database.execute("COMMIT");
  }
  temporary.move_to_place();
}

}  // namespace flankwright::studies
