#include "studies/command_line/many_runs.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "core/fidelity/cycle_quantities.hpp"
#include "studies/base/csv.hpp"
#include "studies/base/printable.hpp"
#include "studies/base/progress.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/command_line/finished_run.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/command_line/study_paths.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

/// What the table says of a study.
struct Line {
  std::string study, task, state;
  double seconds{not_given}, contact_ratio{not_given};
  std::vector<double> worst;  ///< of columns(); empty where nothing is loaded
  int exit_code{0};
};

/// The quantities that a run's own table shows.
std::vector<CycleEntry> columns() {
  std::vector<CycleEntry> shown;
  for (const CycleEntry& entry : cycle_entries()) {
    if (!entry.quantity->heading.empty() && entry.order <= 1) shown.push_back(entry);
  }
  return shown;
}

/// The worst of the load cases of the final design; NaN where none has it.
double worst_of(const StudyResults& results, const CycleEntry& entry) {
  double worst = not_given;
  for (const LoadedResult& loaded : results.loaded) {
    const double value = loaded.design == "before" ? not_given : entry.value(loaded.summary);
    if (std::isnan(worst) || (entry.quantity->smaller_is_worse ? value < worst : value > worst)) worst = value;
  }
  return worst;
}

Line run_one(const fs::path& path, const fs::path& folder, const RunOptions& options, const ProgressReport& report) {
  Line line;
  line.study = path.stem().string();
  line.state = "wrong input";
  line.exit_code = 2;
  try {
    const Study study = read_study(path.string(), options.overrides);
    line.task = study.task->name;
    make_folder(folder);
    const FinishedRun run = finish_study(study, folder, report);
    write_files(run, folder);
    for (const std::string& requirement : run.results.requirements) spdlog::error("{}: {}", line.study, requirement);
    line.state = run.met() ? "done" : run.different.empty() ? "not met" : "not as expected";
    line.exit_code = run.met() ? 0 : 1;
    line.seconds = run.results.seconds;
    line.contact_ratio = run.results.pair.total_contact_ratio();
    for (const CycleEntry& column : columns()) line.worst.push_back(worst_of(run.results, column));
  } catch (const InvalidInput& problem) {
    spdlog::error("{}", printable(problem.what(), "\n"));
  }
  return line;
}

std::string table_of(const std::vector<Line>& lines) {
  std::size_t width = 5;
  for (const Line& line : lines) width = std::max(width, line.study.size());
  std::string table = fmt::format("{:<{}}  {:<9} {:<15} {:>8} {:>10}", "study", width, "task", "state", "s", "eps_gamma");
  std::string units = fmt::format("{:<{}}  {:<9} {:<15} {:>8} {:>10}", "", width, "", "", "", "");
  for (const CycleEntry& column : columns()) {
    table += fmt::format("  {:>10}", std::string(column.quantity->heading));
    units += fmt::format("  {:>10}", std::string(column.quantity->unit));
  }
  table += "\n" + units + "\n";
  const auto number = [](double value, int decimals) { return std::isnan(value) ? std::string() : fmt::format("{:.{}f}", value, decimals); };
  for (const Line& line : lines) {
    table += fmt::format("{:<{}}  {:<9} {:<15} {:>8} {:>10}", printable(line.study), width, line.task, line.state, number(line.seconds, 1),
                         number(line.contact_ratio, 3));
    for (std::size_t i = 0; i < line.worst.size(); ++i) table += fmt::format("  {:>10}", number(line.worst[i], columns()[i].quantity->decimals));
    while (table.ends_with(' ')) table.pop_back();
    table += "\n";
  }
  return table;
}

std::string csv_of(const std::vector<Line>& lines) {
  std::string csv = "study,task,state,seconds,total_contact_ratio";
  for (const CycleEntry& column : columns()) csv += fmt::format(",{}", column.key());
  csv += "\n";
  for (const Line& line : lines) {
    csv += fmt::format("{},{},{},{},{}", csv_field(line.study), line.task, line.state, csv_field(line.seconds), csv_field(line.contact_ratio));
    for (std::size_t i = 0; i < columns().size(); ++i) csv += fmt::format(",{}", i < line.worst.size() ? csv_field(line.worst[i]) : std::string());
    csv += "\n";
  }
  return csv;
}

}  // namespace

int run_folder(const RunOptions& options) {
  if (!options.shard.empty()) throw InvalidInput("--shard", options.study, "a study file: shards are parts of one sweep");
  const std::vector<fs::path> studies = collect_studies({options.study});
  if (studies.empty()) throw InvalidInput("study", options.study, "a study file, or a folder with *.toml files");
  const fs::path folder = options.folder.empty() ? fs::path("results") : fs::path(options.folder);
  make_folder(folder);
  std::vector<Line> lines;
  int exit_code = 0;
  Progress progress;
  for (const fs::path& study : studies) {
    const std::string which = fmt::format("{}/{} {}: ", lines.size() + 1, studies.size(), printable(study.stem().string()));
    lines.push_back(run_one(study, folder / study.stem(), options, progress.report(which)));
    exit_code = std::max(exit_code, lines.back().exit_code);
  }
  progress.finish();
  write_whole(folder / "studies.csv", csv_of(lines));
  print(table_of(lines));
  print(fmt::format("\ntable: {}\n", (folder / "studies.csv").string()));
  return exit_code;
}

}  // namespace flankwright::studies
