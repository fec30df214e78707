#pragma once

#include <any>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/effects/decision.hpp"
#include "core/fidelity/cycle_resolution.hpp"
#include "core/fidelity/resolved_cycle.hpp"
#include "core/rating/edge_contact_start.hpp"
#include "core/rating/iso_load_factors.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "studies/analysis/fidelity_choice.hpp"
#include "studies/analysis/effect_sizes.hpp"
#include "core/compliance/comparison/gear_deflections.hpp"
#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/compliance/model/gear_structures.hpp"
#include "studies/analysis/load_rating.hpp"
#include "studies/analysis/life_result.hpp"
#include "studies/study/study.hpp"
#include "studies/analysis/unloaded_result.hpp"

namespace flankwright::studies {

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
  std::optional<EdgeContactStart> edge_contact{};     ///< none where contact reaches no tip edge
  std::optional<LoadRating> rating{};                 ///< none where peaks are sampled, or phases were given
  Operation operation{};                              ///< under this torque
  int bin{-1};                                        ///< index into Study::spectrum; -1: none
  int spectrum_loads{0};                              ///< load cases that the spectrum has in this scene
  int compared_intervals{0};                          ///< of the cycle that the errors by points come from; 0: none was estimated
  std::vector<PerGear<ShaftMotion>> shaft_motions{};  ///< of every position; empty where shafts are rigid
};

/// A step of the run that is no effect of the mesh, and its time.
struct RunStep {
  std::string name, why;
  double seconds{not_given};
};

/// A design that the results show.
struct ShownDesign {
  std::string name;  ///< "before", "after"
  PerGear<Modification> modification;
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
  LeftOutEffects left_out;  ///< by what an accuracy leaves to them
  std::vector<RunStep> steps;
  std::optional<FidelityChoice> fidelity_choice;  ///< where the study asks for an accuracy
  std::vector<GearDeflections> deflections;       ///< of both gears, where the compliance is of single gears
  std::shared_ptr<const LifeModel> life_model;    ///< what life, loss and film were computed with; null: none
  std::optional<StudyLife> life;                  ///< where the study asks for it
  std::vector<ShownDesign> designs;               ///< of a task that makes designs, the last one is to be ground; empty: the study's own
  std::vector<std::string> notes;                 ///< for the reader, one sentence each
  std::vector<std::string> requirements;          ///< requirements that were not met (exit code 1), one line each
  double seconds{not_given};

  /// What the study's task found beside all this, of the type that the task has for it; null where there is none of that type.
  template <class Found>
  const Found* found() const {
    const auto* kept = std::any_cast<std::shared_ptr<const Found>>(&found_);
    return kept == nullptr ? nullptr : kept->get();
  }
  template <class Found>
  void set_found(std::shared_ptr<const Found> found) {
    found_ = std::move(found);
  }

 private:
  std::any found_;
};

}  // namespace flankwright::studies
