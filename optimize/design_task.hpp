#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/contact/gap.hpp"
#include "core/load/mesh_cycle.hpp"
#include "core/load/mesh_model.hpp"

namespace flankwright {

/// How the scenes are combined into one number.
enum class Aggregate { Nominal, Worst, Mean, MeanPlusTwoSigma };

/// As a study names it: "nominal", "worst", "mean", "mean+2sigma".
const char* to_string(Aggregate over);

/// A quantity of the loaded analysis that can be minimised or bounded. Units inside: MPa, mm, N/mm.
enum class Output {
  PeakContactStress,  ///< [MPa]
  TePeakToPeak,       ///< of f_t, along the flank normal [mm]
  TeHarmonic,         ///< amplitude of one order of f_t [mm]
  LoadFactor,         ///< peak line load / mean line load [-]
  PeakLineLoad,       ///< [N/mm]
  PeakRootStress      ///< of both gears' fillets; needs DesignTask::root_stress [MPa]
};

/// One output with its place in a weighted objective.
struct ObjectiveTerm {
  Output output{Output::PeakContactStress};
  int harmonic{0};      ///< order for TeHarmonic, 1 .. 10
  double weight{1.0};   ///< per unit of the output outside (MPa, um, N/mm), > 0
  std::string name;     ///< as the study names it: "te_harmonic_1"

  /// Factor from the inside unit to the unit that the weight and every report refer to (MPa, um, N/mm, 1).
  double outside_factor() const {
    return output == Output::TePeakToPeak || output == Output::TeHarmonic ? 1.0 / units::um : 1.0;
  }
  const char* unit() const;
};

/// A modification parameter that the optimiser may choose.
struct DesignVariable {
  std::string path;  ///< as the study names it: "pinion.modification.lead_crowning"
  Member member{Member::Pinion};
  ModificationParameter parameter{ModificationParameter::LeadCrowning};
  double lower{0.0}, upper{0.0};  ///< [mm; parabolic_te 1/rad], lower < upper

  /// Factor from the inside unit to that of reports: um, but mm for the extent of a relief, arcsec/deg^2 for parabolic_te.
  double outside_factor() const;
  const char* unit() const;
};

/// Upper bound on an output, to hold in every scene.
struct OutputConstraint {
  ObjectiveTerm output;
  double maximum{std::numeric_limits<double>::infinity()};  ///< inside unit
};

/// One working condition at one torque. Modifications inside `condition` are replaced by the design's.
struct DesignScene {
  std::string name;
  double weight{1.0};  ///< > 0, of mean and mean + 2 sigma
  double torque{0.0};  ///< on the pinion [N mm], > 0
  FlankCondition condition;
};

/// What shall be chosen and what it shall achieve.
struct DesignTask {
  GearPair pair;
  Material pinion_material, wheel_material;
  MeshResolution resolution;
  MeshEffects effects;
  GapModel gap{GapModel::PlaneOfAction};
  std::shared_ptr<const PairCompliance> structure;       ///< null: thin slices
  std::shared_ptr<const PairRootStress> root_stress;     ///< null: none
  std::shared_ptr<const PairCompliance> shafts;          ///< null: rigid
  Modification pinion_modification, wheel_modification;  ///< values of what is not varied, and the start of what is
  std::vector<DesignScene> scenes;                       ///< the first is the nominal one
  std::vector<DesignVariable> variables;
  std::vector<ObjectiveTerm> objective;
  Aggregate over{Aggregate::Worst};
  std::vector<OutputConstraint> constraints;

  /// Names of the objective's outputs, "te_harmonic_1 + te_harmonic_2".
  std::string objective_name() const;
  /// Unit of the objective's values outside; "weighted sum" where there are several outputs.
  const char* objective_unit() const;
};

}  // namespace flankwright
