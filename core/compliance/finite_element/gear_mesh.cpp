#include "core/compliance/finite_element/gear_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/compliance/finite_element/section_sweep.hpp"

namespace flankwright {
namespace {

/// Sizes from a face end to mid face that start at `first` and grow up to `largest`; their sum is about `half`.
std::vector<double> layer_sizes(double half, double first, double growth, double largest) {
  std::vector<double> sizes;
  double length = 0;
  for (double size = first; length < half; size = std::min(size * growth, largest)) {
    sizes.push_back(size);
    length += size;
  }
  if (sizes.size() > 1 && length - half > half - (length - sizes.back())) sizes.pop_back();
  return sizes;
}

/// Ends of the layers over the face: fine at both ends, coarse in between, symmetric about z = 0.
std::vector<double> face_planes(double face_width, double module, const GearMeshOptions& options) {
  const double half = face_width / 2, first = options.end_element * module;
  double largest = options.largest_element * module, growth = options.axial_growth;
  std::vector<double> sizes = layer_sizes(half, first, growth, largest);
  while (2 * std::ssize(sizes) > options.most_layers) {
    largest *= 1.02;
    growth = std::max(growth, 1 + largest / half);  // where growing alone takes more layers
    sizes = layer_sizes(half, first, growth, largest);
  }
  const double length = std::accumulate(sizes.begin(), sizes.end(), 0.0);
  std::vector<double> planes{-half};
  for (const double s : sizes) planes.push_back(planes.back() + s * half / length);
  planes.back() = 0;
  for (std::size_t i = sizes.size(); i-- > 0;) planes.push_back(-planes[i]);
  return planes;
}

/// Ends of the layers of one overhang, measured from the face end, ascending.
std::vector<double> overhang_planes(double length, double first, double growth) {
  std::vector<double> planes;
  double z = 0;
  for (double size = first; z < length; size *= growth) planes.push_back(z += size);
  const double scale = length / planes.back();
  for (double& plane : planes) plane *= scale;
  return planes;
}

}  // namespace

FaceNodes GearMesh::face_nodes(const MeshFace& face) const {
  FaceNodes result;
  for (int i = 0; i < 8; ++i) result.col(i) = solid.nodes.col(face[i]);
  return result;
}

GearBody complete_body(const GearBody& body, const ToothForm& form, double normal_module) {
  GearBody complete = body;
  if (std::isnan(body.shaft_diameter)) complete.shaft_diameter = default_shaft_diameter(form, normal_module);
  if (std::isnan(body.bore_diameter)) complete.bore_diameter = default_bore_share * complete.shaft_diameter;
  if (std::isnan(body.shaft_overhang)) complete.shaft_overhang = 0.5 * complete.shaft_diameter;
  return complete;
}

GearMesh gear_mesh(const GearToMesh& gear, const GearMeshOptions& options) {
  GearMesh mesh{ToothForm(gear.gear, gear.normal_module, gear.pressure_angle, gear.helix_angle)};
  const double width = gear.gear.face_width;
  if (!(width > 0) || !std::isfinite(width)) throw InvalidInput("face_width", std::to_string(width), "more than 0 mm");
  mesh.teeth = gear.gear.teeth;
  mesh.normal_module = gear.normal_module;
  mesh.face_width = width;
  mesh.teeth_each_side = options.teeth_each_side;
  const GearBody body = complete_body(gear.body, mesh.form, gear.normal_module);
  mesh.shaft_diameter = body.shaft_diameter;
  mesh.rigid_body = body.rigid;
  mesh.torque_end = (body.torque_end == FaceEnd::Acute ? -0.5 : 0.5) * width;
  const SectionMesh section = section_mesh(mesh.form, mesh.teeth, mesh.normal_module, body, options);
  const double overhang = body.shaft_overhang;
  if (!(overhang > 0) || !std::isfinite(overhang)) {
    throw InvalidInput("body.shaft_overhang", std::to_string(overhang), "more than 0 mm");
  }

  mesh.planes = face_planes(width, gear.normal_module, options);
  const std::vector<double> beyond = overhang_planes(overhang, options.largest_element * gear.normal_module, options.body_growth);
  SweepPlanes planes;
  for (std::size_t i = beyond.size(); i-- > 0;) planes.z.push_back(-width / 2 - beyond[i]);
  planes.first = static_cast<int>(planes.z.size());
  planes.z.insert(planes.z.end(), mesh.planes.begin(), mesh.planes.end());
  planes.last = static_cast<int>(planes.z.size()) - 1;
  for (const double z : beyond) planes.z.push_back(width / 2 + z);
  const int last_plane = static_cast<int>(planes.z.size()) - 1;

  SectionSweep sweep(section, planes, std::tan(gear.helix_angle) / mesh.form.reference_radius(), options.layer_share);
  mesh.tooth_surfaces.resize(section.teeth.size());
  std::vector<int> latest(static_cast<std::size_t>(section.quads.cols()), -1);  // brick of every quad
  for (int layer = 0; layer < last_plane; ++layer) {
    const bool toothed = layer >= planes.first && layer < planes.last;
    if (toothed) mesh.shaft_bricks.emplace_back();
    for (Eigen::Index quad = 0; quad < section.quads.cols(); ++quad) {
      const bool in_shaft = section.parts[static_cast<std::size_t>(quad)] == SectionPart::Shaft;
      if (!toothed && !in_shaft) continue;
      int& brick = latest[static_cast<std::size_t>(quad)];
      const LayerSpan span = sweep.span_of_quad(quad, layer);
      if (span.lower == layer) brick = sweep.brick(quad, span);
      if (toothed && in_shaft) mesh.shaft_bricks.back().push_back(brick);
    }
    if (!toothed) continue;
    for (std::size_t m = 0; m < section.teeth.size(); ++m) {
      const SectionTooth& lines = section.teeth[m];
      ToothSurfaces& surfaces = mesh.tooth_surfaces[m];
      const auto add = [&](const std::vector<SectionEdge>& edges, std::vector<MeshFace>& faces) {
        for (const SectionEdge& edge : edges) {
          const LayerSpan span = sweep.span_of_edge(edge, layer);
          if (span.lower == layer) faces.push_back(sweep.face(edge, span));
        }
      };
      add(lines.centre_line, surfaces.centre);
      add(lines.flank, surfaces.flank);
      add(lines.fillet, surfaces.fillet);
    }
  }
  const bool at_acute_end = body.torque_end == FaceEnd::Acute;
  const std::vector<int> held = sweep.on_plane(at_acute_end ? 0 : last_plane), guided = sweep.on_plane(at_acute_end ? last_plane : 0);
  mesh.solid = sweep.take();
  // The solid model's requirement on every brick; shape and options together decide whether one folds.
  if (!(mesh.solid.quality() > 0)) {
    throw InvalidInput("options", "an element is folded", "element numbers and sizes that fit this tooth and body");
  }

  std::vector<char> follows(static_cast<std::size_t>(mesh.solid.nodes.cols()), 0);
  for (const TiedNode& tie : mesh.solid.tied) follows[static_cast<std::size_t>(tie.node)] = 1;
  if (body.rigid) {
    const double rim = rim_radius(mesh.form, body.shaft_diameter, mesh.normal_module) * (1 + 1e-9);  // round-off of its nodes
    for (int node = 0; node < mesh.solid.nodes.cols(); ++node) {
      const bool in_body = mesh.solid.nodes.col(node).head<2>().norm() <= rim;
      if (in_body && !follows[static_cast<std::size_t>(node)]) mesh.supports.push_back({.node = node});
    }
    return mesh;
  }
  for (const int node : held) {
    if (!follows[static_cast<std::size_t>(node)]) mesh.supports.push_back({.node = node});
  }
  for (const int node : guided) {
    if (follows[static_cast<std::size_t>(node)]) continue;
    const Eigen::Vector2d out = mesh.solid.nodes.col(node).head<2>().normalized();
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    frame.topLeftCorner<2, 2>() << out.x(), -out.y(), out.y(), out.x();
    mesh.supports.push_back({node, {true, false, false}, frame});
  }
  return mesh;
}

}  // namespace flankwright
