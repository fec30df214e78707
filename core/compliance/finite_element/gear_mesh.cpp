#include "core/compliance/finite_element/gear_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
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

/// Puts a plane at z: moves a free one nearby, or adds one.
/// @param fixed  planes that may not be moved, besides the face ends; z becomes one of them
void put_plane(std::vector<double>& planes, double z, std::vector<double>& fixed) {
  constexpr double kNear = 0.3;  // of the layer: the neighbours then stay within a factor of two of each other
  const auto is_free = [&](double plane) {
    return plane != planes.front() && plane != planes.back() && std::ranges::find(fixed, plane) == fixed.end();
  };
  const auto above = std::ranges::upper_bound(planes, z);
  if (above == planes.begin() || above == planes.end()) return;  // at a face end, or beyond
  double &upper = *above, &lower = *(above - 1);
  const double layer = upper - lower;
  if (is_free(upper) && upper - z < kNear * layer) {
    upper = z;
  } else if (is_free(lower) && z - lower < kNear * layer) {
    lower = z;
  } else if (z > lower) {
    planes.insert(above, z);
  }
  fixed.push_back(z);
}

/// The planes of all layers, and between which each part of the body lies.
SweepPlanes sweep_planes(const GearBody& body, double width, double module, const GearMeshOptions& options) {
  std::vector<double> face = face_planes(width, module, options);
  double hub_beyond = 0;                      // each face end
  std::vector<double> web_ends, kept, fixed;  // the latter on the face
  if (body.web) {
    const WebbedBody& web = *body.web;
    const double lower = web.web_offset - web.web_thickness / 2, upper = web.web_offset + web.web_thickness / 2;
    const double round_off = 1e-9 * width;
    const auto within = [&](double z) { return std::abs(z) < width / 2 - round_off; };
    if (web.hub_width > width + round_off) hub_beyond = (web.hub_width - width) / 2;
    web_ends = {std::max(lower, -width / 2), std::min(upper, width / 2)};
    kept = {web_ends[0], web_ends[1], web.web_offset};  // two layers at least over the thickness of a web
    if (within(web.hub_width / 2)) kept.insert(kept.end(), {-web.hub_width / 2, web.hub_width / 2});
    for (const double z : kept) {
      if (within(z)) put_plane(face, z, fixed);
    }
  }
  SweepPlanes planes;
  const double first = options.largest_element * module;
  std::vector<double> beyond;
  if (hub_beyond > 0) beyond = overhang_planes(hub_beyond, first, options.body_growth);
  const auto of_hub = static_cast<int>(beyond.size());
  if (body.hold == BodyHold::Shaft) {
    for (const double z : overhang_planes(body.shaft_overhang, first, options.body_growth)) beyond.push_back(hub_beyond + z);
  }
  for (std::size_t i = beyond.size(); i-- > 0;) planes.z.push_back(-width / 2 - beyond[i]);
  planes.first = static_cast<int>(planes.z.size());
  planes.z.insert(planes.z.end(), face.begin(), face.end());
  planes.last = static_cast<int>(planes.z.size()) - 1;
  for (const double z : beyond) planes.z.push_back(width / 2 + z);

  const auto number = [&](double z) {  // of the plane at z, or of the nearest
    const auto nearest = std::ranges::min_element(planes.z, {}, [&](double plane) { return std::abs(plane - z); });
    return static_cast<int>(nearest - planes.z.begin());
  };
  const LayerSpan on_face{planes.first, planes.last};
  planes.of(SectionPart::LoadedTooth) = planes.of(SectionPart::Body) = on_face;
  if (body.hold == BodyHold::Shaft) planes.of(SectionPart::Shaft) = {0, static_cast<int>(planes.z.size()) - 1};
  if (!body.web) return planes;
  const double half_hub = body.web->hub_width / 2;
  planes.of(SectionPart::Web) = planes.of(SectionPart::HoledWeb) = {number(web_ends[0]), number(web_ends[1])};
  planes.of(SectionPart::Hub) =
      half_hub < width / 2 ? LayerSpan{number(-half_hub), number(half_hub)} : LayerSpan{planes.first - of_hub, planes.last + of_hub};
  for (const double z : kept) planes.kept.push_back(number(z));
  std::ranges::sort(planes.kept);
  return planes;
}

/// Notes a brick that belongs to the rim below the root circle.
void add_to_rim(const SectionMesh& section, Eigen::Index quad, int brick, GearMesh& mesh) {
  const SectionPart part = section.parts[static_cast<std::size_t>(quad)];
  if (part != SectionPart::LoadedTooth && part != SectionPart::Body) return;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (int i = 0; i < 4; ++i) centre += section.nodes.col(section.quads(i, quad)) / 4;
  if (centre.norm() > section.root_radius) return;
  const auto tooth = static_cast<int>(std::lround(std::atan2(-centre.x(), centre.y()) * mesh.teeth / (2 * units::pi)));
  RimBrick& of_rim = mesh.rim.emplace_back(RimBrick{brick});
  if (std::abs(tooth) <= mesh.teeth_each_side) of_rim.tooth = tooth;
}

}  // namespace

