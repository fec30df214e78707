#include "studies/tasks/sweep/worst_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <filesystem>
#include <sstream>

#include "core/gear/both_gears.hpp"
#include "studies/study_file/study_document.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

namespace {

/// A text as TOML writes it.
std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::toml_formatter{toml::value<std::string>{text}};
  return out.str();
}

std::string absolute(const Study& study, const std::string& file) {
  if (file.empty()) return file;
  return std::filesystem::absolute(std::filesystem::path(study.file).parent_path() / file).lexically_normal().string();
}

void add_grids(const Study& study, Member m, std::vector<Override>& overrides) {
  const std::string gear = name_of(m);
  if (!study.grid[m].file.empty()) overrides.push_back({gear + ".modification.grid", quoted(absolute(study, study.grid[m].file))});
  if (!study.opposite_grid[m].file.empty()) {
    overrides.push_back({gear + ".modification.grid_of_opposite_flank", quoted(absolute(study, study.opposite_grid[m].file))});
  }
  const std::vector<std::string>& teeth = study.tooth_grids[m];
  if (teeth.empty()) return;
  std::string list;
  for (const std::string& file : teeth) list += (list.empty() ? "[" : ", ") + quoted(absolute(study, file));
  overrides.push_back({gear + ".error.grids", list + "]"});
}

void add_spectrum_file(const Study& study, std::vector<Override>& overrides) {
  const SpectrumSource& source = study.spectrum_source;
  if (!source.file.empty()) overrides.push_back({"load.spectrum.file", quoted(absolute(study, source.file))});
  if (!source.signal.empty()) overrides.push_back({"load.spectrum.signal", quoted(absolute(study, source.signal))});
}

}  // namespace

std::string sample_study(const Study& study, const std::string& title, const std::vector<double>& values) {
  std::vector<Override> overrides{{"task", "\"analyse\""}, {"title", quoted(title)}};
  for (std::size_t j = 0; j < values.size(); ++j) {
    const SweepParameter& parameter = study.table<SweepTable>().parameters[j];
    // Texts are the shortest of the same numbers.
    if (parameter.pitch) {
      overrides.push_back({parameter.path, fmt::format("[{}]", fmt::join(pitch_of_draw(*parameter.pitch, values[j]), ", "))});
    } else {
      overrides.push_back({parameter.path, fmt::format("{}", values[j])});
    }
  }
  if (study.fidelity.automatic_intervals) {
    overrides.push_back({"fidelity.quadrature.rule", "\"graded\""});
    overrides.push_back({"fidelity.quadrature.intervals", fmt::format("{}", study.fidelity.quadrature.intervals)});
  }
  if (study.cycle.automatic_positions && study.cycle.phases.empty())
    overrides.push_back({"cycle.positions", fmt::format("{}", study.cycle.positions)});
  for (const Member m : both_gears) add_grids(study, m, overrides);
  add_spectrum_file(study, overrides);
  std::vector<StudyProblem> problems;
  const StudyDocument document(study.text, study.file, overrides, problems);
  assert(problems.empty());
  toml::table root = document.root();
  root.erase("sweep");
  root.erase("expect");
  std::ostringstream out;
  out << toml::toml_formatter{root} << "\n";
  return out.str();
}

}  // namespace flankwright::studies
