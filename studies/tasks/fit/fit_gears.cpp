#include "studies/tasks/fit/fit_gears.hpp"

#include <fmt/format.h>

#include "core/base/stopwatch.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/tasks/fit/fit_choice.hpp"

namespace flankwright::studies {

namespace {

/// Where several teeth are fitted: pairs whose compliance passes through zero must not decide the fit.
constexpr double several_teeth_floor = 0.01;

/// Of all coefficients of one tooth: without a strong ridge the over-complete sum creeps along flat valleys for a thousand
/// steps, and is no closer to unseen values for it. Several teeth come closer with FitOptions' own.
constexpr double one_tooth_ridge = 2e-3;
/// Converged when a step changes the cost by less than this share of it: residuals by less than half of that.
constexpr double cost_tolerance = 1e-5;

}  // namespace

GearFitTask gear_fit_task(const Study& study, const GearPair& pair, Member member) {
  const FitChoice& choice = study.table<FitChoice>();
  GearFitTask task;
  const InfluenceTableTask table = influence_table_task(compliance_task(study, pair), member);
  task.gear = table.gear;
  task.removed = table.removed;
  task.material = study.material[member];
  task.form = choice.several_teeth ? KernelForm::several_teeth() : KernelForm::one_tooth_accurate();
  if (choice.several_teeth) {
    task.fit.scale_floor = several_teeth_floor;
  } else {
    task.fit.tooth_ridge = task.fit.body_ridge = one_tooth_ridge;
  }
  task.fit.solver = {.max_iterations = choice.max_iterations, .cost_tolerance = cost_tolerance};
  task.teeth_apart = task.mesh.teeth_each_side;
  task.test_grid = choice.test_grid;
  return task;
}

std::vector<GearFit> fit_gears(const Study& study, const GearPair& pair, const ProgressReport& progress) {
  std::vector<GearFit> fits;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    if (!study.table<FitChoice>().gears[member]) continue;
    const Stopwatch clock;
    const auto report = [&](const std::string& label, int done, int total) {
      if (progress) progress(fmt::format("{}: {}", name_of(member), label), done, total, "");
    };
    GearFit fit{member, fit_gear(gear_fit_task(study, pair, member), report), study.table<FitChoice>().several_teeth};
    fit.seconds = clock.seconds();
    fits.push_back(std::move(fit));
  }
  return fits;
}

std::string unmet_requirement(const GearFit& fit) {
  if (fit.result.status != FactorStatus::Factorised) {
    const bool memory = fit.result.status == FactorStatus::OutOfMemory;
    return fmt::format("the {}'s finite elements could not be solved: {}", name_of(fit.member),
                       memory ? "out of memory" : "the stiffness matrix is singular to round-off");
  }
  if (fit.result.fit.status == FitStatus::Converged) return "";
  return fmt::format("the {}'s fit did not converge ({} after {} steps): {}", name_of(fit.member), to_string(fit.result.fit.status),
                     fit.result.fit.iterations, fit.result.fit.message);
}

}  // namespace flankwright::studies
