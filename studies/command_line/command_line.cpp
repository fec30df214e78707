#include "studies/command_line/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "core/base/error.hpp"
#include "studies/base/version.hpp"
#include "studies/command_line/command_docs.hpp"
#include "studies/command_line/docs_command.hpp"
#include "studies/command_line/library_command.hpp"
#include "studies/command_line/many_runs.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/study_file/key_page.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/study/task.hpp"

namespace flankwright::studies {

namespace {

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

}  // namespace

CommandLine::CommandLine()
    : app_(
          "Flankwright designs the micro-geometry of involute spur and helical gears.\n"
          "A study file goes in; results, pictures and chosen flank modifications come out.\n\n"
          "  flankwright new optimise > my-gear.toml     a commented study to start from\n"
          "  flankwright check my-gear.toml              what is wrong with it, if anything\n"
          "  flankwright run my-gear.toml                results/my-gear/report.html",
          "flankwright") {
  app_.set_version_flag("--version", std::string("flankwright ") + version());
  app_.require_subcommand(1);
  add_run();
  add_merge();
  add_check();
  add_new();
  add_keys();
  add_report();
  add_compare();
  add_test();
  add_library();
  add_import();
  add_export();
  add_docs();
  add_completion();
}

CLI::App* CommandLine::add(const char* name, const char* what, const char* examples, std::function<int()> action) {
  CLI::App* command = app_.add_subcommand(name, what);
  command->footer(examples);
  commands_.push_back({command, std::move(action)});
  return command;
}

void CommandLine::add_run() {
  CLI::App* command = add("run", "do the study's task; writes results.json, report.html and CSV tables",
                          "Examples:\n"
                          "  flankwright run pump.toml                                   results/pump/report.html\n"
                          "  flankwright run pump.toml --out today --threads 2\n"
                          "  flankwright run pump.toml --set load.torque=250 --set misalignment.crossing=\"3 arcmin\"\n"
                          "  flankwright run pump.toml --set scenes.1.load.torque=300    the second scene's\n"
                          "  flankwright run gears/                                      every study of the folder, with one table of all",
                          [this] {
                            options_.overrides = overrides_of(settings_);
                            std::error_code no_folder;
                            return std::filesystem::is_directory(options_.study, no_folder) ? run_folder(options_) : run_command(options_);
                          });
  command->add_option("study", options_.study, "study file (TOML), or a folder of them")->required();
  command->add_option("-o,--out", options_.folder,
                      "folder for the results (default: results/ + the study's name); of several studies theirs are in it");
  command->add_option("--threads", threads_, "threads to use (default: all cores); results do not depend on it")->check(CLI::Range(1, 1024));
  command->add_option("--set", settings_, "key.path=value: overrides the study file, may be repeated")->allow_extra_args(false);
  command->add_option("--shard", options_.shard, "k/n: of a sweep the k-th of n parts of the samples alone; `merge` puts them together");
}

void CommandLine::add_merge() {
  CLI::App* command = add("merge", "put the shards of a sweep together: the results of an unshared run",
                          "Example:\n"
                          "  flankwright merge pump.toml                                 after flankwright run pump.toml --shard 1/3 ... 3/3",
                          [this] {
                            options_.overrides = overrides_of(settings_);
                            return merge_command(options_);
                          });
  command->add_option("study", options_.study, "study file of the sweep")->required();
  command->add_option("-o,--out", options_.folder, "folder that the shards were given (default: results/ + the study's name)");
  command->add_option("--threads", threads_, "threads to use")->check(CLI::Range(1, 1024));
  command->add_option("--set", settings_, "key.path=value, as for the shards")->allow_extra_args(false);
}

void CommandLine::add_check() {
  CLI::App* command =
      add("check", "read and validate a study; every problem with file:line:column",
          "Examples:\n"
          "  flankwright check pump.toml                                 pump.toml:12:1: pinion.teeth = 2: allowed is an integer 5 .. 1000\n"
          "  flankwright check pump.toml --set pinion.teeth=17",
          [this] { return check_command(study_, overrides_of(settings_)); });
  command->add_option("study", study_, "study file")->required();
  command->add_option("--set", settings_, "key.path=value")->allow_extra_args(false);
}

void CommandLine::add_new() {
  CLI::App* command = add("new", "print a commented study file",
                          "Examples:\n"
                          "  flankwright new analyse > pump.toml                         one pair as it runs\n"
                          "  flankwright new optimise > pump.toml                        modifications that hold over many conditions\n"
                          "  flankwright new slurm > pump.sbatch                         a job script for the shards of a sweep",
                          [this] { return new_command(kind_); });
  std::string kinds;
  for (const Task* task : registered_tasks()) kinds.append(kinds.empty() ? "" : ", ").append(task->name);
  command->add_option("kind", kind_, kinds + "; slurm: a job script for the shards of a sweep")->required();
}

void CommandLine::add_keys() {
  add("keys", "print the reference of all keys of a study file, in Markdown",
      "Examples:\n"
      "  flankwright keys | less\n"
      "  flankwright keys > studies/keys.md                          the page of the repository",
      [this] {
        print(key_page());
        return 0;
      });
}

void CommandLine::add_report() {
  CLI::App* command = add("report", "rebuild report.html from a results folder",
                          "Example:\n"
                          "  flankwright report results/pump",
                          [this] { return report_command(folder_); });
  command->add_option("folder", folder_, "results folder")->required();
}

void CommandLine::add_compare() {
  CLI::App* command = add("compare", "show the results of several runs side by side: a table, comparison.html and comparison.csv",
                          "Examples:\n"
                          "  flankwright compare results/pump results/pump-2             comparison/comparison.html\n"
                          "  flankwright compare before after --tolerance 1%             exit 1 where anything differs by more, with a list of it",
                          [this] { return compare_command(comparison_); });
  command->add_option("folders", comparison_.folders, "results folders, at least two; changes are from the first one")->required()->expected(2, 64);
  command->add_option("-o,--out", comparison_.folder, "folder for comparison.html and comparison.csv (default: comparison)");
  command->add_option("--tolerance", comparison_.tolerance, "a percentage; of an entry of a list it counts from the largest of the list");
}

void CommandLine::add_test() {
  CLI::App* command =
      add("test", "run studies that have an [expect] table; exit 1 where one differs",
          "Examples:\n"
          "  flankwright test gears/                                     every study of the folder that has an [expect] table, a line each\n"
          "  flankwright test pump.toml valve.toml",
          [this] { return test_command(paths_, accept_); });
  command->add_option("paths", paths_, "study files or folders of them")->required();
  command->add_option("--threads", threads_, "threads to use")->check(CLI::Range(1, 1024));
  command->add_flag("--accept", accept_, "write today's values into a copy of each study, FILE.accepted");
}

void CommandLine::add_library() {
  CLI::App* command = add("library", "make the library of tooth compliance fits anew; goes on where FILE ends",
                          "Example:\n"
                          "  flankwright library teeth.txt                               hours; killed, it goes on where the file ends",
                          [this] { return library_command(study_); });
  command->add_option("file", study_, "file to write")->required();
  command->add_option("--threads", threads_, "finite-element runs abreast")->check(CLI::Range(1, 1024));
}

void CommandLine::add_import() {
  CLI::App* command = add("import", "make a study of a stage in a REXS file",
                          "Examples:\n"
                          "  flankwright import gearbox.rexs                             one stage: its study on stdout; several: they are listed\n"
                          "  flankwright import gearbox.rexs --stage 2 --out pump.toml   flank grids of the file go beside pump.toml\n"
                          "  flankwright import gearbox.rexsj --helix-slope datum > pump.toml",
                          [this] { return import_command(import_); });
  command->add_option("file", import_.file, "REXS file, XML or JSON")->required();
  command->add_option("-o,--out", import_.study, "study file to write (default: stdout)");
  command->add_option("--stage", import_.stage, "which stage, of several: its number, as they are listed without this option");
  command->add_option("--hours", import_.hours, "life of the unit in hours, by which load cases with shares of time become a load spectrum");
  command->add_option("--helix-slope", import_.slope_end, "face end at which a positive helix_slope removes material")
      ->check(CLI::IsMember({"non-datum", "datum"}));
}

void CommandLine::add_export() {
  CLI::App* command =
      add("export", "write what a results folder holds in the formats of other programs",
          "Examples:\n"
          "  flankwright export results/pump --rexs                      results/pump/stage.rexs, after an optimisation with what it found\n"
          "  flankwright export results/pump --rexsj --rexs-version 2.0 --out to-supplier\n"
          "  flankwright export results/pump --grid --grid-points 5x9 --grid-margin 0.05\n"
          "  flankwright export results/pump --vtk                       open results/pump/vtk/contact-1.pvd in ParaView\n"
          "  flankwright export results/pump --dynamics                  transmission error and mesh stiffness for rotor dynamics",
          [this] { return export_command(export_); });
  command->add_option("folder", export_.results, "results folder")->required();
  command->add_option("-o,--out", export_.folder, "folder for the files (default: the results folder)");
  command->add_flag("--rexs", export_.rexs, "stage.rexs: the pair with its flank modifications, REXS in XML");
  command->add_flag("--rexsj", export_.rexsj, "stage.rexsj: the same in JSON");
  command->add_option("--rexs-version", export_.rexs_version, "1.0 to 1.7 or 2.0 (default: 1.7)");
  command->add_flag("--grid", export_.grid, "grid-pinion.csv, grid-wheel.csv: the modification as points of a measurement grid");
  command->add_option("--grid-points", export_.grid_points, "points along the profile x along the face (default: 9x15)");
  command->add_option("--grid-margin", export_.grid_margin, "share of the active flank left out at each border, 0 .. 0.4 (default: 0)");
  command->add_flag("--vtk", export_.vtk, "vtk/contact-1.pvd ...: contact under load for ParaView, a collection a load case");
  command->add_flag("--dynamics", export_.dynamics,
                    "dynamics.json, dynamics-*.csv: transmission error and mesh stiffness with their harmonics; analyses once more");
  command->add_flag("--given", export_.given, "flanks as the study gave them, not as an optimisation left them");
}

void CommandLine::add_docs() {
  CLI::App* command = add("docs", "name the pages of the documentation, which are HTML and need no network, or open one",
                          "Examples:\n"
                          "  flankwright docs                                            all pages with their files\n"
                          "  flankwright docs tutorial --open                            in the browser\n"
                          "  w3m \"$(flankwright docs keys)\"                             in the terminal",
                          [this] { return docs_command(page_, open_page_); });
  command->add_option("page", page_, "name of a page, as listed without one");
  command->add_flag("--open", open_page_, "open it in the browser (xdg-open)");
}

void CommandLine::add_completion() {
  CLI::App* command = add("completion", "print what a shell needs to complete commands, or the manual page",
                          "Examples:\n"
                          "  source <(flankwright completion bash)                       for this shell\n"
                          "  flankwright completion zsh > ~/.zfunc/_flankwright\n"
                          "  flankwright completion man | man -l -",
                          [this] {
                            print(shell_ == "bash" ? bash_completion(app_) : shell_ == "zsh" ? zsh_completion(app_) : man_page(app_, version()));
                            return 0;
                          });
  command->add_option("for", shell_, "bash, zsh or man")->required()->check(CLI::IsMember({"bash", "zsh", "man"}));
}

int CommandLine::run(int argc, const char* const* argv) {
  std::vector<std::string> names;
  for (const Command& command : commands_) names.push_back(command.parsed->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(names, argv[1]) == names.end()) {
    throw InvalidInput("command", argv[1], fmt::format("one of {}{}", fmt::join(names, ", "), did_you_mean(argv[1], names)));
  }
  try {
    app_.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_.exit(error) == 0 ? 0 : bad_input;
  }
  std::optional<tbb::global_control> limit;
  if (threads_ > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
  const auto given = std::ranges::find_if(commands_, [](const Command& command) { return command.parsed->parsed(); });
  return given->action();
}

}  // namespace flankwright::studies
