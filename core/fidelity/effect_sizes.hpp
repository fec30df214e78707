#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/for_each_index.hpp"
#include "core/effects/effect_size.hpp"
#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// One load case, from which effects are left out. Everything that it refers to must outlive it.
struct EffectScene {
  GearPair pair;
  PerGear<Material> material;
  MeshResolution resolution;
  const PairCompliance* structure{nullptr};  ///< null: thin slices
  const PairCompliance* shafts{nullptr};     ///< null: rigid
  FlankCondition condition;                  ///< with all models, whatever effects are on
  double pinion_torque{not_given};           ///< [N mm], > 0
};

/// Meshes with one effect left out, each made once for all load cases that differ in torque, modifications and what else moves no point. Several threads may ask.
/// All scenes that are estimated with it have the same gears, resolution, compliance and effects.
class EffectMeshes {
 public:
  /// @param left_out  name of an effect; empty: none
  std::shared_ptr<const MeshModel> mesh(const std::string& left_out, const MeshPlacement& placement, const std::function<MeshModel()>& make);

 private:
  struct Entry {
    std::once_flag made;
    std::shared_ptr<const MeshModel> mesh;
  };
  std::mutex mutex_;
  std::map<std::pair<std::string, MeshPlacement>, Entry> entries_;
};

/// The outputs of a cycle by which effects are measured; NaN where a position failed.
CycleOutputs cycle_outputs(const LoadedCycle& cycle);

/// Outputs with the effects that are on.
/// @throws InvalidInput  as make_mesh_model()
CycleOutputs outputs_with(const EffectScene& scene, const EffectDecisions& decisions);

/// The contribution of an effect that is on, by leaving it out: two analyses. No number where nothing would be
/// compliant without it.
EffectInfluence exact_influence(const EffectScene& scene, const EffectDecisions& decisions, const std::string& name);

/// How an estimate was made.
struct EstimatedSize {
  EffectSize size;
  int positions{0};
  int solved_again{0};  ///< positions at which first order was not to be trusted
};

struct SizeOptions {
  /// The step is believed where it changes no load by more than trust * (the largest load), leaves none negative and lets no point
  /// penetrate [-], >= 0.
  double trust{0.25};
  std::optional<std::vector<std::string>> only{};  ///< names of the effects wanted; nothing: all
};

/// Sizes of the effects that are on and change a mesh, to first order at the solution with all of them.
///
/// Without an effect the same position has another influence matrix K', gap g', contact law c' or fewer points. The
/// loads w that were solved for leave there the residual r = K' a w + c'(w) + g' - f_t, and forces short by those on
/// points that are gone: one step of LoadSensitivity, a single factorisation, gives loads and f_t without the effect.
/// Of f_t it is exact to first order in what changes, sum a_i (dw_i/dF) (dK a w + dg + dc)_i. (For a mesh without gaps
/// and linear in its loads, dw/dF = w/F, the envelope theorem's sum a_i w_i (...)_i / F.) Where SizeOptions::trust is
/// exceeded the position is solved again.
/// @param meshes  shared between load cases
std::vector<EstimatedSize> estimate_effect_sizes(const EffectScene& scene, const EffectDecisions& decisions, const SizeOptions& options,
                                                 EffectMeshes& meshes);

/// Makes beforehand the meshes that estimate_effect_sizes() will ask for, side by side: load cases that are estimated at one time wait for each other's.
void make_effect_meshes(const EffectScene& scene, const EffectDecisions& decisions, EffectMeshes& meshes, const ForEachIndex& for_each);
std::vector<EstimatedSize> estimate_effect_sizes(const EffectScene& scene, const EffectDecisions& decisions, const SizeOptions& options = {});

}  // namespace flankwright
