#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// A loaded tooth deflects, with the material below it.
class BendingEffect final : public Effect {
 public:
  std::string_view name() const override { return "bending"; }
  EffectStage stage() const override { return EffectStage::Structure; }
  bool makes_compliant() const override { return true; }
  EffectCall called_for(const EffectFacts& facts) const override { return {facts.loaded, facts.loaded ? "teeth bend under load" : "no load"}; }
  /// The structure's blocks between points of one tooth; they are positive semi-definite on their own.
  void act(MeshBuilder& builder) const override {
    const Eigen::MatrixXd& structure = builder.structural_influence();
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      for (std::size_t j = 0; j < builder.points.size(); ++j) {
        if (builder.points[i].tooth == builder.points[j].tooth) builder.influence(i, j) += structure(i, j);
      }
    }
  }
};

}  // namespace flankwright
