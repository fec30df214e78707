#include "studies/command_line/commands.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

#include "studies/command_line/finished_run.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/command_line/study_paths.hpp"
#include "studies/results/accepted_expectations.hpp"
#include "studies/results/expectations.hpp"
#include "studies/base/progress.hpp"
#include "studies/study/task.hpp"
#include "studies/report/report.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/governing_cases.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/analysis/study_notes.hpp"
#include "studies/tasks/study_template.hpp"
#include "studies/tasks/sweep/run_sweep.hpp"
#include "studies/tasks/sweep/shards.hpp"
#include "studies/results/tables.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

/// Writes what was found beside a study, into a copy that no folder of studies takes for one of them.
std::string accept_beside(const fs::path& path, const Study& study, const Json& results) {
  const AcceptedStudy accepted = accept_results(read_whole(path), study.expect, results);
  const fs::path copy = path.string() + ".accepted";
  write_whole(copy, accepted.text);
  std::string text = fmt::format("  {} value{} of today in {}\n", accepted.values, accepted.values == 1 ? "" : "s", copy.string());
  for (const std::string& kept : accepted.kept) text += "  not accepted:" + kept.substr(1);
  return text;
}

/// One tested study: its line, and whether everything was met.
struct TestLine {
  std::string text;
  bool met{true};
  bool bad_input{false};
};

TestLine test_study(const fs::path& path, bool accept) {
  try {
    const Study study = read_study(path.string());
    if (study.expect.empty()) return {fmt::format("none  {}  (no [expect] table)\n", path.string())};
    StudyResults results = run_study(study);
    if (study.task->run_in_folder != nullptr) study.task->run_in_folder(results, {}, {});
    const Json document = results_document(results);
    const std::vector<Comparison> comparisons = compare(study.expect, document);
    const std::string different = differences(comparisons);
    std::string text = fmt::format("{}  {}  ({} expectation{}, {:.1f} s)\n", different.empty() ? "met " : "DIFF", path.string(), comparisons.size(),
                                   comparisons.size() == 1 ? "" : "s", results.seconds);
    return {text + different + (accept ? accept_beside(path, study, document) : ""), different.empty()};
  } catch (const InvalidInput& problem) {
    return {fmt::format("BAD   {}\n{}\n", path.string(), problem.what()), false, true};
  }
}

/// The study of a command, and the folder for its results, which is made.
std::pair<Study, fs::path> opened(const RunOptions& options) {
  const Study study = read_study(options.study, options.overrides);
  const fs::path folder = options.folder.empty() ? fs::path("results") / fs::path(options.study).stem() : fs::path(options.folder);
  make_folder(folder);
  spdlog::info("{} ({})", study.title, options.study);
  return {study, folder};
}

/// Notes, tables and what is not met, of a run whose files are written. @returns the exit code
int tell(const FinishedRun& run, const fs::path& folder) {
  for (const std::string& note : run.results.notes) spdlog::warn("{}", note);
  print(summary_table(run.results));
  if (!run.different.empty()) print(fmt::format("\nnot as [expect] says:\n{}", run.different));
  print(fmt::format("\nreport: {}\n", (folder / "report.html").string()));
  flush_standard_output();
  for (const std::string& requirement : run.results.requirements) spdlog::error("{}", requirement);
  return run.met() ? 0 : 1;
}

int run_shard(const Study& study, const fs::path& folder, Shard shard, const ProgressReport& report) {
  const StudyResults nominal = run_study(study, report);
  const fs::path file = folder / shard_file(shard);
  make_folder(file.parent_path());
  run_sweep_shard(nominal, file, shard, report);
  print(fmt::format("shard: {}\n", file.string()));
  return 0;
}

}  // namespace

int run_command(const RunOptions& options) {
  const std::optional<Shard> shard = options.shard.empty() ? std::nullopt : std::optional(parse_shard(options.shard));
  const auto [study, folder] = opened(options);
  if (shard && study.task != &find_task("sweep")) throw InvalidInput("--shard", study.task->name, "a study of the task \"sweep\"");
  Progress progress;
  const ProgressReport report = progress.report();
  if (shard) return run_shard(study, folder, *shard, report);
  FinishedRun run = finish_study(study, folder, report);
  if (run.results.loaded.size() > most_cases_with_points) report("writing files", 0, 1, "");
  write_files(run, folder);
  progress.finish();
  const int exit_code = tell(run, folder);
  keep_until_exit(std::move(run));
  return exit_code;
}

int merge_command(const RunOptions& options) {
  const auto [study, folder] = opened(options);
  if (study.task != &find_task("sweep")) throw InvalidInput("task", study.task->name, "\"sweep\": shards are parts of a sweep");
  StudyResults results = run_study(study);
  merge_shards(folder, study, SampleAnalysis(results).outputs());
  run_sweep(results, folder, {});
  const FinishedRun run = finished(std::move(results));
  write_files(run, folder);
  return tell(run, folder);
}

int check_command(const std::string& path, const std::vector<Override>& overrides) {
  const Study study = read_study(path, overrides);
  print(fmt::format("{}: valid, task {}, {} scene{}\n", path, study.task->name, study.scenes.size(), study.scenes.size() == 1 ? "" : "s"));
  const GearPair pair = make_gear_pair(study.pair);
  if (const std::string backlash = backlash_in_words(pair); !backlash.empty()) print(backlash + "\n");
  flush_standard_output();
  for (const std::string& note : study_notes(study, pair)) spdlog::warn("{}", note);
  return 0;
}

int new_command(const std::string& kind) {
  print(study_template(kind));
  return 0;
}

int report_command(const std::string& folder) {
  const fs::path page = fs::path(folder) / "report.html";
  write_whole(page, render_report(whole_results(folder)));
  print(fmt::format("report: {}\n", page.string()));
  return 0;
}

int test_command(const std::vector<std::string>& paths, bool accept) {
  const std::vector<fs::path> studies = collect_studies(paths);
  if (studies.empty()) throw InvalidInput("test", "no study", "folders with *.toml files, or study files");
  std::vector<TestLine> lines(studies.size());
  Progress progress;
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(std::size_t{0}, studies.size(), [&](std::size_t i) {
    lines[i] = test_study(studies[i], accept);
    const std::lock_guard lock(mutex);
    progress.show("testing", ++done, static_cast<int>(studies.size()), studies[i].filename().string());
  });
  progress.finish();
  bool met = true, bad_input = false;
  for (const TestLine& line : lines) {
    print(line.text);
    met = met && line.met;
    bad_input = bad_input || line.bad_input;
  }
  return bad_input ? 2 : met ? 0 : 1;
}

}  // namespace flankwright::studies
