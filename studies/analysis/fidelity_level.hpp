#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/load/cycle/cycle_figures.hpp"
#include "core/fidelity/discretisation.hpp"
#include "optimize/design/design_task.hpp"
#include "core/compliance/model/gear_structures.hpp"
#include "studies/base/progress.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// What a rung differs from others by: in what the model leaves out, or in how finely it is resolved.
enum class ErrorKind { Model, Discretisation, Both };
const char* to_string(ErrorKind kind);

/// One way to analyse loaded contact.
struct FidelityLevel {
  std::string name, axis;
  ErrorKind kind{ErrorKind::Discretisation};
  ComplianceModel compliance{ComplianceModel::Fitted};  ///< Rigid: teeth do not bend, flanks give way locally
  GapModel gap{GapModel::PlaneOfAction};
  Quadrature quadrature;
  int positions{32};
  bool located_peaks{false};  ///< peaks sought between the positions; false: of the positions only
  std::vector<std::string> left_out{};  ///< names of effects that the study has on and this rung does without
};

struct LevelResult {
  FidelityLevel level;
  std::vector<CycleFigures> scenes;  ///< of each load case; empty where a position failed
  double seconds{not_given};         ///< processor time of all load cases, influence values of single gears known; least of repeats
  bool usable() const { return !scenes.empty(); }
};

/// What every rung of a study analyses.
struct LevelSubject {
  Study study;
  GearPair pair;
  std::vector<DesignScene> scenes;  ///< load cases, with effects applied
  std::shared_ptr<const PairCompliance> shafts{};  ///< null: rigid
};

/// Analyses one study on any rung; what finite elements give is made once a model, when first needed.
class LevelRunner {
 public:
  LevelRunner(LevelSubject subject, const ProgressReport& progress) : subject_(std::move(subject)), progress_(progress) {}

  const LevelSubject& subject() const { return subject_; }
  LevelResult run(const FidelityLevel& level);
  /// What is on in a rung's meshes: what the study calls for with the rung's models, less what the rung leaves out.
  MeshEffects effects(const FidelityLevel& level) const;
  /// The mesh of one load case by a rung's models, at resolutions of one's choice.
  MeshOfResolution mesh(const FidelityLevel& level, const DesignScene& scene);
  /// Of "fitted" and "fe"; empty for the others.
  const GearStructures& structures(ComplianceModel model);
  /// What the structures of a model took when they were made, in this run or, where they were kept, an earlier one: wall time [s].
  double first_seconds(ComplianceModel model);

 private:
  std::vector<CycleFigures> figures(const FidelityLevel& level);

  LevelSubject subject_;
  const ProgressReport& progress_;
  std::map<ComplianceModel, GearStructures> structures_;
};

/// Largest of each figure over the load cases, see figure_errors(); infinite where a rung is not usable.
PerFigure worst_errors(const LevelResult& level, const LevelResult& reference);

}  // namespace flankwright::studies
