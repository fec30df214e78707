#include "core/compliance/model/gear_correction.hpp"

#include "core/base/stopwatch.hpp"
#include "core/compliance/fitted/correction_fit.hpp"

namespace flankwright {

namespace {

/// At stations between those fitted, on all teeth of the fine run.
std::vector<ResidualStatistics> unseen_residuals(const CorrectedCompliance& model, const InfluenceTable& fine, const InfluenceSample& unseen) {
  InfluenceSample sample{unseen.gear, {}, {}};
  for (int tooth = 0; tooth <= fine.teeth_apart(); ++tooth) {
    for (FlankStation station : unseen.points) {
      station.tooth = tooth;
      sample.points.push_back(station);
    }
  }
  sample.compliance = fine.evaluate(sample.points);
  return residual_statistics(model, {&sample, 1}, kScaleFloor);
}

}  // namespace

GearCorrection gear_correction(const ComplianceTask& task, const FiniteElementRuns& runs, Member member, const ComplianceBuild& build) {
  const Stopwatch clock;
  const InfluenceTableTask gear = influence_table_task(task, member);
  const CorrectionLibrary& library = CorrectionLibrary::shipped();
  const GearProportions facts = facts_of(gear.gear);
  const std::vector<double> start = library.coefficients(facts, profile_of(gear.gear));
  const std::shared_ptr<const InfluenceTable>& coarse = runs[member].table;
  GearCorrection result;
  result.unknown = unknown_to_library(task, gear);
  if (result.unknown.empty()) {
    result.compliance = std::make_shared<const CorrectedCompliance>(coarse, facts, start);
    result.seconds = clock.seconds();
    return result;
  }
  const InfluenceTableTask fit_task = task_of_fit(gear);
  const GearProportions fit_facts = facts_of(fit_task.gear);
  const InfluenceTable& fine = *runs.fine[member]->table;
  const std::shared_ptr<const InfluenceTable>& fit_coarse = runs.narrow[member] ? runs.narrow[member]->table : coarse;
  const CorrectionSamples samples = correction_samples(fit_facts, fine, *fit_coarse);
  if (auto kept = build.store == nullptr ? std::nullopt : build.store->find_fit(fit_task, start)) {
    result.fit = std::move(kept->value);
    result.file = std::move(kept->where);
    result.from_cache = true;
  } else {
    if (build.progress) build.progress(std::string("fitting the ") + name_of(member) + "'s compliance", 0, 1, "");
    result.fit = fit_correction(samples, start);
    result.fit.seconds = clock.seconds();
    if (result.fit.coefficients.empty()) {
      throw InvalidInput("fidelity.compliance", to_string(task.model), std::string("another compliance: the ") + name_of(member) + "'s fit failed");
    }
    if (build.store != nullptr) result.file = build.store->keep_fit(fit_task, start, result.fit);
  }
  result.compliance = std::make_shared<const CorrectedCompliance>(coarse, facts, result.fit.coefficients);
  result.residuals = unseen_residuals(CorrectedCompliance(fit_coarse, fit_facts, result.fit.coefficients), fine, samples.unseen);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace flankwright
