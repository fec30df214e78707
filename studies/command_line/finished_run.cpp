#include "studies/command_line/finished_run.hpp"

#include <tbb/parallel_invoke.h>

#include <future>
#include <mutex>
#include <utility>
#include <vector>

#include "studies/analysis/governing_cases.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/report/report.hpp"
#include "studies/results/expectations.hpp"
#include "studies/results/report_tables.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"

namespace flankwright::studies {

FinishedRun finished(StudyResults results) {
  FinishedRun run{std::move(results), {}, {}};
  run.document = results_document(run.results);
  run.different = differences(compare(run.results.study.expect, run.document));
  if (!run.different.empty()) run.document["not_as_expected"] = run.different;
  return run;
}

FinishedRun finish_study(const Study& study, const std::filesystem::path& folder, const ProgressReport& progress) {
  StudyResults results = run_study(study, progress);
  if (study.task->run_in_folder != nullptr) study.task->run_in_folder(results, folder, progress);
  if (progress && results.loaded.size() > most_cases_with_points) progress("gathering results", 0, 1, "");
  return finished(std::move(results));
}

namespace {

/// Writes files beside the threads that make their texts: a write ends when the disk has it.
class FilesOfAFolder {
 public:
  explicit FilesOfAFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& name, std::string text) {
    const std::lock_guard lock(adding_);
    written_.push_back(std::async(std::launch::async, [file = folder_ / name, text = std::move(text)] { write_whole(file, text); }));
  }
  void add(std::vector<NamedText> tables) {
    for (NamedText& table : tables) add(table.name, std::move(table.text));
  }
  /// @throws InvalidInput of the first that could not be written
  void wait() {
    for (std::future<void>& file : written_) file.get();
  }

 private:
  std::filesystem::path folder_;
  std::mutex adding_;
  std::vector<std::future<void>> written_;  // a future waits for its file before it goes
};

}  // namespace

void write_files(const FinishedRun& run, const std::filesystem::path& folder) {
  FilesOfAFolder files(folder);
  tbb::parallel_invoke([&] { files.add("report.html", render_report(run.document)); }, [&] { files.add("results.json", json_text(run.document)); },
                       [&] {
                         files.add(csv_tables(run.results));
                         if (const auto write = run.results.study.task->write_files) write(run.results, folder);
                       },
                       [&] { files.add(report_tables(run.document)); });
  files.wait();
}

void keep_until_exit(FinishedRun run) {
  static auto& kept = *new std::vector<FinishedRun>();  // never destroyed
  kept.push_back(std::move(run));
}

}  // namespace flankwright::studies
