#pragma once

#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/benchmarks/contact_truth/contact_run.hpp"

namespace flankwright::contact_truth {

/// The program's own answer at the position of a task.
struct OwnAnswer {
  MeshModel model;
  LoadedPosition loaded;

  double share(int tooth) const;  ///< [-]
  /// Force per mm of face width at z on a tooth pair, linear between contact points and level beyond the outermost
  /// [N/mm]; 0 where the pair has none.
  double face_load(int tooth, double z) const;
  double mean_face_load(int tooth, double begin, double end) const;  ///< its mean over a layer [N/mm]
  /// Largest root stress at the 30 deg tangent of a tooth at a station's z, or the largest over all z where that is NaN [MPa]; needs root stress.
  double tangent_stress(Member member, int tooth, double z = not_given) const;
  /// Places along the face where there is root stress [mm].
  std::vector<double> root_places(Member member, int tooth) const;
  double peak_stress() const;           ///< away from tip edges [MPa]
  double peak_stress(int tooth) const;  ///< of a tooth pair, edges too [MPa]
  /// Largest pressure of a tooth pair over a layer, edges too, if the line loads there were these times as large [MPa]; flanks without modifications.
  double peak_stress(int tooth, double begin, double end, double times = 1.0) const;
};

/// Sharp tips are rounded by 0.002 m_n.
/// @param torque     on the pinion [N mm]
/// @param structure    null: thin slices
/// @param root_stress  null: none
OwnAnswer own_answer(const ContactTask& task, double torque, const PairCompliance* structure, const PairRootStress* root_stress = nullptr);

/// Hertzian stress of what a layer carries, in the curvature of the undisturbed contact at its middle [MPa].
double hertzian_stress(const ContactTask& task, const LayerLoad& layer);

/// Largest hertzian_stress() of an answer [MPa].
double hertzian_peak(const ContactTask& task, const ContactAnswer& answer);

}  // namespace flankwright::contact_truth
