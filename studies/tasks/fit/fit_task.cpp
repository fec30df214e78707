#include "studies/study/task.hpp"

#include "studies/analysis/study_run.hpp"
#include "studies/tasks/fit/fit_gears.hpp"
#include "studies/tasks/fit/fit_json.hpp"
#include "studies/tasks/fit/fit_keys.hpp"
#include "studies/tasks/fit/fit_tables.hpp"
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

constexpr std::string_view fit_text =
    R"(# Compliance of each gear by finite elements, fitted by a sum of kernels and compared with other models. Flank
# modifications, loads and misalignment do not enter.
title = "Compliance of my gears"
task = "fit"

[pair]
normal_module = 4                    # mm
pressure_angle = 20                  # deg, normal section
helix_angle = 15                     # deg, 0 is a spur gear

[pinion]
teeth = 20
face_width = 40                      # mm
profile_shift = 0.2                  # in normal modules, + outwards
rack = { addendum = 1, dedendum = 1.25, root_radius = 0.39 }         # in normal modules

[wheel]
teeth = 40
face_width = 40

[pinion.body]                        # the gear below its teeth; [wheel.body] alike
# shaft_diameter = 40                # mm; by default 0.8 d, at most 25 m_n/cos(beta)
# bore_diameter = 2                  # mm; by default 0.05 of the shaft
# shaft_overhang = 20                # mm beyond each face end; by default half the shaft's diameter

[material]
youngs_modulus = 206000              # MPa
poissons_ratio = 0.3

[fit]
gear = "both"                        # or "pinion", "wheel"
form = "one_tooth_accurate"          # the loaded tooth alone; "several_teeth" couples its neighbours, less closely
# test_grid = "off"                  # leaves out the comparison at stations that the fit has not seen
# max_iterations = 600               # steps of the least squares

# Required accuracy of the fit, for `flankwright test`:
# [expect]
# "fit.residuals.kernels.unseen.0.median_percent" = { max = 1 }      # 0: the loaded tooth, 1: one pitch away ...
)";

}  // namespace

extern const Task fit_task{.name = "fit",
                           .meaning = "The task `fit`: [fits](README.md#fits).",
                           .single_gears = true,
                           .keys = fit_keys,
                           .run = run_fit,
                           .add_json = [](const StudyResults& results, Json& json) { json["fit"] = list(fits_of(results), fit_json); },
                           .tables = [](const StudyResults& results) { return fit_tables(fits_of(results)); },
                           .summary = [](const StudyResults& results) { return fit_summary(fits_of(results)); },
                           .report_sections = fit_sections,
                           .study_template = [] { return std::string(fit_text); }};

}  // namespace flankwright::studies
