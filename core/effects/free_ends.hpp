#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// Near a gear's own end face nothing holds the flank along the axis, and contact softens, see FreeEnd. Where one gear is wider
/// than its mate, the mate's end is the nearer one to contact, and its own side alone softens there.
class FreeEndsEffect final : public Effect {
 public:
  std::string_view name() const override { return "free_ends"; }
  EffectStage stage() const override { return EffectStage::ContactSite; }
  std::string_view needs() const override { return "hertzian_contact"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    return {facts.loaded, facts.loaded ? "contact softens near the end faces" : "no load"};
  }
  void act(MeshDraft& draft) const override {
    const auto distances = [](const Gear& gear, double z) {
      const double half = 0.5 * gear.data.face_width;
      return std::array{half + z, half - z};
    };
    for (std::size_t i = 0; i < draft.points.size(); ++i) {
      const double z = draft.points[i].z;
      draft.end_distances[i] = {distances(draft.parts.pair.pinion, z), distances(draft.parts.pair.wheel, z - draft.parts.axial_offset())};
    }
  }
};

}  // namespace flankwright
