#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/load/cycle/cycle_figures.hpp"
#include "core/fidelity/resolved_analysis.hpp"
#include "optimize/design/problem/design_task.hpp"
#include "core/compliance/model/gear_structures.hpp"
#include "studies/base/progress.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Origin of the error of a level: the model, the discretisation, or both.
enum class ErrorKind { Model, Discretisation, Both };
const char* to_string(ErrorKind kind);

/// One choice of models and resolution for the analysis of loaded contact.
struct FidelityLevel {
  std::string name, axis;
  ErrorKind kind{ErrorKind::Discretisation};
  ComplianceModel compliance{ComplianceModel::Fitted};  ///< Rigid: teeth do not bend, flanks are compliant at their contact
  GapModel gap{GapModel::PlaneOfAction};
  Quadrature quadrature;
  int positions{32};
  bool located_peaks{false};            ///< peaks sought between the positions; false: of the positions only
  std::vector<std::string> left_out{};  ///< names of effects that are on in the study and off at this level
};

struct LevelResult {
  FidelityLevel level;
  std::vector<CycleFigures> scenes;  ///< of each load case; empty where a position failed
  double seconds{not_given};         ///< processor time of all load cases, influence values of single gears known; least of repeats
  bool usable() const { return !scenes.empty(); }
};

/// The study and load cases that all its fidelity levels analyse.
struct LevelSubject {
  Study study;
  GearPair pair;
  std::vector<DesignScene> scenes;                 ///< load cases, with effects applied
  std::shared_ptr<const PairCompliance> shafts{};  ///< null: rigid
};

/// Analyses a study at any fidelity level. Structures from finite elements are made once for each model, when first needed.
class LevelRunner {
 public:
  LevelRunner(LevelSubject subject, const ProgressReport& progress) : subject_(std::move(subject)), progress_(progress) {}

  const LevelSubject& subject() const { return subject_; }
  LevelResult run(const FidelityLevel& level);
  /// Effects that are on in the meshes of a level: those that the study calls for with its models, less those left out.
  MeshEffects effects(const FidelityLevel& level) const;
  /// The mesh of one load case by the models of a level, as a function of the resolution.
  MeshOfResolution mesh(const FidelityLevel& level, const DesignScene& scene);
  /// Structures of "fitted" and "fe"; empty for the others.
  const GearStructures& structures(ComplianceModel model);
  /// Wall time of making the structures of a model, in this run or in the earlier one that they were kept from [s].
  double first_seconds(ComplianceModel model);

 private:
  std::vector<CycleFigures> figures(const FidelityLevel& level);

  LevelSubject subject_;
  const ProgressReport& progress_;
  std::map<ComplianceModel, GearStructures> structures_;
};

/// Largest of each figure over the load cases, see figure_errors(); infinite where a level is not usable.
PerFigure worst_errors(const LevelResult& level, const LevelResult& reference);

}  // namespace flankwright::studies
