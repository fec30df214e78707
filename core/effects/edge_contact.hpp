#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// Where contact reaches a tip edge the contact strip lies on flank and rounding, or ends at the sharp edge, see StripContact. No pressure is known on a
/// sharp one.
class EdgeContactEffect final : public Effect {
 public:
  std::string_view name() const override { return "edge_contact"; }
  EffectStage stage() const override { return EffectStage::ContactSite; }
  std::string_view needs() const override { return "hertzian_contact"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    if (!facts.loaded) return {false, "no load"};
    return {true, facts.rounded_tips ? "tips are rounded" : "tips are sharp: they carry load, but no pressure is known there"};
  }
  void act(MeshBuilder& builder) const override {
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      const TipEdge& edge = builder.points[i].tip_edge;
      if (edge.radius >= 0.0) builder.tip_edges[i] = RoundedEdge{edge.radius, edge.distance};
    }
  }
};

}  // namespace flankwright
