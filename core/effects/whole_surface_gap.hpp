#pragma once

#include "core/contact/gap/surface_gap.hpp"
#include "core/effects/effect.hpp"

namespace flankwright {

/// Contact off the plane of action: points lie where the misaligned, unmodified flanks are nearest in their sections
/// (SurfaceGap::place), without those whose sections miss the mate. The gap there is ConditionGap's, by the same placement.
class WholeSurfaceGapEffect final : public Effect {
 public:
  std::string_view name() const override { return "whole_surface_gap"; }
  EffectStage stage() const override { return EffectStage::Placement; }
  bool listed() const override { return false; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool on = facts.loaded && facts.whole_surface;
    return {on, on ? "fidelity.gap seeks contact over the whole flanks" : "no load, or fidelity.gap keeps contact in the plane of action"};
  }
  void act(MeshBuilder& builder) const override {
    if (builder.parts.placement.gap != GapModel::WholeSurface) return;
    FlankCondition unmodified;
    unmodified.misalignment = builder.parts.placement.misalignment;
    builder.set_points(SurfaceGap(builder.parts.pair, unmodified).place(builder.points, builder.phase));
  }
};

}  // namespace flankwright
