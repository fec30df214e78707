#include "studies/tasks/fit/fit_task.hpp"

#include "studies/analysis/study_run.hpp"
#include "studies/tasks/fit/fit_gears.hpp"
#include "studies/tasks/fit/fit_json.hpp"
#include "studies/tasks/fit/fit_keys.hpp"
#include "studies/tasks/fit/fit_tables.hpp"
#include "studies/tasks/fit/fit_template.hpp"
#include "studies/results/report_section.hpp"

namespace flankwright::studies {

namespace {

void run_fit(StudyRun& run) {
  StudyResults& results = run.results();
  const auto fits = std::make_shared<const GearFits>(fit_gears(results.study, results.pair, run.progress()));
  for (const GearFit& fit : *fits) {
    const std::string unmet = unmet_requirement(fit);
    if (!unmet.empty()) results.requirements.push_back(unmet);
  }
  results.set_found(fits);
}

const GearFits& fits_of(const StudyResults& results) { return *results.found<GearFits>(); }

std::vector<ReportSection> fit_sections() {
  return {
      {Chapter::Answer, "deflections", "Deflection of a tooth under load", [](const Json& r) { return has(r, "fit"); }},
      {Chapter::Answer, "residuals", "Fits beside finite elements", [](const Json& r) { return has(r, "fit"); }},
  };
}

}  // namespace

const Task fit_task{.name = "fit",
                    .meaning = "The task `fit`: [fits](README.md#fits).",
                    .single_gears = true,
                    .keys = fit_keys,
                    .run = run_fit,
                    .add_json = [](const StudyResults& results, Json& json) { json["fit"] = list(fits_of(results), fit_json); },
                    .tables = [](const StudyResults& results) { return fit_tables(fits_of(results)); },
                    .summary = [](const StudyResults& results) { return fit_summary(fits_of(results)); },
                    .report_sections = fit_sections,
                    .study_template = fit_template};

}  // namespace flankwright::studies
