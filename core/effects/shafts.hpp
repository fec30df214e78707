#pragma once

#include <algorithm>

#include "core/effects/effect.hpp"

namespace flankwright {

/// Shafts bend, shear and twist on their bearings, which moves all points together, see ShaftPair; what other meshes and loads do to them opens the gap.
class ShaftsEffect final : public Effect {
 public:
  std::string_view name() const override { return "shafts"; }
  EffectStage stage() const override { return EffectStage::Structure; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool on = facts.loaded && facts.shafts;
    return {on, on ? "a gear's shaft is described" : "no load, or no shaft is described: they are rigid"};
  }
  void act(MeshBuilder& builder) const override {
    if (builder.parts.shafts == nullptr) return;
    const Eigen::MatrixXd yielding = builder.parts.shafts->influence(builder.points, builder.parts.axial_offset());
    builder.influence += yielding;
    if (yielding.size() > 0) builder.shaft_compliance = std::max(0.0, yielding.mean());
    builder.outside = builder.parts.shafts->outside_motion(builder.points, builder.parts.axial_offset());
  }
};

}  // namespace flankwright
