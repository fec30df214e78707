#include "core/compliance/finite_element/gear_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/error.hpp"

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

/// Numbers the nodes of the swept section as bricks ask for them.
class Sweep {
 public:
  Sweep(const SectionMesh& section, double twist, double half_face)
      : section_(section), twist_(twist), half_face_(half_face) {}

  /// @param level  2 k at plane k, 2 k + 1 half way to the next
  int node(int section_node, int level, double z) {
    const auto needed = static_cast<std::size_t>((level + 1) * section_.nodes.cols());
    if (numbers_.size() < needed) numbers_.resize(needed, -1);
    int& number = numbers_[static_cast<std::size_t>(level * section_.nodes.cols() + section_node)];
    if (number < 0) {
      number = static_cast<int>(points_.size());
      const double turn = twist_ * std::clamp(z, -half_face_, half_face_);
      const Eigen::Vector2d p = section_.nodes.col(section_node);
      points_.push_back(
          {p.x() * std::cos(turn) - p.y() * std::sin(turn), p.x() * std::sin(turn) + p.y() * std::cos(turn), z});
    }
    return number;
  }
  int brick(Eigen::Index quad, int layer, double lower, double upper) {
    std::array<int, 20> brick;
    for (int i = 0; i < 4; ++i) {
      const int corner = section_.quads(i, quad), side = section_.quads(i + 4, quad);
      brick[i] = node(corner, 2 * layer, lower);
      brick[i + 4] = node(corner, 2 * layer + 2, upper);
      brick[i + 8] = node(side, 2 * layer, lower);
      brick[i + 12] = node(side, 2 * layer + 2, upper);
      brick[i + 16] = node(corner, 2 * layer + 1, (lower + upper) / 2);
    }
    bricks_.push_back(brick);
    return static_cast<int>(bricks_.size()) - 1;
  }
  MeshFace face(const SectionEdge& edge, int layer, double lower, double upper) {
    const double middle = (lower + upper) / 2;
    return {node(edge[0], 2 * layer, lower),     node(edge[2], 2 * layer, lower),
            node(edge[2], 2 * layer + 2, upper), node(edge[0], 2 * layer + 2, upper),
            node(edge[1], 2 * layer, lower),     node(edge[2], 2 * layer + 1, middle),
            node(edge[1], 2 * layer + 2, upper), node(edge[0], 2 * layer + 1, middle)};
  }
  /// Nodes made so far at a level.
  template <typename Use>
  void for_each_at(int level, Use&& use) const {
    const Eigen::Index n = section_.nodes.cols();
    for (Eigen::Index i = 0; i < n; ++i) {
      const int number = numbers_[static_cast<std::size_t>(level * n + i)];
      if (number >= 0) use(number, points_[number]);
    }
  }
  SolidMesh solid() const {
    SolidMesh mesh;
    mesh.nodes.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) mesh.nodes.col(static_cast<Eigen::Index>(i)) = points_[i];
    mesh.bricks.resize(20, static_cast<Eigen::Index>(bricks_.size()));
    for (std::size_t i = 0; i < bricks_.size(); ++i) {
      for (int k = 0; k < 20; ++k) mesh.bricks(k, static_cast<Eigen::Index>(i)) = bricks_[i][k];
    }
    return mesh;
  }

 private:
  const SectionMesh& section_;
  double twist_, half_face_;
  std::vector<int> numbers_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 20>> bricks_;
};

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
  mesh.torque_end = (body.torque_end == FaceEnd::Sharp ? -0.5 : 0.5) * width;
  const SectionMesh section = section_mesh(mesh.form, mesh.teeth, mesh.normal_module, body, options);
  const double overhang = body.shaft_overhang;
  if (!(overhang > 0) || !std::isfinite(overhang)) {
    throw InvalidInput("body.shaft_overhang", std::to_string(overhang), "more than 0 mm");
  }

  mesh.planes = face_planes(width, gear.normal_module, options);
  const std::vector<double> beyond =
      overhang_planes(overhang, options.largest_element * gear.normal_module, options.body_growth);
  std::vector<double> all;
  for (std::size_t i = beyond.size(); i-- > 0;) all.push_back(-width / 2 - beyond[i]);
  all.insert(all.end(), mesh.planes.begin(), mesh.planes.end());
  for (const double z : beyond) all.push_back(width / 2 + z);

  Sweep sweep(section, std::tan(gear.helix_angle) / mesh.form.reference_radius(), width / 2);
  mesh.tooth_surfaces.resize(section.teeth.size());
  const auto before = static_cast<int>(beyond.size()), on_face = static_cast<int>(mesh.planes.size()) - 1;
  for (int layer = 0; layer + 1 < static_cast<int>(all.size()); ++layer) {
    const double lower = all[layer], upper = all[layer + 1];
    const bool toothed = layer >= before && layer < before + on_face;
    if (toothed) mesh.shaft_bricks.emplace_back();
    for (Eigen::Index quad = 0; quad < section.quads.cols(); ++quad) {
      if (!toothed && !section.in_shaft[quad]) continue;
      const int brick = sweep.brick(quad, layer, lower, upper);
      if (toothed && section.in_shaft[quad]) mesh.shaft_bricks.back().push_back(brick);
    }
    if (!toothed) continue;
    for (std::size_t m = 0; m < section.teeth.size(); ++m) {
      const SectionTooth& lines = section.teeth[m];
      ToothSurfaces& surfaces = mesh.tooth_surfaces[m];
      for (const auto& edge : lines.centre_line) surfaces.centre.push_back(sweep.face(edge, layer, lower, upper));
      for (const auto& edge : lines.flank) surfaces.flank.push_back(sweep.face(edge, layer, lower, upper));
      for (const auto& edge : lines.fillet) surfaces.fillet.push_back(sweep.face(edge, layer, lower, upper));
    }
  }
  mesh.solid = sweep.solid();
  // What the solid model demands of every brick; a folded one is the doing of shape and options together.
  if (!(mesh.solid.quality() > 0)) {
    throw InvalidInput("options", "an element is folded", "element numbers and sizes that fit this tooth and body");
  }

  const int last_level = 2 * (static_cast<int>(all.size()) - 1);
  const bool at_sharp_end = body.torque_end == FaceEnd::Sharp;
  sweep.for_each_at(at_sharp_end ? 0 : last_level,
                    [&](int node, const Eigen::Vector3d&) { mesh.supports.push_back({.node = node}); });
  sweep.for_each_at(at_sharp_end ? last_level : 0, [&](int node, const Eigen::Vector3d& p) {
    const Eigen::Vector2d out = p.head<2>().normalized();
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    frame.topLeftCorner<2, 2>() << out.x(), -out.y(), out.y(), out.x();
    mesh.supports.push_back({node, {true, false, false}, frame});
  });
  return mesh;
}

}  // namespace flankwright
