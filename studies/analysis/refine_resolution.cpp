#include "studies/analysis/refine_resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/fidelity/resolved_analysis.hpp"

namespace flankwright::studies {

namespace {

/// Of a load case; what the study gives counts as exact.
ResolutionLevel level_of(const JudgedCase& of, const StudyResults& results) {
  const CycleErrorParts& parts = of.resolved->error_parts;
  ResolutionLevel level{results.study.fidelity.quadrature.intervals, static_cast<int>(results.phases.size()),
                        figures_of(*of.cycle, of.resolved->summary)};
  if (!results.fidelity_choice->quadrature_given) level.quadrature_error = error_shares(parts.points, level.figures);
  if (!results.fidelity_choice->positions_given) level.position_error = error_shares(parts.positions, level.figures);
  return level;
}

struct Widest {
  const JudgedCase* of{nullptr};  ///< null: no error was estimated
  double error{0.0};              ///< headline_error()
};

Widest widest(const std::vector<JudgedCase>& cases) {
  Widest found;
  for (const JudgedCase& of : cases) {
    const double error = headline_error(of.resolved->errors, of.resolved->summary, *of.cycle);
    if (std::isgreater(error, found.error)) found = {&of, error};
  }
  return found;
}

}  // namespace

std::vector<JudgedCase> judged_cases(const StudyResults& results) {
  std::vector<JudgedCase> cases;
  for (const LoadedResult& loaded : results.loaded) {
    if (loaded.design != "before") cases.push_back({loaded.scene, loaded.torque, &results.models[loaded.model], &loaded.cycle, &loaded.resolved});
  }
  return cases;
}

bool refine_resolution(const std::vector<JudgedCase>& cases, StudyResults& results, int most_doublings) {
  const auto [worst, largest] = widest(cases);
  Fidelity& fidelity = results.study.fidelity;
  Cycle& cycle = results.study.cycle;
  AutomaticResolution resolution{.accuracy = fidelity.resolution_accuracy,
                                 .intervals = fidelity.quadrature.intervals,
                                 .positions = cycle.positions,
                                 .choose_intervals = fidelity.automatic_intervals,
                                 .choose_positions = cycle.automatic_positions && cycle.phases.empty()};
  if (worst == nullptr || largest <= resolution.accuracy) return false;
  if (refine(resolution, *worst->resolved, *worst->cycle)) {
    constexpr double per_doubling = 4.0;  // of order two
    for (int more = 1; more < most_doublings && largest > std::pow(per_doubling, more) * resolution.accuracy; ++more)
      refine(resolution, *worst->resolved, *worst->cycle);
    if (results.fidelity_choice) results.fidelity_choice->levels.push_back(level_of(*worst, results));
    fidelity.quadrature.intervals = resolution.intervals;
    cycle.positions = resolution.positions;
    return true;
  }
  return false;
}

void note_what_stays_wide(const std::vector<JudgedCase>& cases, StudyResults& results) {
  const Fidelity& fidelity = results.study.fidelity;
  const auto [worst, largest] = widest(cases);
  if (worst == nullptr || largest <= fidelity.resolution_accuracy || results.fidelity_choice) return;
  const bool is_given = mostly_by_points(*worst->resolved, *worst->cycle) ? !fidelity.automatic_intervals : !results.study.cycle.automatic_positions;
  if (is_given) return;
  const bool is_stress = largest == worst->resolved->errors.peak_contact_stress / worst->resolved->summary.peak_contact_stress;
  results.notes.push_back(
      fmt::format("the {} of scene \"{}\" at {:.5g} N·m is known to {:.3g} % only, with {} intervals along a contact line and {} mesh positions",
                  is_stress ? "contact stress" : "transmission error", worst->scene, worst->torque / units::newton_metre, 100.0 * largest,
                  fidelity.quadrature.intervals, results.phases.size()));
}

void state_resolution(StudyResults& results) {
  if (!results.fidelity_choice) return;
  FidelityChoice& choice = *results.fidelity_choice;
  choice.fidelity = results.study.fidelity;
  choice.positions = static_cast<int>(results.phases.size());
  choice.left_out = results.left_out;
  choice.quadrature_error = choice.position_error = choice.resolution_error = {};
  choice.failures = 0;
  std::optional<ResolutionLevel> governing;
  for (const JudgedCase& of : judged_cases(results)) {
    choice.failures += of.cycle->failures;
    const ResolutionLevel level = level_of(of, results);
    choice.quadrature_error = larger_of(choice.quadrature_error, level.quadrature_error);
    choice.position_error = larger_of(choice.position_error, level.position_error);
    choice.resolution_error = larger_of(choice.resolution_error, level.error());
    if (governing && !(headline(level.error()) > headline(governing->error()))) continue;
    governing = level;
    choice.governing = of.scene;
    choice.governing_torque = of.torque;
  }
  if (governing) {
    std::erase_if(choice.levels,
                  [&](const ResolutionLevel& l) { return l.intervals == governing->intervals && l.positions == governing->positions; });
    choice.levels.push_back(*governing);
  }
  choice.kept = choice.failures == 0 && headline(choice.error()) <= choice.accuracy;
}

}  // namespace flankwright::studies