FaceNodes GearMesh::face_nodes(const MeshFace& face) const {
  FaceNodes result;
  for (int i = 0; i < 8; ++i) result.col(i) = solid.nodes.col(face[i]);
  return result;
}

GearMesh gear_mesh(const GearToMesh& gear, const GearMeshOptions& options) {
  GearMesh mesh{ToothForm(gear.gear, gear.normal_module, gear.pressure_angle, gear.helix_angle)};
  const double width = gear.gear.face_width;
  if (!(width > 0) || !std::isfinite(width)) throw InvalidInput("face_width", std::to_string(width), "more than 0 mm");
  mesh.teeth = gear.gear.teeth;
  mesh.normal_module = gear.normal_module;
  mesh.face_width = width;
  mesh.teeth_each_side = options.teeth_each_side;
  const GearBody body = complete_body(gear.body, mesh.form, gear.normal_module, width);
  mesh.shaft_diameter = body.shaft_diameter;
  mesh.rigid_body = body.rigid;
  mesh.rigid_bore = body.hold == BodyHold::RigidBore;
  mesh.torque_end = (body.torque_end == FaceEnd::Acute ? -0.5 : 0.5) * width;
  const SectionMesh section = section_mesh(mesh.form, mesh.teeth, mesh.normal_module, width, body, options);
  const SweepPlanes planes = sweep_planes(body, width, gear.normal_module, options);
  mesh.planes.assign(planes.z.begin() + planes.first, planes.z.begin() + planes.last + 1);
  const int last_plane = static_cast<int>(planes.z.size()) - 1;

  SectionSweep sweep(section, planes, std::tan(gear.helix_angle) / mesh.form.reference_radius(), options.layer_share);
  mesh.tooth_surfaces.resize(section.teeth.size());
  std::vector<double> stiffness;                                                // of every brick, where holes weaken some
  std::vector<int> latest(static_cast<std::size_t>(section.quads.cols()), -1);  // brick of every quad
  const double of_holes = body.web ? hole_stiffness(body.web->holes) : 1;
  for (int layer = 0; layer < last_plane; ++layer) {
    const bool toothed = layer >= planes.first && layer < planes.last;
    if (toothed) mesh.shaft_bricks.emplace_back();
    for (Eigen::Index quad = 0; quad < section.quads.cols(); ++quad) {
      if (!sweep.has_quad(quad, layer)) continue;
      const SectionPart part = section.parts[static_cast<std::size_t>(quad)];
      int& brick = latest[static_cast<std::size_t>(quad)];
      const LayerSpan span = sweep.span_of_quad(quad, layer);
      if (span.lower == layer) {
        brick = sweep.brick(quad, span);
        if (body.web && body.web->holes.count > 0) stiffness.push_back(part == SectionPart::HoledWeb ? of_holes : 1);
        if (body.web) add_to_rim(section, quad, brick, mesh);
      }
      if (toothed && part == SectionPart::Shaft) mesh.shaft_bricks.back().push_back(brick);
    }
    if (!toothed) continue;
    for (std::size_t m = 0; m < section.teeth.size(); ++m) {
      const SectionTooth& lines = section.teeth[m];
      ToothSurfaces& surfaces = mesh.tooth_surfaces[m];
      const auto add = [&](const std::vector<SectionEdge>& edges, std::vector<MeshFace>& faces) {
        for (const SectionEdge& edge : edges) {
          if (!sweep.has_edge(edge, layer)) continue;
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
  mesh.solid.stiffness = std::move(stiffness);
  // The solid model's requirement on every brick; shape and options together decide whether one folds.
  if (!(mesh.solid.quality() > 0)) {
    throw InvalidInput("options", "an element is folded", "element numbers and sizes that fit this tooth and body");
  }

  std::vector<char> follows(static_cast<std::size_t>(mesh.solid.nodes.cols()), 0);
  for (const TiedNode& tie : mesh.solid.tied) follows[static_cast<std::size_t>(tie.node)] = 1;
  const auto hold_inside = [&](double radius) {
    for (int node = 0; node < mesh.solid.nodes.cols(); ++node) {
      const bool inside = mesh.solid.nodes.col(node).head<2>().norm() <= radius * (1 + 1e-9);  // round-off of its nodes
      if (inside && !follows[static_cast<std::size_t>(node)]) mesh.supports.push_back({.node = node});
    }
  };
  if (body.rigid) {
    hold_inside(body_radii(body, mesh.form, mesh.normal_module, width).teeth);
    return mesh;
  }
  if (mesh.rigid_bore) {
    hold_inside(body.bore_diameter / 2);
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
