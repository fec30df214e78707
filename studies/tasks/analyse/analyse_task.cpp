#include "studies/tasks/analyse/analyse_task.hpp"

#include "studies/analysis/study_run.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/tasks/analyse/analyse_keys.hpp"
#include "studies/tasks/analyse/analyse_template.hpp"

namespace flankwright::studies {

const Task analyse_task{.name = "analyse",
                        .meaning = "The task `analyse`.",
                        .one_design = true,
                        .keys = analyse_keys,
                        .read = read_gradients,
                        .check = check_gradients,
                        .run = [](StudyRun& run) { run.analyse(); },
                        .summary = analysis_table,
                        .study_template = analyse_template};

}  // namespace flankwright::studies
