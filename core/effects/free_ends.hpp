#pragma once

#include <cmath>

#include "core/effects/effect.hpp"

namespace flankwright {

/// Near a gear's own end face nothing holds the flank along the axis, and contact is softer, see FreeEnd; on helical
/// teeth much more so at the acute end, less at the obtuse one. Where one gear is wider than its mate, the mate's end
/// is nearer to contact, and only its own side is softer there; the wider one's flank holds up the load's end, see load_end_support().
class FreeEndsEffect final : public Effect {
 public:
  std::string_view name() const override { return "free_ends"; }
  EffectStage stage() const override { return EffectStage::ContactSite; }
  std::string_view needs() const override { return "hertzian_contact"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    return {facts.loaded, facts.loaded ? "contact softens near the end faces" : "no load"};
  }
  void act(MeshBuilder& builder) const override {
    const GearPair& pair = builder.parts.pair;
    const double cos_base_helix = std::cos(pair.base_helix_angle);
    const auto distances = [&](const Gear& gear, double z) {
      const double half = 0.5 * gear.data.face_width;
      return std::array{(half + z) / cos_base_helix, (half - z) / cos_base_helix};
    };
    const auto lean = [&](Member member) { return -pair.acute_end(member) * std::abs(pair.base_helix_angle); };
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      const double z = builder.points[i].z;
      builder.end_distances[i] = {distances(pair.pinion, z), distances(pair.wheel, z - builder.parts.axial_offset()), lean(Member::Pinion),
                                  lean(Member::Wheel)};
    }
  }
};

}  // namespace flankwright
