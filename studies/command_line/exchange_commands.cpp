#include "studies/command_line/exchange_commands.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>

#include "core/gear/both_gears.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/base/printable.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/base/progress.hpp"
#include "studies/exchange/dynamics/dynamics_tables.hpp"
#include "studies/exchange/grid/grid_table.hpp"
#include "studies/exchange/vtk/vtk_series.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/exchange/rexs/grouped_warnings.hpp"
#include "studies/exchange/rexs/rexs_export.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/stored_study.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

/// When a file was last written, as REXS dates are: the same file exports to the same bytes.
std::string date_of(const fs::path& file) {
  const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::file_clock::to_sys(fs::last_write_time(file)));
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}

void write_export(const fs::path& file, const std::string& text) {
  write_whole(file, text);
  print(file.string() + "\n");
}

/// Writes every file of the series. The collections, which name the others, are written last and reported.
void export_vtk(const Json& json, const fs::path& results, const fs::path& folder) {
  for (const NamedText& file : vtk_series(json, results.string())) {
    const fs::path path = folder / file.name;
    make_folder(path.parent_path());
    write_whole(path, file.text);
    if (path.extension() == ".pvd") print(path.string() + "\n");
  }
}

/// Analyses the study once more: stiffness for small vibrations is a derivative that results have only where it was asked for.
void export_dynamics(const Json& json, const fs::path& results, StoredFlanks flanks, const fs::path& folder, std::vector<std::string>& notes) {
  Progress progress;
  DynamicsRun run = mesh_excitation(json, results.string(), flanks, progress.report());
  progress.finish();
  for (const NamedText& file : dynamics_files(run)) write_export(folder / file.name, file.text);
  notes.insert(notes.end(), run.notes.begin(), run.notes.end());
}

}  // namespace

int import_command(const ImportCommand& options) {
  constexpr double longest = 1e7;  // h, as a load spectrum allows
  if (options.hours && !(*options.hours > 0.0 && *options.hours <= longest)) {
    throw InvalidInput("--hours", fmt::format("{:.6g}", *options.hours), "a number above 0 and at most 10000000 h");
  }
  const fs::path out = options.study;
  const fs::path stem = (out.empty() ? fs::path(options.file) : out).stem();
  const rexs::UnitImport imported =
      rexs::import_unit(read_whole(options.file), options.file,
                        {.stage = options.stage,
                         .slope_end = options.slope_end == "datum" ? rexs::SlopeEnd::DatumFace : rexs::SlopeEnd::NonDatumFace,
                         .hours = options.hours,
                         .grid_stem = stem.string()});
  const bool one = options.stage || imported.stages.size() + imported.left_out.size() == 1;
  if (out.has_parent_path()) make_folder(out.parent_path());
  for (const auto& [number, stage] : imported.stages) {
    if (one && out.empty()) {
      if (!stage.grids.empty()) throw InvalidInput("--out", "not given", "a study file: the stage has flank grids that are stored beside it");
      print(stage.text);
    } else {
      const std::string stage_stem = one ? stem.string() : rexs::stem_of_stage(stem.string(), number);
      const fs::path study = one ? out : out.parent_path() / (stage_stem + ".toml");
      for (const rexs::ImportedGrid& grid : stage.grids) write_whole(study.parent_path() / grid.name, grid.text);
      write_whole(study.parent_path() / rexs::not_taken_name(stage_stem), stage.not_taken);
      write_whole(study, stage.text);
      print(fmt::format("study: {}\n", study.string()));
    }
  }
  flush_standard_output();
  for (const std::string& left_out : imported.left_out) spdlog::warn("left out: {}", printable(left_out));
  std::vector<rexs::StageWarnings> stages;
  for (const auto& [number, stage] : imported.stages) stages.push_back({number, stage.warnings});
  for (const std::string& warning : one ? stages.front().warnings : rexs::grouped_by_stage(stages)) spdlog::warn("{}", printable(warning));
  return 0;
}

int export_command(const ExportCommand& options) {
  if (!options.rexs && !options.rexsj && !options.grid && !options.vtk && !options.dynamics) {
    throw InvalidInput("export", "no format", "--rexs, --rexsj, --grid, --vtk or --dynamics, or several of them");
  }
  constexpr double seen_in_results = 0.1 * units::um;  // a departure above this changes stress and transmission error visibly
  const GridLayout layout = grid_layout(options.grid_points, options.grid_margin);
  const fs::path results = fs::path(options.results) / "results.json";
  const Json json = whole_results(options.results);
  const fs::path folder = options.folder.empty() ? options.results : options.folder;
  make_folder(folder);
  const StoredFlanks flanks = options.given ? StoredFlanks::Given : StoredFlanks::Final;
  std::vector<std::string> notes;
  if (options.rexs || options.rexsj || options.grid) {
    const Study study = stored_study(json, results.string(), flanks);
    if (options.rexs || options.rexsj) {
      rexs::ExportedStage stage = rexs::export_stage(study, {options.rexs_version, date_of(results)});
      if (options.rexs) write_export(folder / "stage.rexs", model_text(stage.model, rexs::Form::Xml));
      if (options.rexsj) write_export(folder / "stage.rexsj", model_text(stage.model, rexs::Form::Json));
      notes = std::move(stage.notes);
    }
    if (options.grid) {
      const GearPair pair = make_gear_pair(study.pair);
      const PerGear<Modification> analysed = analysed_modification(study, study_effects(study));
      for (const Member m : both_gears) {
        const std::string name = std::string("grid-") + name_of(m) + ".csv";
        const GridTable table = grid_table(pair, m, analysed[m], layout, study.title);
        write_export(folder / name, table.text);
        if (!table.unreadable.empty()) {
          notes.push_back(fmt::format("{}: a study cannot read it as modification.grid: {}", name, table.unreadable));
          continue;
        }
        notes.push_back(fmt::format("{}: the surface through the {} x {} points departs from the flank by at most {:.2g} um{}", name,
                                    layout.profile_points, layout.face_points, table.departure / units::um,
                                    table.departure > seen_in_results ? "; --grid-points takes more of them" : ""));
      }
    }
  }
  if (options.vtk) export_vtk(json, results, folder / "vtk");
  if (options.dynamics) export_dynamics(json, results, flanks, folder, notes);
  flush_standard_output();
  for (const std::string& note : notes) spdlog::info("{}", note);
  return 0;
}

}  // namespace flankwright::studies
