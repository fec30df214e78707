#include "studies/compliance/gear_refinement.hpp"

#include <fmt/format.h>

#include "core/base/stopwatch.hpp"
#include "core/compliance/fitted/refinement_fit.hpp"
#include "studies/compliance/fit_task.hpp"
#include "studies/compliance/stored_table.hpp"

namespace flankwright::studies {

namespace {

/// To be raised whenever the same influence values come to mean another fit: form, places, residuals.
constexpr int fit_version = 3;

Json fit_key(InfluenceTableTask coarse, const std::vector<double>& start) {
  coarse.root_stress = false;
  InfluenceTableTask fine = coarse;
  fine.mesh = {};
  return {{"refinement", fit_version}, {"coarse", cache_key(coarse)}, {"fine", cache_key(fine)}, {"start", start}};
}

StoredRun to_store(const RefinementEntry& fit) { return {.facts = {{"fit", to_text(fit)}}, .matrices = {}}; }

/// The fit of that key, if there is one that can be used.
std::optional<RefinementEntry> take(const Json& key, const RunCache& cache, std::vector<std::string>& notes) {
  const auto stored = cache.find(key, notes);
  if (!stored) return std::nullopt;
  try {
    return entries_in(stored->facts.at("fit").get<std::string>()).at(0);
  } catch (const std::exception& problem) {
    notes.push_back("the stored fit " + cache.file_of(key).string() + " is not used: " + problem.what());
    return std::nullopt;
  }
}

/// On places between those fitted, on all teeth that the fine run knows.
std::vector<ResidualStatistics> unseen_residuals(const RefinedCompliance& model, const InfluenceTable& fine,
                                                 const InfluenceSample& unseen) {
  InfluenceSample sample{unseen.gear, {}, {}};
  for (int tooth = 0; tooth <= fine.teeth_apart(); ++tooth) {
    for (FlankPlace place : unseen.points) {
      place.tooth = tooth;
      sample.points.push_back(place);
    }
  }
  sample.compliance = fine.evaluate(sample.points);
  return residual_statistics(model, {&sample, 1}, kScaleFloor);
}

}  // namespace

GearRefinement gear_refinement(const Study& study, const InfluenceTableTask& task, const FiniteElementRuns& runs, Member member,
                               std::vector<std::string>& notes, const ProgressReport& progress) {
  const Stopwatch clock;
  const RefinementLibrary& library = RefinementLibrary::shipped();
  const GearFacts facts = facts_of(task.gear);
  const std::shared_ptr<const InfluenceTable>& coarse = runs[member].table;
  GearRefinement result;
  result.unknown = unknown_to_library(study, task);
  if (result.unknown.empty()) {
    result.compliance = std::make_shared<const RefinedCompliance>(coarse, facts, library.coefficients(facts, profile_of(task.gear)));
    result.seconds = clock.seconds();
    return result;
  }
  const InfluenceTableTask fit_task = task_of_fit(task);
  const GearFacts fit_facts = facts_of(fit_task.gear);
  const InfluenceTable& fine = *runs.fine_run(member)->table;
  const std::shared_ptr<const InfluenceTable>& fit_coarse = runs.narrow_run(member) ? runs.narrow_run(member)->table : coarse;
  const RefinementSamples samples = refinement_samples(fit_facts, fine, *fit_coarse);
  const std::vector<double> start = library.coefficients(facts, profile_of(task.gear));
  const RunCache cache(RunCache::default_folder());
  const Json key = fit_key(fit_task, start);
  if (auto kept = take(key, cache, notes)) {
    result.fit = std::move(*kept);
    result.from_cache = true;
    result.file = cache.file_of(key).string();
  } else {
    if (progress) progress(fmt::format("fitting the {}'s compliance", name_of(member)), 0, 1, "");
    result.fit = fit_refinement(samples, start);
    result.fit.seconds = clock.seconds();
    if (result.fit.coefficients.empty()) {
      throw InvalidInput("fidelity.compliance", to_string(study.fidelity.compliance),
                         fmt::format("another compliance: the {}'s fit failed", name_of(member)));
    }
    if (cache.store(key, to_store(result.fit), notes)) result.file = cache.file_of(key).string();
  }
  if (result.fit.status != FitStatus::Converged) {
    notes.push_back(fmt::format("the {}'s fit stopped after {} steps, before it converged", name_of(member), result.fit.iterations));
  }
  result.compliance = std::make_shared<const RefinedCompliance>(coarse, facts, result.fit.coefficients);
  result.residuals = unseen_residuals(RefinedCompliance(fit_coarse, fit_facts, result.fit.coefficients), fine, samples.unseen);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace flankwright::studies
