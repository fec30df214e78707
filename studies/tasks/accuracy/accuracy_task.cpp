#include "studies/study/task.hpp"

#include <fmt/format.h>

#include "studies/analysis/study_run.hpp"
#include "studies/study_file/template_text.hpp"
#include "studies/tasks/accuracy/accuracy_keys.hpp"
#include "studies/tasks/accuracy/accuracy_json.hpp"
#include "studies/tasks/accuracy/accuracy_tables.hpp"
#include "studies/tasks/accuracy/accuracy_table.hpp"
#include "studies/results/report_section.hpp"

namespace flankwright::studies {

namespace {

void run_accuracy(StudyRun& run) {
  run.analyse();
  StudyResults& results = run.results();
  LevelRunner runner(run.level_subject(), run.progress());
  const Study& study = results.study;
  const int intervals = study.fidelity.quadrature.intervals, positions = study.cycle.positions;
  if (intervals > study.table<AccuracyTable>().intervals || positions > study.table<AccuracyTable>().positions) {
    results.notes.push_back(
        fmt::format("the finest level of the table (accuracy.finest: {} intervals, {} positions) is coarser than the results of this study "
                    "({} intervals, {} positions)",
                    study.table<AccuracyTable>().intervals, study.table<AccuracyTable>().positions, intervals, positions));
  }
  const auto hierarchy = std::make_shared<const FidelityHierarchy>(run_hierarchy(runner, run.progress()));
  results.steps.push_back({"accuracy_ladder", "all fidelity levels together", hierarchy->seconds});
  results.set_found(hierarchy);
  if (!hierarchy->usable()) results.requirements.push_back("the finest fidelity level did not converge");
}

const FidelityHierarchy& hierarchy_of(const StudyResults& results) { return *results.found<FidelityHierarchy>(); }

/// An accuracy chosen by a study of another task is shown by the same means.
std::vector<ReportSection> accuracy_sections() {
  return {
      {Chapter::Answer, "accuracy", "Cost of accuracy", [](const Json& r) { return has(r, "accuracy") || has(r, "accuracy_choice"); }},
  };
}

constexpr std::string_view accuracy_head =
    R"(# The cost of accuracy: the pair is analysed at many fidelity levels, and each is compared with the finest.
title = "My pair at all fidelity levels"
task = "accuracy"
)";

constexpr std::string_view accuracy_tail = R"(
[load]
torque = 300                         # N·m on the pinion

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]                           # the settings of the study are one of the levels, too
compliance = "fitted"                # finite elements of both gears, solved once; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need
# accuracy = "1 %"                   # chooses compliance, gap, quadrature and positions where they are not given

[accuracy.finest]                    # the level that all others are compared with
compliance = "fitted"                # or "fe", finer finite elements: minutes; "thin_slice": at once
# gap = "plane_of_action"            # by default contact is sought over the whole flanks
# intervals = 32                     # along a full contact line: 16, unless said
# positions = 128                    # over one base pitch: 64, unless said

# Errors are the worst over these; each overrides what it names.
[[scenes]]
name = "aligned"

[[scenes]]
name = "housing bends"
misalignment.mesh_misalignment = 12  # um over the face width; + opens at +z
)";

}  // namespace

extern const Task accuracy_task{
    .name = "accuracy",
    .meaning = "The task `accuracy`: [the cost of accuracy](tasks/accuracy/README.md).",
    .compares_bodies = true,
    .keys = accuracy_keys,
    .check = check_accuracy,
    .run = run_accuracy,
    .add_json = [](const StudyResults& results, Json& json) { json["accuracy"] = hierarchy_json(hierarchy_of(results)); },
    .tables = [](const StudyResults& results) { return hierarchy_tables(hierarchy_of(results)); },
    .summary = [](const StudyResults& results) { return hierarchy_summary(hierarchy_of(results)); },
    .report_sections = accuracy_sections,
    .study_template = [] { return std::string(accuracy_head) + std::string(template_pair) + std::string(accuracy_tail); }};

}  // namespace flankwright::studies
