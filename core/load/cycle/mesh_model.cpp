#include "core/load/cycle/mesh_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <string>

#include "core/base/error.hpp"
#include "core/compliance/local/hertz_line.hpp"
#include "core/contact/gap/condition_gap.hpp"

namespace flankwright {

namespace {

constexpr std::initializer_list<EffectStage> local_stages{EffectStage::ContactSite, EffectStage::ContactLaw};

/// The face ends that lines reach: no further from a line's last point than that is from the one before.
std::vector<FaceEndOfLine> face_ends(const MeshModel& model, const PathOfContact& path, const MeshPosition& at, const LineInterval& face) {
  std::vector<FaceEndOfLine> ends;
  if (at.laws.empty()) return ends;
  const std::vector<ContactPoint>& points = at.points;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    while (end < points.size() && points[end].tooth == points[begin].tooth) ++end;
    if (end - begin < 2) continue;
    const auto add = [&](std::size_t last, std::size_t before, double z) {
      if (std::abs(z - points[last].z) > std::abs(points[last].z - points[before].z)) return;
      const auto place = model.place(path, at.phase, points[last].tooth, z);
      if (!place) return;
      const auto law = model.contact_law(*place);
      if (law) ends.push_back({static_cast<Eigen::Index>(last), before > last ? 1 : -1, *place, *law});
    };
    add(begin, begin + 1, face.begin);
    add(end - 1, end - 2, face.end);
  }
  return ends;
}

MeshPosition make_position(const MeshModel& model, const MeshParts& parts, const PathOfContact& path, const Quadrature& quadrature, double phase,
                           const LineInterval& face) {
  MeshBuilder builder(parts, phase);
  model.effects.act(EffectStage::Region, builder);
  builder.set_points(contact_points(model.pair, path, quadrature, phase, builder.with_extended_region, face.begin, face.end));
  model.effects.act({EffectStage::Placement, EffectStage::Body, EffectStage::Structure, EffectStage::Coupling}, builder);
  model.effects.act(local_stages, builder);
  model.effects.act({EffectStage::ContactCoupling, EffectStage::Roots}, builder);
  MeshPosition position{phase, std::move(builder.points), {}, std::move(builder.influence), std::move(builder.laws), std::move(builder.root_stress)};
  position.weight.resize(std::ssize(position.points));
  for (Eigen::Index i = 0; i < position.weight.size(); ++i) position.weight[i] = position.points[static_cast<std::size_t>(i)].weight;
  position.face_ends = face_ends(model, path, position, face);
  position.outside = std::move(builder.outside);
  position.shaft_compliance = builder.shaft_compliance;
  position.even_load_compliance = std::move(builder.even_load_compliance);
  return position;
}

}  // namespace

std::vector<double> equally_spaced_phases(int n) {
  std::vector<double> phases(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) phases[static_cast<std::size_t>(i)] = static_cast<double>(i) / n;
  return phases;
}

std::optional<ContactPoint> MeshModel::place(const PathOfContact& path, double phase, int tooth, double z) const {
  const MeshParts parts{.pair = pair, .material = material, .placement = placement};
  MeshBuilder builder(parts, phase);
  effects.act(EffectStage::Region, builder);
  const auto point = contact_point(pair, path, phase, tooth, z, builder.with_extended_region);
  if (!point) return std::nullopt;
  builder.set_points({*point});
  effects.act(EffectStage::Placement, builder);
  return builder.points.empty() ? std::nullopt : std::optional(builder.points.front());
}

std::optional<ContactLaw> MeshModel::contact_law(const ContactPoint& point) const {
  const MeshParts parts{.pair = pair, .material = material, .placement = placement, .half_space = half_space};
  MeshBuilder builder(parts, point.phase);
  builder.set_points({point});
  effects.act(local_stages, builder);
  return builder.laws.empty() ? std::nullopt : std::optional(builder.laws.front());
}

double MeshModel::normal_force(double pinion_torque) const { return pinion_torque / (pair.pinion.base_radius * std::cos(pair.base_helix_angle)); }

double MeshModel::mean_line_load(double force) const {
  return force * std::cos(pair.base_helix_angle) / (pair.transverse_contact_ratio * face_width);
}

MeshPlacement placement_of(GapModel gap, const FlankCondition& condition, const PairCompliance* shafts, double pinion_torque) {
  MeshPlacement placement = MeshPlacement::of(gap, condition.misalignment, shafts != nullptr && shafts->depends_on_load() ? pinion_torque : 0.0);
  placement.other_flanks = condition.other_flanks;
  return placement;
}

