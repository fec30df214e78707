#include "studies/command_line/compare_command.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <filesystem>
#include <set>

#include "studies/base/results_folder.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/comparison/comparison_page.hpp"
#include "studies/comparison/comparison_tables.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

/// The last part of the paths where that tells them apart, else all of them.
std::vector<std::string> names_of(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    const fs::path path = fs::path(folder).lexically_normal();
    names.push_back((path.has_filename() ? path.filename() : path.parent_path().filename()).string());
  }
  return std::set(names.begin(), names.end()).size() == names.size() ? names : folders;
}

std::vector<ComparedRun> read_runs(const std::vector<std::string>& folders) {
  const std::vector<std::string> names = names_of(folders);
  std::vector<ComparedRun> runs(folders.size());
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t i) { runs[i] = {names[i], whole_results(folders[i])}; });
  return runs;
}

}  // namespace

int compare_command(const CompareCommand& options) {
  const bool is_limited = !options.tolerance.empty();
  const double tolerance = is_limited ? parse_tolerance(options.tolerance) : not_given;
  const std::vector<ComparedRun> runs = read_runs(options.folders);
  const ComparedRuns compared = compare_runs(runs);
  make_folder(options.folder);
  const fs::path page = fs::path(options.folder) / "comparison.html";
  write_whole(fs::path(options.folder) / "comparison.csv", comparison_csv(runs, compared));
  write_whole(page, comparison_page(runs, compared));
  print(comparison_table(runs, compared));
  const std::vector<std::string> different = is_limited ? differing_lines(runs, compared, tolerance) : std::vector<std::string>();
  if (!different.empty()) print(fmt::format("\nmore than {} from {}\n", options.tolerance, runs.front().name));
  for (const std::string& line : different) print("  " + line + "\n");
  print(fmt::format("\nreport: {}\n", page.string()));
  return different.empty() ? 0 : 1;
}

}  // namespace flankwright::studies
