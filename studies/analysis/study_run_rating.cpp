#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "core/base/stopwatch.hpp"
#include "core/fidelity/resolved_analysis.hpp"
#include "studies/analysis/edge_contact_note.hpp"
#include "studies/analysis/film_note.hpp"
#include "studies/analysis/governing_cases.hpp"
#include "studies/analysis/step_progress.hpp"
#include "studies/analysis/study_effect_sizes.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/analysis/deflection_note.hpp"
#include "studies/analysis/unit_note.hpp"
#include "studies/study_file/study_life.hpp"
#include "studies/analysis/rims.hpp"

/// What a StudyRun adds to load cases that are solved: load factors, life, the torques at which edges touch, sizes of effects.
namespace flankwright::studies {

namespace {

/// The intervals of the analysis, 24 at most where it chooses them: ratios of peaks are known better than the peaks, and each load case is solved under
/// several conditions. Where only the strength asks for load factors 12 do, as many as an analysis begins with: S_H takes their root, and K_H without spikes of an EV stage and a wind stage is
/// within 0.7 % of that by 48 intervals with either.
Quadrature rating_quadrature(const Study& study) {
  const int enough = locates_peaks(study) ? 24 : 12;
  Quadrature quadrature = study.fidelity.quadrature;
  if (study.fidelity.automatic_intervals) quadrature.intervals = std::min(quadrature.intervals, enough);
  return quadrature;
}

/// Half the intervals of the analysis, 12 at most where it chooses them: where an edge begins to touch depends on the gap and the approach, which few points give well.
Quadrature edge_quadrature(const Fidelity& fidelity) {
  constexpr int enough = 12;
  Quadrature quadrature = fidelity.quadrature;
  quadrature.intervals = std::max(1, quadrature.intervals / 2);
  if (fidelity.automatic_intervals) quadrature.intervals = std::min(quadrature.intervals, enough);
  return quadrature;
}

/// The load cases whose load factors are sought: all, or where only the strength asks for them, as in an optimisation, those that use it most.
std::vector<LoadedResult*> rated_cases(StudyResults& results) {
  const Study& study = results.study;
  const bool all = locates_peaks(study);
  const bool by_strength = has_strength(study) && study.cycle.phases.empty() && !study.cycle.locate_peaks.has_value();
  std::vector<LoadedResult*> rated;
  if (!all && !by_strength) return rated;
  const std::vector<bool> asked = all ? std::vector<bool>(results.loaded.size(), true) : most_utilised_cases(results, *life_model(study));
  for (std::size_t i = 0; i < results.loaded.size(); ++i) {
    if (results.loaded[i].cycle.usable() && asked[i]) rated.push_back(&results.loaded[i]);
  }
  return rated;
}

/// For derivatives. Points of a line that is tilted against the flank leave contact one after the other within some 1e-3 base pitches, and derivatives change
/// with each of them.
constexpr PeakSearch sharp_peaks{.phase_tolerance = 2e-6, .value_tolerance = 0.0};

}  // namespace

void StudyRun::rate() {
  const std::vector<LoadedResult*> rated = rated_cases(results_);
  if (rated.empty()) return;
  const Stopwatch clock;
  const Quadrature quadrature = rating_quadrature(results_.study);
  const auto mesh_for = [this, quadrature](double torque) {
    return [=, this](const FlankCondition& condition, bool shafts_deflect, const std::vector<MeshParameter>& by) {
      return mesh_at(condition, torque, shafts_deflect, by, quadrature);
    };
  };
  std::vector<RatedCase> cases;
  for (const LoadedResult* loaded : rated) {
    const double opening = rim_opening(results_, results_.models[loaded->model], loaded->torque);
    cases.push_back({mesh_for(loaded->torque), loaded->condition, loaded->torque, opening});
  }
  const std::vector<MeshParameter> parameters = gradient_parameters();
  std::vector<LoadRating> ratings =
      rate_cases(cases, results_.shafts != nullptr, parameters.empty() ? PeakSearch{} : sharp_peaks, parameters, progress_);
  for (std::size_t i = 0; i < rated.size(); ++i) {
    rated[i]->rating = std::move(ratings[i]);
    rated[i]->rating->quadrature = quadrature;
  }
  results_.steps.push_back({"load_factors", "peaks between the positions, of the perfect pair and of parts of the conditions", clock.seconds()});
}

void StudyRun::rate_life() {
  results_.life_model = life_model(study());
  StepProgress step(progress_, "rating life", results_.loaded.size());
  results_.life = study_life(results_, [&](const LoadedResult& loaded) {
    step.add_one();
    return coarse_cycle_of(loaded);
  });
  if (!results_.life) return;
  results_.notes.insert(results_.notes.end(), results_.life->not_summed.begin(), results_.life->not_summed.end());
  if (const std::string note = film_note(results_); !note.empty()) results_.notes.push_back(note);
}

std::optional<EdgeContactStart> StudyRun::edge_contact_of(const LoadedResult& loaded, Member gear) {
  const MeshModel& model = results_.models[loaded.model];
  std::optional<EdgeContactStart> start;
  double spacing = 2.0 / static_cast<double>(results_.phases.size());
  // Half the points and positions do, unless no edge is reached with them.
  const auto coarse = coarse_models_.find(placement_of(loaded.condition, loaded.torque));
  if (coarse != coarse_models_.end()) start = edge_contact_start(coarse->second, loaded.condition, loaded.torque, gear);
  if (!start) {
    start = edge_contact_start(model, loaded.condition, loaded.torque, gear);
    spacing *= 0.5;
  }
  // Between the positions an edge may touch earlier, or there alone.
  if (loaded.resolved.extreme_mesh) {
    const double known = start ? start->torque : std::numeric_limits<double>::infinity();
    if (const auto between = edge_contact_start(*loaded.resolved.extreme_mesh, loaded.condition, loaded.torque, gear, known)) start = between;
  }
  if (!start || !results_.study.cycle.phases.empty()) return start;
  const MeshAt mesh = mesh_at(loaded.condition, loaded.torque, true, {}, edge_quadrature(results_.study.fidelity));
  return edge_contact_start_near(mesh, loaded.condition, loaded.torque, *start, spacing);
}

std::optional<EdgeContactStart> StudyRun::first_edge_contact_of(const LoadedResult& loaded) {
  std::optional<EdgeContactStart> first;
  for (const Member gear : both_gears) {
    if (first && first->torque == 0.0) break;
    const std::optional<EdgeContactStart> start = edge_contact_of(loaded, gear);
    if (start && (!first || start->torque < first->torque)) first = start;
  }
  return first;
}

void StudyRun::find_edge_contact() {
  const Stopwatch clock;
  // Edges of the same flanks on the same mesh begin to touch at the same torque in every load case that has a larger one. It is sought under the least such
  // torque, to a share of which it is found.
  std::vector<std::vector<LoadedResult*>> alike;
  for (LoadedResult& loaded : results_.loaded) {
    // The stress is NaN of sharp edges, and where the effect is off.
    if (!std::isgreater(loaded.summary.edge_stress, 0.0) && !reaches_tip_edge(results_.models[loaded.model], loaded.cycle)) continue;
    const auto is_like = [&](const auto& group) { return group.front()->model == loaded.model && group.front()->condition == loaded.condition; };
    const auto found = std::ranges::find_if(alike, is_like);
    (found != alike.end() ? *found : alike.emplace_back()).push_back(&loaded);
  }
  StepProgress step(progress_, "seeking contact of tip edges", alike.size());
  tbb::parallel_for(std::size_t{0}, alike.size(), [&](std::size_t i) {
    std::ranges::stable_sort(alike[i], {}, &LoadedResult::torque);
    std::optional<EdgeContactStart> start;
    for (LoadedResult* loaded : alike[i]) {
      if (!start) start = first_edge_contact_of(*loaded);
      loaded->edge_contact = start;
    }
    step.add_one();
  });
  if (std::ranges::none_of(results_.loaded, [](const LoadedResult& loaded) { return loaded.edge_contact.has_value(); })) return;
  results_.steps.push_back({"edge_contact", "the torques at which tip edges touch", clock.seconds()});
  results_.notes.push_back(edge_contact_note(results_.loaded));
}

void StudyRun::note_large_motions() {
  for (const std::string& note : {unit_note(results_), deflection_note(results_)}) {
    if (!note.empty()) results_.notes.push_back(note);
  }
  for (const std::string& note : idle_bearing_notes(results_)) results_.notes.push_back(note);
}

void StudyRun::size_effects() {
  const Stopwatch clock;
  results_.effect_sizes = study_effect_sizes(results_, progress_);
  if (results_.effect_sizes.estimated.empty()) return;
  results_.steps.push_back(
      {"effect_sizes", results_.effect_sizes.exact.empty() ? "estimates" : "estimates, and each left out in turn", clock.seconds()});
}

}  // namespace flankwright::studies
