#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/fidelity/cycle_quantities.hpp"
#include "studies/analysis/life_quantities.hpp"
#include "studies/analysis/position_memory.hpp"
#include "studies/analysis/study_results.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"

namespace flankwright::studies {

/// A figure that every sample has.
struct SweepOutput {
  std::string name;  ///< as in `loaded.summary` of results.json, or of `unloaded.mesh`; harmonics te_harmonic_1_um ...
  std::string unit;
  bool smaller_is_worse{false};  ///< of the worst sample: stiffness
};

/// Outcome of one sample.
struct SampleResult {
  std::string failure;          ///< why there are no outputs; empty: there are
  std::vector<double> outputs;  ///< in the units of the outputs; empty where it failed
};

/// Analyses single samples of a sweep against what the nominal run built once: gears, compliance, influence matrices. Those hold for every
/// sample of a placement (MeshPlacement); a sample with another one has its influence matrices built for itself. Every call is independent,
/// from any thread.
class SampleAnalysis {
 public:
  /// @param nominal  of a study of the task Sweep; must live as long as this
  explicit SampleAnalysis(const StudyResults& nominal);

  const std::vector<SweepOutput>& outputs() const { return outputs_; }
  /// @param values  of the parameters, in the units of bare numbers
  SampleResult analyse(const std::vector<double>& values) const;

 private:
  struct SampleCase;
  struct GearDamage {
    bool of_roots;  ///< else of the flanks
    Member member;
  };

  /// Of each output the worst over all load cases; and of the spectrum its damage.
  std::vector<double> loaded_outputs(const SweptCondition& swept) const;
  /// Solves a load case.
  /// @param of      its torque and operation are given
  /// @param meshes  of the sample so far, of other placements than the nominal one
  std::vector<double> case_outputs(SampleCase& of, const SweptCondition& swept, std::vector<std::unique_ptr<MeshModel>>& meshes) const;
  std::vector<double> unloaded_outputs(const FlankCondition& condition) const;
  bool is_loaded() const { return !nominal_.loaded.empty(); }

  const StudyResults& nominal_;
  mutable PositionBudget budget_;
  mutable PositionMemory memory_{budget_};         ///< of the nominal placement between its positions
  std::vector<CycleEntry> entries_;                ///< those of the outputs under load that are entries of cycle_quantities()
  std::shared_ptr<const LifeModel> life_;          ///< null: the study does not ask for life
  std::vector<const LifeQuantity*> life_outputs_;  ///< those of the outputs that the nominal load case has
  std::vector<GearDamage> damages_;                ///< those of its spectrum
  std::vector<SweepOutput> outputs_;
};

}  // namespace flankwright::studies
