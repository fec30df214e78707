#include "core/load/mesh_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/compliance/hertz_line.hpp"
#include "core/load/placed_points.hpp"

namespace flankwright {

namespace {

/// Leaves of an influence matrix what lies on one tooth; its blocks stay positive semi-definite.
void uncouple_teeth(const std::vector<ContactPoint>& points, Eigen::MatrixXd& influence) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (points[i].tooth != points[j].tooth) influence(i, j) = 0.0;
    }
  }
}

MeshPosition make_position(const MeshModel& model, const PathOfContact& path, const PairCompliance& structure,
                           const PairCompliance* shafts, const Quadrature& quadrature, double phase, double face_start, double face_end) {
  MeshPosition position;
  position.phase = phase;
  const std::vector<ContactPoint> in_plane =
      contact_points(model.pair, path, quadrature, phase, model.effects.extended_contact_region, face_start, face_end);
  position.points = placed_points(model.pair, model.placement, in_plane, phase);
  const Eigen::Index n = static_cast<Eigen::Index>(position.points.size());
  position.weight.resize(n);
  position.influence = model.effects.bending ? structure.influence(position.points, model.axial_offset)
                                             : Eigen::MatrixXd::Zero(n, n);
  if (!model.effects.adjacent_teeth) uncouple_teeth(position.points, position.influence);
  if (shafts) position.influence += shafts->influence(position.points, model.axial_offset);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ContactPoint& point = position.points[static_cast<std::size_t>(i)];
    position.weight[i] = point.weight;
    if (model.effects.hertzian_contact) position.laws.push_back(model.contact_law(point));
  }
  return position;
}

}  // namespace

std::vector<double> equally_spaced_phases(int n) {
  std::vector<double> phases(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) phases[static_cast<std::size_t>(i)] = static_cast<double>(i) / n;
  return phases;
}

MeshPlacement MeshPlacement::of(GapModel gap, const Misalignment& misalignment) {
  MeshPlacement placement{gap, {}};
  placement.misalignment.axial_offset = misalignment.axial_offset;
  if (gap == GapModel::WholeSurface) placement.misalignment = misalignment;
  return placement;
}

ContactLaw MeshModel::contact_law(const ContactPoint& point) const {
  const double no_tip = std::numeric_limits<double>::infinity();
  return {ContactSide::of(pinion_material, point.pinion_depth, effects.tip_corner ? point.pinion_tip_distance : no_tip),
          ContactSide::of(wheel_material, point.wheel_depth, effects.tip_corner ? point.wheel_tip_distance : no_tip),
          point.relative_radius, contact_modulus};
}

double MeshModel::normal_force(double pinion_torque) const {
  return pinion_torque / (pair.pinion.base_radius * std::cos(pair.base_helix_angle));
}

double MeshModel::mean_line_load(double force) const {
  double length = 0.0;
  for (const MeshPosition& position : positions) {
    for (const ContactPoint& point : position.points) length += point.clearance == 0.0 ? point.weight : 0.0;
  }
  return force * static_cast<double>(positions.size()) / length;
}

MeshModel make_mesh_model(const GearPair& pair, const Material& pinion_material, const Material& wheel_material,
                          const MeshResolution& resolution, const MeshEffects& effects, const MeshPlacement& placement,
                          const PairCompliance* structure, const PairRootStress* root_stress,
                          const PairCompliance* shafts) {
  if (!effects.bending && !effects.hertzian_contact) {
    throw InvalidInput("fidelity.effects", "neither bending nor hertzian_contact", "at least one of them under load");
  }
  if (resolution.phases.empty()) throw InvalidInput("cycle.phases", "none", "at least one phase");
  if (resolution.quadrature.intervals < 1) {
    throw InvalidInput("fidelity.quadrature.intervals", std::to_string(resolution.quadrature.intervals), "at least 1");
  }
  const double axial_offset = placement.misalignment.axial_offset;
  const double face_start = std::max(-0.5 * pair.pinion.data.face_width, axial_offset - 0.5 * pair.wheel.data.face_width);
  const double face_end = std::min(0.5 * pair.pinion.data.face_width, axial_offset + 0.5 * pair.wheel.data.face_width);
  if (!(face_start < face_end)) {
    throw InvalidInput("misalignment.axial_offset", std::to_string(axial_offset), "one that leaves a common face width");
  }
  const ThinSlicePair slices(ThinSlice(pair, pinion_material, wheel_material));
  MeshModel model;
  model.pair = pair;
  model.pinion_material = pinion_material;
  model.wheel_material = wheel_material;
  model.effects = effects;
  model.placement = placement;
  model.axial_offset = axial_offset;
  model.face_width = face_end - face_start;
  model.contact_modulus = contact_modulus(pinion_material, wheel_material);
  model.calibration = slices.slice().calibration();
  model.iso = slices.slice().iso();
  const PathOfContact path(pair);
  model.positions.reserve(resolution.phases.size());
  for (double phase : resolution.phases) {
    model.positions.push_back(make_position(model, path, structure != nullptr ? *structure : slices, shafts, resolution.quadrature, phase, face_start, face_end));
    MeshPosition& position = model.positions.back();
    if (root_stress) position.root_stress = root_stress->influence(position.points, axial_offset);
  }
  return model;
}

}  // namespace flankwright
