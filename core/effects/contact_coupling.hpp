#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/compliance/local/contact_kernel.hpp"
#include "core/effects/effect.hpp"

namespace flankwright {

/// Contact yields under the loads beside it as well. The contact law is that of an even load. Where the load rises, falls or ends along the line, the
/// loads beside a point sink it more or less than an even load would. The influence matrix gets what the kernel g of both bodies has between the points of a line,
/// and loses on its diagonal what the laws have of g already for an even load over the common usable face [mm/N],
///
///     K_ij = g_ij,    K_ii a_i = int_line g dt - sum over j != i of a_j g_ij - int_face g dt,
///
/// a the lengths of line that belong to the points, one behind the other, and g_ij the mean of g over two of them. The value at the points would miss what g has within
/// half such a length: where a relief begins the load has a kink, and peaks would be 1 % low. An even load over the face is left as it was. A line that ends on the face, at a tip, has the support of
/// what is not loaded beyond. Beside thin slices, which do not support each other, it does nothing.
class ContactCouplingEffect final : public Effect {
 public:
  std::string_view name() const override { return "contact_coupling"; }
  EffectStage stage() const override { return EffectStage::ContactCoupling; }
  std::string_view needs() const override { return "hertzian_contact"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool on = facts.loaded && facts.coupled_teeth;
    return {on, on ? "loads vary along the lines" : "no load, or a compliance model without coupling"};
  }
  void act(MeshBuilder& builder) const override {
    const MeshParts& parts = builder.parts;
    if (parts.half_space.pinion) couple(builder, Member::Pinion);
    if (parts.half_space.wheel) couple(builder, Member::Wheel);
  }

 private:
  static void couple(MeshBuilder& builder, Member member) {
    const MeshParts& parts = builder.parts;
    const GearPair& pair = parts.pair;
    const Material& material = parts.material[member];
    // Lengths along the line of contact, z / cos(beta_b).
    const double slant = std::cos(pair.base_helix_angle), unit = 2.0 / (units::pi * material.youngs_modulus);
    const auto range = [&](double begin, double end) { return ContactKernel::Range{begin / slant, end / slant}; };
    const double offset = parts.axial_offset(), middle = member == Member::Wheel ? offset : 0.0, half = 0.5 * pair[member].data.face_width;
    const ContactKernel kernel(material.poissons_ratio, range(middle - half, middle + half),
                               -pair.acute_end(member) * std::abs(pair.base_helix_angle), builder.has_free_ends());
    const FaceRange &pinion = pair.pinion.face, &wheel = pair.wheel.face;
    const ContactKernel::Range common = range(std::max(pinion.begin, offset + wheel.begin), std::min(pinion.end, offset + wheel.end));

    const std::vector<ContactPoint>& points = builder.points;
    const auto depth = [&](std::size_t i) { return member == Member::Pinion ? points[i].pinion_depth : points[i].wheel_depth; };
    for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
      double length = 0.0, moment = 0.0;
      for (; last < points.size() && points[last].tooth == points[first].tooth; ++last) {
        length += points[last].weight;
        moment += points[last].weight * points[last].z / slant;
      }
      // The rule integrates s over the line exactly, so that the line lies about the mean of its points.
      const ContactKernel::Range line{moment / length - 0.5 * length, moment / length + 0.5 * length};
      for (std::size_t i = first; i < last; ++i) {
        const double s = points[i].z / slant, even = unit * kernel.over(s, common, depth(i));
        builder.even_load_compliance[static_cast<Eigen::Index>(i)] += even;
        builder.influence(i, i) += (unit * kernel.over(s, line, depth(i)) - even) / points[i].weight;
      }
      std::vector<ContactKernel::Range> of_points;
      for (std::size_t i = first; i < last; ++i) {
        const double begin = of_points.empty() ? line.begin : of_points.back().end;
        of_points.push_back({begin, begin + points[i].weight});
      }
      for (std::size_t i = first; i < last; ++i) {
        for (std::size_t j = first; j < i; ++j) {
          const double g = unit * kernel.between(of_points[i - first], of_points[j - first], 0.5 * (depth(i) + depth(j)));
          builder.influence(i, j) += g;
          builder.influence(j, i) += g;
          builder.influence(i, i) -= g * points[j].weight / points[i].weight;
          builder.influence(j, j) -= g * points[i].weight / points[j].weight;
        }
      }
    }
  }
};

}  // namespace flankwright
