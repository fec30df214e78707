#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "studies/base/keep_freed_memory.hpp"
#include "studies/base/printable.hpp"
#include "studies/base/version.hpp"
#include "studies/command_line/command_docs.hpp"
#include "studies/command_line/commands.hpp"
#include "studies/command_line/compare_command.hpp"
#include "studies/command_line/docs_command.hpp"
#include "studies/command_line/exchange_commands.hpp"
#include "studies/command_line/library_command.hpp"
#include "studies/command_line/many_runs.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/study_file/key_page.hpp"
#include "studies/study_file/study_schema.hpp"

namespace {

using namespace flankwright;
using namespace flankwright::studies;

constexpr int bad_input = 2, internal_error = 3;

std::vector<Override> overrides_of(const std::vector<std::string>& texts) {
  std::vector<Override> overrides;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw InvalidInput("--set", text, "key.path=value");
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& words) {
  const std::string near = nearest_word(word, words);
  return near.empty() ? "" : "; did you mean " + near + "?";
}

int dispatch(int argc, char** argv) {
  CLI::App app{
      "Flankwright designs the micro-geometry of involute spur and helical gears.\n"
      "A study file goes in; results, pictures and chosen flank modifications come out.\n\n"
      "  flankwright new optimise > my-gear.toml     a commented study to start from\n"
      "  flankwright check my-gear.toml              what is wrong with it, if anything\n"
      "  flankwright run my-gear.toml                results/my-gear/report.html",
      "flankwright"};
  app.set_version_flag("--version", std::string("flankwright ") + version());
  app.require_subcommand(1);

  RunOptions options;
  std::vector<std::string> settings, paths;
  std::string study, kind, folder;
  int threads = 0;
  CLI::App* run = app.add_subcommand("run", "do the study's task; writes results.json, report.html and CSV tables");
  run->footer(
      "Examples:\n"
      "  flankwright run pump.toml                                   results/pump/report.html\n"
      "  flankwright run pump.toml --out today --threads 2\n"
      "  flankwright run pump.toml --set load.torque=250 --set misalignment.crossing=\"3 arcmin\"\n"
      "  flankwright run pump.toml --set scenes.1.load.torque=300    the second scene's\n"
      "  flankwright run gears/                                      every study of the folder, with one table of all");
  run->add_option("study", options.study, "study file (TOML), or a folder of them")->required();
  run->add_option("-o,--out", options.folder, "folder for the results (default: results/ + the study's name); of several studies theirs are in it");
  run->add_option("--threads", threads, "threads to use (default: all cores); results do not depend on it")->check(CLI::Range(1, 1024));
  run->add_option("--set", settings, "key.path=value: overrides the study file, may be repeated")->allow_extra_args(false);
  run->add_option("--shard", options.shard, "k/n: of a sweep the k-th of n parts of the samples alone; `merge` puts them together");
  CLI::App* merge = app.add_subcommand("merge", "put the shards of a sweep together: the results of an unshared run");
  merge->footer(
      "Example:\n"
      "  flankwright merge pump.toml                                 after flankwright run pump.toml --shard 1/3 ... 3/3");
  merge->add_option("study", options.study, "study file of the sweep")->required();
  merge->add_option("-o,--out", options.folder, "folder that the shards were given (default: results/ + the study's name)");
  merge->add_option("--threads", threads, "threads to use")->check(CLI::Range(1, 1024));
  merge->add_option("--set", settings, "key.path=value, as for the shards")->allow_extra_args(false);
  CLI::App* check = app.add_subcommand("check", "read and validate a study; every problem with file:line:column");
  check->footer(
      "Examples:\n"
      "  flankwright check pump.toml                                 pump.toml:12:1: pinion.teeth = 2: allowed is an integer 5 .. 1000\n"
      "  flankwright check pump.toml --set pinion.teeth=17");
  check->add_option("study", study, "study file")->required();
  check->add_option("--set", settings, "key.path=value")->allow_extra_args(false);
  CLI::App* make = app.add_subcommand("new", "print a commented study file");
  make->footer(
      "Examples:\n"
      "  flankwright new analyse > pump.toml                         one pair as it runs\n"
      "  flankwright new optimise > pump.toml                        modifications that hold over many conditions\n"
      "  flankwright new slurm > pump.sbatch                         a job script for the shards of a sweep");
  make->add_option("kind", kind, "analyse, optimise, sweep, accuracy, fit or geometry; slurm: a job script for the shards of a sweep")->required();
  CLI::App* keys = app.add_subcommand("keys", "print the reference of all keys of a study file, in Markdown");
  keys->footer(
      "Examples:\n"
      "  flankwright keys | less\n"
      "  flankwright keys > studies/keys.md                          the page of the repository");
  CLI::App* report = app.add_subcommand("report", "rebuild report.html from a results folder");
  report->footer(
      "Example:\n"
      "  flankwright report results/pump");
  report->add_option("folder", folder, "results folder")->required();
  CompareCommand comparison;
  CLI::App* comparing = app.add_subcommand("compare", "show the results of several runs side by side: a table, comparison.html and comparison.csv");
  comparing->footer(
      "Examples:\n"
      "  flankwright compare results/pump results/pump-2             comparison/comparison.html\n"
      "  flankwright compare before after --tolerance 1%             exit 1 where anything differs by more, with a list of it");
  comparing->add_option("folders", comparison.folders, "results folders, at least two; changes are from the first one")->required()->expected(2, 64);
  comparing->add_option("-o,--out", comparison.folder, "folder for comparison.html and comparison.csv (default: comparison)");
  comparing->add_option("--tolerance", comparison.tolerance, "a percentage; of an entry of a list it counts from the largest of the list");
  CLI::App* test = app.add_subcommand("test", "run studies that have an [expect] table; exit 1 where one differs");
  test->footer(
      "Examples:\n"
      "  flankwright test gears/                                     every study of the folder that has an [expect] table, a line each\n"
      "  flankwright test pump.toml valve.toml");
  test->add_option("paths", paths, "study files or folders of them")->required();
  test->add_option("--threads", threads, "threads to use")->check(CLI::Range(1, 1024));
  bool accept = false;
  test->add_flag("--accept", accept, "write today's values into a copy of each study, FILE.accepted");
  CLI::App* library = app.add_subcommand("library", "make the library of tooth compliance fits anew; goes on where FILE ends");
  library->footer(
      "Example:\n"
      "  flankwright library teeth.txt                               hours; killed, it goes on where the file ends");
  library->add_option("file", study, "file to write")->required();
  library->add_option("--threads", threads, "finite-element runs abreast")->check(CLI::Range(1, 1024));
  ImportCommand from;
  CLI::App* import = app.add_subcommand("import", "make a study of a stage in a REXS file");
  import->footer(
      "Examples:\n"
      "  flankwright import gearbox.rexs                             one stage: its study on stdout; several: they are listed\n"
      "  flankwright import gearbox.rexs --stage 2 --out pump.toml   flank grids of the file go beside pump.toml\n"
      "  flankwright import gearbox.rexsj --helix-slope datum > pump.toml");
  import->add_option("file", from.file, "REXS file, XML or JSON")->required();
  import->add_option("-o,--out", from.study, "study file to write (default: stdout)");
  import->add_option("--stage", from.stage, "which stage, of several: its number, as they are listed without this option");
  import->add_option("--hours", from.hours, "life of the unit in hours, by which load cases with shares of time become a load spectrum");
  import->add_option("--helix-slope", from.slope_end, "face end at which a positive helix_slope removes material")
      ->check(CLI::IsMember({"non-datum", "datum"}));
  ExportCommand to;
  CLI::App* exporting = app.add_subcommand("export", "write what a results folder holds in the formats of other programs");
  exporting->footer(
      "Examples:\n"
      "  flankwright export results/pump --rexs                      results/pump/stage.rexs, after an optimisation with what it found\n"
      "  flankwright export results/pump --rexsj --rexs-version 2.0 --out to-supplier\n"
      "  flankwright export results/pump --grid --grid-points 5x9 --grid-margin 0.05\n"
      "  flankwright export results/pump --vtk                       open results/pump/vtk/contact-1.pvd in ParaView\n"
      "  flankwright export results/pump --dynamics                  transmission error and mesh stiffness for rotor dynamics");
  exporting->add_option("folder", to.results, "results folder")->required();
  exporting->add_option("-o,--out", to.folder, "folder for the files (default: the results folder)");
  exporting->add_flag("--rexs", to.rexs, "stage.rexs: the pair with its flank modifications, REXS in XML");
  exporting->add_flag("--rexsj", to.rexsj, "stage.rexsj: the same in JSON");
  exporting->add_option("--rexs-version", to.rexs_version, "1.0 to 1.7 or 2.0 (default: 1.7)");
  exporting->add_flag("--grid", to.grid, "grid-pinion.csv, grid-wheel.csv: the modification as points of a measurement grid");
  exporting->add_option("--grid-points", to.grid_points, "points along the profile x along the face (default: 9x15)");
  exporting->add_option("--grid-margin", to.grid_margin, "share of the active flank left out at each border, 0 .. 0.4 (default: 0)");
  exporting->add_flag("--vtk", to.vtk, "vtk/contact-1.pvd ...: contact under load for ParaView, a collection a load case");
  exporting->add_flag("--dynamics", to.dynamics,
                      "dynamics.json, dynamics-*.csv: transmission error and mesh stiffness with their harmonics; analyses once more");
  exporting->add_flag("--given", to.given, "flanks as the study gave them, not as an optimisation left them");
  std::string page;
  bool open_page = false;
  CLI::App* documentation = app.add_subcommand("docs", "name the pages of the documentation, which are HTML and need no network, or open one");
  documentation->footer(
      "Examples:\n"
      "  flankwright docs                                            all pages with their files\n"
      "  flankwright docs tutorial --open                            in the browser\n"
      "  w3m \"$(flankwright docs keys)\"                             in the terminal");
  documentation->add_option("page", page, "name of a page, as listed without one");
  documentation->add_flag("--open", open_page, "open it in the browser (xdg-open)");
  std::string docs;
  CLI::App* completion = app.add_subcommand("completion", "print what a shell needs to complete commands, or the manual page");
  completion->footer(
      "Examples:\n"
      "  source <(flankwright completion bash)                       for this shell\n"
      "  flankwright completion zsh > ~/.zfunc/_flankwright\n"
      "  flankwright completion man | man -l -");
  completion->add_option("for", docs, "bash, zsh or man")->required()->check(CLI::IsMember({"bash", "zsh", "man"}));
  std::vector<std::string> commands;
  for (const CLI::App* command : std::as_const(app).get_subcommands([](const CLI::App*) { return true; })) commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(commands, argv[1]) == commands.end()) {
    throw InvalidInput("command", argv[1], fmt::format("one of {}{}", fmt::join(commands, ", "), did_you_mean(argv[1], commands)));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }

  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  if (run->parsed()) {
    options.overrides = overrides_of(settings);
    std::error_code no_folder;
    return std::filesystem::is_directory(options.study, no_folder) ? run_folder(options) : run_command(options);
  }
  if (merge->parsed()) {
    options.overrides = overrides_of(settings);
    return merge_command(options);
  }
  if (check->parsed()) return check_command(study, overrides_of(settings));
  if (make->parsed()) return new_command(kind);
  if (keys->parsed()) {
    print(key_page());
    return 0;
  }
  if (report->parsed()) return report_command(folder);
  if (comparing->parsed()) return compare_command(comparison);
  if (library->parsed()) return library_command(study);
  if (documentation->parsed()) return docs_command(page, open_page);
  if (completion->parsed()) {
    print(docs == "bash" ? bash_completion(app) : docs == "zsh" ? zsh_completion(app) : man_page(app, version()));
    return 0;
  }
  if (import->parsed()) return import_command(from);
  if (exporting->parsed()) return export_command(to);
  return test_command(paths, accept);
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  spdlog::set_default_logger(spdlog::stderr_color_mt("flankwright"));
  spdlog::set_pattern("%^%l%$: %v");
  try {
    const int exit_code = dispatch(argc, argv);
    std::cout.flush();
    check_standard_output(std::cout.good());
    flush_standard_output();
    return exit_code;
  } catch (const InvalidInput& problem) {
    std::fprintf(stderr, "%s\n", printable(problem.what(), "\n").c_str());
    return bad_input;
  } catch (const std::exception& error) {
    spdlog::critical("internal error: {}", error.what());
    return internal_error;
  }
}
