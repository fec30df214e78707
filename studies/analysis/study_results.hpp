#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/effects/decision.hpp"
#include "core/fidelity/cycle_resolution.hpp"
#include "core/fidelity/resolved_cycle.hpp"
#include "core/rating/edge_contact_start.hpp"
#include "core/rating/iso_load_factors.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "optimize/design/design_optimiser.hpp"
#include "optimize/design/pareto.hpp"
#include "optimize/design/resolved_design.hpp"
#include "optimize/design/two_level.hpp"
#include "studies/analysis/fidelity_choice.hpp"
#include "studies/analysis/effect_sizes.hpp"
#include "core/compliance/comparison/gear_fit.hpp"
#include "core/compliance/comparison/gear_deflections.hpp"
#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/compliance/model/gear_structures.hpp"
#include "studies/analysis/load_rating.hpp"
#include "studies/analysis/life_result.hpp"
#include "studies/study/study.hpp"
#include "studies/analysis/unloaded_result.hpp"

namespace flankwright::studies {

struct FidelityHierarchy;
struct Assessment;
struct ScatterResult;
struct SweepStatistics;

/// Loaded contact of one scene at one torque, for one design.
struct LoadedResult {
  std::string scene;
  double torque{not_given};     ///< on the pinion [N mm]
  std::string design{"given"};  ///< "given", or "before" / "after" an optimisation
  LoadedCycle cycle;
  ResolvedCycle resolved;    ///< with extremes between the positions, and errors
  CycleSummary summary;      ///< of `resolved`
  std::size_t model{0};      ///< index into StudyResults::models
  FlankCondition condition;  ///< that it was solved for
  IsoLoadFactors iso;
  std::optional<EdgeContactStart> edge_contact{};  ///< none where contact reaches no tip edge
  std::optional<LoadRating> rating{};              ///< none where peaks are sampled, or phases were given
  Operation operation{};                           ///< under this torque
  int bin{-1};                                     ///< index into Study::spectrum; -1: none
  int compared_intervals{0};                       ///< of the cycle that the errors by points come from; 0: none was estimated
};

/// A step of the run that is no effect of the mesh, and its time.
struct RunStep {
  std::string name, why;
  double seconds{not_given};
};

/// Evaluations of a search at its two levels, and its own view of the optimum.
struct SearchWork {
  LevelWork search, fine;
  double objective_seen_by_search{not_given};  ///< of the optimum on the coarse level, outside units
  double objective_at_positions{not_given};  ///< of what is to be ground, at the fine level's positions alone: what it is compared by, outside units
};

/// One gear's fit, as the task "fit" makes it.
struct GearFit {
  Member member{Member::Pinion};
  GearFitResult result;
  bool several_teeth{true};   ///< form used
  double seconds{not_given};  ///< wall time
};

/// Everything a study produced, in internal units.
struct StudyResults {
  Study study;
  GearPair pair;
  std::vector<UnloadedResult> unloaded;
  std::vector<LoadedResult> loaded;
  std::vector<MeshModel> models;            ///< one per placement
  std::vector<double> phases;               ///< of the loaded mesh positions [base pitches]
  GearStructures structures;                ///< empty where no structure was asked for, or none needed
  std::shared_ptr<const ShaftPair> shafts;  ///< null where they are rigid
  EffectDecisions effects;
  MeshEffects mesh_effects;  ///< those of them that are on, as all meshes of the study have them
  EffectSizes effect_sizes;
  LeftOutEffects left_out;  ///< of what an accuracy leaves to them
  std::vector<RunStep> steps;
  std::optional<FidelityChoice> fidelity_choice;       ///< where the study asks for an accuracy
  std::shared_ptr<const FidelityHierarchy> hierarchy;  ///< of the task "accuracy"
  std::optional<DesignTask> design_task;
  std::optional<DesignResult> design;        ///< its figures as they are shown: with extremes between the positions
  std::optional<SearchWork> search_work;     ///< how the design was found
  DesignErrors before_errors, after_errors;  ///< of the design's reports
  std::optional<ParetoFront> front;
  std::shared_ptr<const Assessment> assessment;  ///< of the design
  std::shared_ptr<const ScatterResult> scatter;  ///< where the design was chosen over draws
  std::vector<GearDeflections> deflections;      ///< of both gears, where the compliance is of single gears
  std::shared_ptr<const SweepStatistics> sweep;  ///< of the task "sweep": the rest of the results is its nominal sample
  std::shared_ptr<const LifeModel> life_model;   ///< what life, loss and film were computed with; null: none
  std::optional<StudyLife> life;                 ///< where the study asks for it
  std::vector<GearFit> fits;                     ///< of the task "fit", one a gear
  std::vector<std::string> notes;                ///< for the reader, one sentence each
  std::vector<std::string> requirements;         ///< requirements that were not met (exit code 1), one line each
  double seconds{not_given};
};

}  // namespace flankwright::studies
