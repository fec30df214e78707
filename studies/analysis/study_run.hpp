#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "studies/analysis/fidelity_level.hpp"
#include "studies/analysis/position_memory.hpp"
#include "studies/analysis/refine_resolution.hpp"
#include "studies/analysis/spectrum_life.hpp"
#include "studies/analysis/study_results.hpp"
#include "studies/base/progress.hpp"

namespace flankwright::studies {

/// One study while it is run. Its task calls the steps below, each of which adds to the results.
class StudyRun {
 public:
  /// @param choice  models of an accuracy that the study asks for, which are in the study already; the run adds the resolution and effects to it
  StudyRun(const Study& study, const ProgressReport& progress, const std::optional<FidelityChoice>& choice = {});

  /// Runs the study's task and the common end of all tasks: sizes and times of the effects, requirements that are not met.
  StudyResults finish();

  const Study& study() const { return results_.study; }
  StudyResults& results() { return results_; }
  const ProgressReport& progress() const { return progress_; }
  /// Meshes that a search makes, for the load cases too.
  const std::shared_ptr<MeshStore>& mesh_store() const { return mesh_store_; }
  void report(const std::string& label, int done, int total, const std::string& remark = {}) const;
  /// "12 intervals, 32 positions", for reports of progress.
  std::string resolution_in_words() const;

  /// The subject of all fidelity levels of this study.
  LevelSubject level_subject() const { return {results_.study, results_.pair, loaded_scenes(), results_.shafts}; }

  /// Load cases of scenes: their torques above 0, conditions as far as their effects are on.
  std::vector<DesignScene> loaded(const std::vector<Scene>& scenes) const;
  std::vector<DesignScene> loaded_scenes() const { return loaded(results_.study.scenes); }

  /// Phases of the loaded mesh positions: as given, or evenly spaced.
  void set_phases();

  /// The study goes on with so many evenly spaced positions, or intervals along each contact line; nothing loaded may be among the results yet.
  void set_positions(int positions);
  void set_intervals(int intervals);

  /// Structure and root stress of both gears, made when first needed.
  const GearStructures& structures();

  /// Unloaded contact, load distribution and load rating of the study's scenes.
  void analyse();

  /// A load case that was solved, and its mesh.
  struct SolvedCase {
    DesignScene scene;
    const MeshModel* model;
    const LoadedCycle* cycle;
  };
  /// Summaries of solved load cases, with extremes between their positions, and errors where asked for.
  std::vector<ResolvedCycle> resolved(const std::vector<SolvedCase>& cases, bool with_errors = true);

  /// Adds solved load cases of one design to the results.
  /// @param design  "given", "before" or "after"
  void add_loaded(const std::vector<DesignScene>& scenes, const std::string& design, std::vector<LoadedCycle> cycles);

  /// Solves load cases from index `first` on anew with twice the intervals where half of them cannot say that Fidelity::resolution_accuracy is
  /// kept, edges included, which no resolution is refined for, and those that a search has looked at so finely. Their errors by points follow. Of more than
  /// most_cases_compared_finely load cases it takes those that govern. Where the study gives its intervals it does nothing.
  void hold_against_finer(std::size_t first);
  struct HeldCase {
    JudgedCase judged;
    const FlankCondition* condition;
    ResolvedCycle* resolved;    ///< of `judged`
    Operation operation;        ///< for film and temperatures
    bool is_found;              ///< by a search
    int compared_intervals{0};  ///< of the cycle that the errors by points come from; 0: it does not matter which
  };
  void hold_against_finer(std::vector<HeldCase>& cases);

  /// Adds refined peaks with and without spikes, and the load factors that follow, to the load cases of the results. Where peaks are sampled, as in an
  /// optimisation, only the load cases that use the strength most have them, for their safeties.
  void rate();

  /// Adds what the load cases do to life, after rate(): safeties take its load factors.
  void rate_life();

 private:
  MeshModel mesh(const MeshPlacement& placement, const MeshResolution& resolution, const PairRootStress* root_stress, const PairCompliance* shafts,
                 const std::vector<MeshParameter>& parameters);
  /// Null where no search has made it.
  std::shared_ptr<const MeshModel> mesh_of_search(const MeshPlacement& placement, const MeshResolution& resolution) const;
  MeshModel mesh_of_load_cases(const MeshPlacement& placement);
  /// Positions that are known already are not made again where there are no parameters. May be called by several threads at a time.
  /// @param shafts_deflect  false: they are rigid
  MeshAt mesh_at(const FlankCondition& condition, double torque, bool shafts_deflect, const std::vector<MeshParameter>& parameters,
                 Quadrature quadrature);
  MeshPlacement placement_of(const FlankCondition& condition, double torque) const;
  std::vector<std::size_t> models_for(const std::vector<DesignScene>& scenes);
  std::vector<const MeshModel*> coarse_meshes_for(const std::vector<MeshPlacement>& placements);
  /// With half the intervals at every second position; nothing where none was made for the errors of the load case.
  std::optional<CoarseCycle> coarse_cycle_of(const LoadedResult& loaded) const;
  std::vector<MeshParameter> gradient_parameters() const;
  void note_fits();
  void add_unloaded(const Scene& scene);
  void analyse_loaded(const std::vector<DesignScene>& scenes);
  void begin_coarsely();
  bool needs_more_resolution();
  void leave_out_small_effects(const std::vector<DesignScene>& scenes);
  void forget_loaded();
  /// Where contact begins on the tip edges of one gear; nothing where it does not.
  std::optional<EdgeContactStart> edge_contact_of(const LoadedResult& loaded, Member gear);
  /// On those of either gear.
  std::optional<EdgeContactStart> first_edge_contact_of(const LoadedResult& loaded);
  void find_edge_contact();
  void note_large_motions();
  void size_effects();

  const ProgressReport& progress_;
  StudyResults results_;
  std::shared_ptr<MeshStore> mesh_store_{std::make_shared<MeshStore>()};
  std::map<MeshPlacement, std::size_t> model_index_;
  std::map<MeshPlacement, MeshModel> coarse_models_;  ///< half the intervals, every second position
  /// By placement, intervals and whether shafts deflect: scenes and the parts of a condition are looked at in the same phases to begin with.
  PositionBudget position_budget_;
  std::map<std::tuple<MeshPlacement, int, bool>, PositionMemory> memories_;
  std::mutex memories_mutex_;
  double unloaded_seconds_{0.0};
  bool has_structure_{false};
};

}  // namespace flankwright::studies