namespace {

/// A model of the pair as it acts on the flanks that touch. Of null it is null.
template <class PairModel>
class OnTouchingFlanks {
 public:
  /// @param model  must outlive this
  OnTouchingFlanks(const PairModel* model, bool other_flanks, const char* what) : model_(model) {
    if (!other_flanks || model == nullptr) return;
    other_ = model->on_other_flanks();
    if (!other_) throw InvalidInput("working_flank", "the other flanks", std::string("the pair's own with ") + what);
    model_ = other_.get();
  }
  const PairModel* get() const { return model_; }

 private:
  std::shared_ptr<const PairModel> other_;
  const PairModel* model_;
};

}  // namespace

Gap gap_under(const MeshPosition& at, const ConditionGap& gaps, double force) {
  Gap gap = gaps.at(at.points, at.phase);
  at.outside.add_to(gap.total, force);
  return gap;
}

MeshModel make_mesh_model(const GearPair& pair, const PerGear<Material>& material, const MeshResolution& resolution, const MeshEffects& effects,
                          const MeshPlacement& placement, const MeshCompliance& compliance, const ForEachIndex& for_each) {
  const ThinSlicePair slices(ThinSlice(pair, material.pinion, material.wheel));
  MeshModel model;
  model.pair = pair;
  model.material = material;
  model.contact_modulus = contact_modulus(material.pinion, material.wheel);
  model.calibration = slices.slice().calibration();
  model.iso = slices.slice().iso();
  MeshCompliance yielding = compliance;
  if (yielding.structure == nullptr) yielding.structure = &slices;
  return mesh_with_effects(std::move(model), resolution, effects, placement, yielding, for_each);
}

MeshModel mesh_with_effects(MeshModel model, const MeshResolution& resolution, const MeshEffects& effects, const MeshPlacement& placement,
                            const MeshCompliance& compliance, const ForEachIndex& for_each) {
  assert(compliance.structure != nullptr);
  if (!effects.make_compliant()) throw InvalidInput("fidelity.effects", "neither bending nor hertzian_contact", "at least one of them under load");
  if (resolution.phases.empty()) throw InvalidInput("cycle.phases", "none", "at least one phase");
  if (resolution.quadrature.intervals < 1) {
    throw InvalidInput("fidelity.quadrature.intervals", std::to_string(resolution.quadrature.intervals), "at least 1");
  }
  if (placement.other_flanks != model.placement.other_flanks) model.pair = model.pair.on_other_flanks();
  const OnTouchingFlanks touching_structure(compliance.structure, placement.other_flanks, "this structure");
  const OnTouchingFlanks touching_root_stress(compliance.root_stress, placement.other_flanks, "this model of root stress");
  const OnTouchingFlanks touching_shafts(compliance.shafts, placement.other_flanks, "shafts");
  const GearPair& pair = model.pair;
  const double axial_offset = placement.misalignment.axial_offset;
  const double face_start = std::max(pair.pinion.face.begin, axial_offset + pair.wheel.face.begin);
  const double face_end = std::min(pair.pinion.face.end, axial_offset + pair.wheel.face.end);
  if (!(face_start < face_end)) {
    throw InvalidInput("misalignment.axial_offset", std::to_string(axial_offset), "one that leaves a common face width");
  }
  model.effects = effects;
  model.placement = placement;
  model.axial_offset = axial_offset;
  model.face_width = face_end - face_start;
  model.half_space = compliance.structure->half_space_corrections();
  model.couples_points = compliance.structure->couples_points();
  const std::shared_ptr<const PairCompliance> linearised =
      compliance.shafts != nullptr && compliance.shafts->depends_on_load() ? touching_shafts.get()->linearised_at(placement.torque) : nullptr;
  const MeshParts parts{pair,
                        model.material,
                        placement,
                        touching_structure.get(),
                        linearised ? linearised.get() : touching_shafts.get(),
                        touching_root_stress.get(),
                        model.half_space};
  const PathOfContact path(pair);
  std::vector<MeshPosition> positions(resolution.phases.size());
  const auto make = [&](std::size_t i) {
    positions[i] = make_position(model, parts, path, resolution.quadrature, resolution.phases[i], {face_start, face_end});
  };
  run_for_each(for_each, positions.size(), make);
  model.positions = std::move(positions);
  return model;
}

}  // namespace flankwright
