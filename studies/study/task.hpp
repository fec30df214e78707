#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact/assembly/flank_condition.hpp"
#include "studies/base/progress.hpp"

namespace flankwright {
struct DesignVariable;
}

namespace flankwright::studies {

struct NamedText;
struct ReportSection;
struct SchemaKey;
struct Study;
struct StudyReading;
struct StudyResults;
class StudyRun;

/// A task of a study: one folder of studies/tasks and its name in studies/tasks/registry.cpp. Its keys fill a table of its own, Study::table(); what it finds beside the
/// load cases it keeps by StudyResults::set_found(). What a member leaves empty, the task does not need. The keys of all tasks are read in every study, whichever task it names, so that it may name another one.
struct Task {
  const char* name{nullptr};     ///< as a study names it
  const char* meaning{nullptr};  ///< one sentence of Markdown that heads its keys in the key reference, with a link from studies/

  bool single_gears{false};     ///< concerns gears by themselves: their finite elements are solved; scenes, loads and effects do not count
  bool loads_nothing{false};    ///< shows what follows from the gears' sizes: no models are chosen for an accuracy
  bool one_design{false};       ///< shows each load case in full: refined peaks, derivatives, effects left out by an accuracy
  bool compares_bodies{false};  ///< needs the compliance of rigid gear bodies beside that of the given ones

  std::vector<SchemaKey> (*keys)(){nullptr};
  void (*read)(StudyReading&){nullptr};   ///< tables whose keys are no fixed names, of every study
  void (*check)(StudyReading&){nullptr};  ///< checks of a study of this task
  /// Flank conditions that effects are decided by; empty: those of the study's scenes.
  std::vector<FlankCondition> (*conditions)(const Study&){nullptr};
  bool (*asks_for_root_stress)(const Study&){nullptr};
  /// Modifications that it varies, and those linked to them; asked of every study, see varied_by_tasks().
  std::vector<DesignVariable> (*varied)(const Study&){nullptr};
  void (*add_notes)(const Study&, std::vector<std::string>&){nullptr};  ///< on what a study of this task asks for

  void (*run)(StudyRun&){nullptr};  ///< never empty
  /// Work in the results folder after run(); an empty path: nothing is kept.
  void (*run_in_folder)(StudyResults&, const std::filesystem::path&, const ProgressReport&){nullptr};

  void (*write_files)(const StudyResults&, const std::filesystem::path& folder){nullptr};  ///< files other than tables
  void (*add_json)(const StudyResults&, nlohmann::ordered_json&){nullptr};                 ///< its sections of results.json
  std::vector<NamedText> (*tables)(const StudyResults&){nullptr};                          ///< its CSV files beside those of load cases
  std::string (*summary)(const StudyResults&){nullptr};                                    ///< printed at the end of a run; never empty
  std::vector<ReportSection> (*report_sections)(){nullptr};  ///< its sections of the report; the folder's scripts in report/ fill them
  std::string (*study_template)(){nullptr};                  ///< printed by `flankwright new`; never empty
};

/// All tasks there are, the default first: a task exists by its name in studies/tasks/registry.cpp.
std::span<const Task* const> registered_tasks();

/// Modifications that have a range in a study instead of a value: all that some task would vary, whichever task the study names.
std::vector<DesignVariable> varied_by_tasks(const Study& study);

/// @throws InvalidInput "task" for a name that no task has
const Task& find_task(std::string_view name);

}  // namespace flankwright::studies
