#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// A load on one tooth moves the others through the gear body.
class AdjacentTeethEffect final : public Effect {
 public:
  std::string_view name() const override { return "adjacent_teeth"; }
  EffectStage stage() const override { return EffectStage::Coupling; }
  std::string_view needs() const override { return "bending"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool on = facts.loaded && facts.coupled_teeth;
    return {on, on ? "a loaded tooth moves its neighbours" : "no load, or a compliance model without coupling of teeth"};
  }
  /// The structure's blocks between points of different teeth.
  void act(MeshBuilder& builder) const override {
    const Eigen::MatrixXd& structure = builder.structural_influence();
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      for (std::size_t j = 0; j < builder.points.size(); ++j) {
        if (builder.points[i].tooth != builder.points[j].tooth) builder.influence(i, j) += structure(i, j);
      }
    }
  }
};

}  // namespace flankwright
