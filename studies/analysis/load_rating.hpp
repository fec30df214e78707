#pragma once

#include <functional>
#include <vector>

#include "core/rating/peak_gradient.hpp"

namespace flankwright::studies {

/// Refined peaks of one load case, and what load distribution factors compare them with.
struct LoadRating {
  Quadrature quadrature{};  ///< of the lines
  SpikeRule spikes;
  ContactPeaks perfect, lead, profile, combined;  ///< of the parts of the condition, see load_factors.hpp
  LoadFactors factors;
  PeakGradients peak_gradients, perfect_gradients;  ///< of the whole condition and of the perfect part
  LoadFactorGradients factor_gradients;             ///< empty rows where no derivatives were asked for
};

/// The mesh for a condition, see MeshPlacement, with what derivatives by these parameters need, see with_perturbed_meshes().
/// @param shafts_deflect  false: they are rigid
using MeshFor = std::function<MeshAt(const FlankCondition& condition, bool shafts_deflect, const std::vector<MeshParameter>& parameters)>;

/// Rates load cases of one pair. Peaks of a condition are sought once: the perfect pair's serve every scene at the same torque.
class LoadRater {
 public:
  /// The pair has shafts that deflect; else meshes with and without them are the same.
  bool has_shafts{false};
  PeakSearch search{};

  /// A load case, and how its mesh is made.
  struct Case {
    MeshFor mesh_for;
    FlankCondition condition;
    double pinion_torque{not_given};  ///< [N mm]
    double rim_opening{0.0};          ///< under it, rim_opening() [mm]; 0: no gear is on a web
  };
  /// Seeks the peaks of all parts of the conditions of load cases, each once, on all threads.
  void seek(const std::vector<Case>& cases);

  /// @param parameters  derivatives are given with respect to these; none by default
  LoadRating rate(const Case& load_case, const std::vector<MeshParameter>& parameters = {});

 private:
  struct Known {
    FlankCondition condition;
    double torque;
    bool shafts_deflect;
    ContactPeaks peaks;
  };
  const Known* find(const FlankCondition& condition, double pinion_torque, bool shafts_deflect) const;
  const ContactPeaks& peaks_of(const Case& load_case, ConditionPart part);
  static FlankCondition condition_of(const Case& of, ConditionPart part) { return part_without_rims(of.condition, part, of.rim_opening); }
  bool with_shafts(ConditionPart part) const { return has_shafts && shafts_deflect(part); }

  std::vector<Known> known_;
};

}  // namespace flankwright::studies
