#include "studies/command_line/finished_run.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <utility>
#include <vector>

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
  return run;
}

FinishedRun finish_study(const Study& study, const std::filesystem::path& folder, const ProgressReport& progress) {
  StudyResults results = run_study(study, progress);
  if (study.task->run_in_folder != nullptr) study.task->run_in_folder(results, folder, progress);
  return finished(std::move(results));
}

void write_files(const FinishedRun& run, const std::filesystem::path& folder) {
  const auto write_tables = [&](const std::vector<NamedText>& tables) {
    for (const NamedText& table : tables) write_whole(folder / table.name, table.text);
  };
  tbb::parallel_invoke([&] { write_whole(folder / "report.html", render_report(run.document)); },
                       [&] { write_whole(folder / "results.json", json_text(run.document)); },
                       [&] {
                         write_tables(csv_tables(run.results));
                         if (const auto write = run.results.study.task->write_files) write(run.results, folder);
                       },
                       [&] { write_tables(report_tables(run.document)); });
}

void discard(FinishedRun run) {
  const auto loaded = run.document.find("loaded");
  if (loaded == run.document.end() || !loaded->is_array()) return;
  auto& cases = loaded->get_ref<Json::array_t&>();
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) { cases[i] = nullptr; });
}

}  // namespace flankwright::studies
