#include "core/compliance/finite_element/load_functional.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/base/units.hpp"

namespace flankwright {
namespace {

/// 3 x 3 Gauss points of a face in n x n parts: calls use(shape, weight).
template <typename Use>
void integrate_face(int n, Use&& use) {
  for (int i = 0; i < 3 * n; ++i) {
    for (int j = 0; j < 3 * n; ++j) {
      const double xi = -1 + (2 * (i / 3) + 1 + gauss3_abscissae[i % 3]) / n;
      const double eta = -1 + (2 * (j / 3) + 1 + gauss3_abscissae[j % 3]) / n;
      use(face_shape(xi, eta), gauss3_weights[i % 3] * gauss3_weights[j % 3] / (n * n));
    }
  }
}

/// Parts per side that the weight, which changes over the distance to p, is integrated with: four Gauss points or more
/// per that distance.
int parts(const FaceNodes& nodes, const Eigen::Vector3d& p) {
  const Eigen::Vector3d centre = nodes.leftCols<4>().rowwise().mean();
  const double size = (nodes.leftCols<4>().colwise() - centre).colwise().norm().maxCoeff();
  const double distance = (nodes.colwise() - p).colwise().norm().minCoeff();
  constexpr int kMost = 8;  // faces that p all but touches, at pointed tips
  return std::clamp(static_cast<int>(std::ceil(1.5 * size / distance)), 1, kMost);
}

/// A point beyond a face end is turned back onto it along the helix.
Eigen::Vector3d on_face_width(const GearMesh& mesh, const Eigen::Vector3d& x) {
  const double z = std::clamp(x.z(), -mesh.face_width / 2, mesh.face_width / 2);
  const double turn = std::tan(mesh.form.helix_angle()) / mesh.form.reference_radius() * (z - x.z());
  Eigen::Vector3d result = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * x;
  result.z() = z;
  return result;
}

[[noreturn]] void reject(const char* field, double value, double low, double high) {
  throw InvalidInput(field, std::to_string(value), std::to_string(low) + " to " + std::to_string(high));
}

}  // namespace

LoadFrame load_frame(const GearMesh& mesh, const FlankPoint& point) {
  const ToothForm& form = mesh.form;
  if (std::abs(point.tooth) > mesh.teeth_each_side) {
    reject("point.tooth", point.tooth, -mesh.teeth_each_side, mesh.teeth_each_side);
  }
  // Ends are reached by sums whose round-off must not matter.
  const double round_off = 1e-9 * mesh.normal_module;
  if (!(point.radius >= form.form_radius() - round_off && point.radius <= form.tip_radius() + round_off)) {
    reject("point.radius", point.radius, form.form_radius(), form.tip_radius());
  }
  if (!(std::abs(point.z) <= mesh.face_width / 2 + round_off)) {
    reject("point.z", point.z, -mesh.face_width / 2, mesh.face_width / 2);
  }
  const double r = std::clamp(point.radius, form.form_radius(), form.tip_radius());
  const double r_b = form.base_radius();
  const double gamma = std::tan(form.helix_angle()) / form.reference_radius();  // turn of the section per length
  const double psi = form.half_angle(r);
  const double alpha_yt = std::acos(std::min(1.0, r_b / r));
  const double tan_beta_b = gamma * r_b;

  const double angle = point.tooth * 2 * units::pi / mesh.teeth + gamma * point.z - psi;  // from +y
  LoadFrame frame;
  frame.position = {-r * std::sin(angle), r * std::cos(angle), point.z};
  // The transverse normal leans by alpha_yt from the circle's tangent outwards.
  frame.normal = Eigen::Vector3d(std::cos(angle + alpha_yt), std::sin(angle + alpha_yt), tan_beta_b).normalized();

  // Along the inward normal the angle to the (endless) centre surface falls from psi through 0.
  const auto angle_left = [&](double depth) {
    const Eigen::Vector3d x = frame.position - depth * frame.normal;
    const double turned = point.tooth * 2 * units::pi / mesh.teeth + gamma * x.z();
    return std::remainder(turned - std::atan2(-x.x(), x.y()), 2 * units::pi);
  };
  const double eq_2_2 = r * psi / (std::cos(alpha_yt) * std::sqrt(1 + tan_beta_b * tan_beta_b));
  const double deep = 1.5 * eq_2_2;
  frame.depth = bracketed_root(angle_left, 0.0, angle_left(0), deep, angle_left(deep), 1e-12 * mesh.normal_module).x;
  return frame;
}

namespace {

/// A unit load against the normal, spread over faces by a weight times the area, and made to have the load's force and moments about every axis by a linear factor.
/// @param weight  of (place, vector of the area element) [1/mm^2 times the area's]
/// @param parts   that a face is divided into each way
template <typename Weight, typename Parts>
Eigen::SparseVector<double> spread_load(const GearMesh& mesh, const std::vector<MeshFace>& faces, const LoadFrame& frame, Weight&& weight,
                                        Parts&& parts_of) {
  const Eigen::Vector3d& n = frame.normal;
  Eigen::Matrix<double, 2, 3> across;  // rows: directions across the line of action
  across.row(0) = Eigen::Vector3d(n.y(), -n.x(), 0).normalized();
  across.row(1) = n.cross(across.row(0).transpose());

  // Per node: integrals of w N times (1, xi, eta).
  std::map<int, Eigen::Vector3d> nodal;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  // of w times (1, xi, eta) and itself
  for (const MeshFace& face : faces) {
    const FaceNodes nodes = mesh.face_nodes(face);
    const int division = parts_of(nodes);
    if (division == 0) continue;
    Eigen::Matrix<double, 8, 3> sums = Eigen::Matrix<double, 8, 3>::Zero();
    integrate_face(division, [&](const FaceShape& shape, double share) {
      const Eigen::Vector3d x = nodes * shape.values;
      const Eigen::Matrix<double, 3, 2> tangents = nodes * shape.derivatives;
      const double w = share * weight(x, tangents.col(0).cross(tangents.col(1)));
      if (!(w > 0)) return;
      Eigen::Vector3d powers;
      powers << 1, across * (x - frame.position) / frame.depth;
      sums += w * shape.values * powers.transpose();
      moments += w * powers * powers.transpose();
    });
    for (int i = 0; i < 8; ++i) nodal.try_emplace(face[i], Eigen::Vector3d::Zero()).first->second += sums.row(i);
  }
  const Eigen::Vector3d factors = moments.inverse() * Eigen::Vector3d(1, 0, 0);

  Eigen::SparseVector<double> result(mesh.solid.nodes.size());
  for (const auto& [node, sums] : nodal) {
    for (int a = 0; a < 3; ++a) result.insert(3 * node + a) = -n[a] * factors.dot(sums);
  }
  return result;
}

}  // namespace

Eigen::SparseVector<double> centre_functional(const GearMesh& mesh, const FlankPoint& point) {
  const LoadFrame frame = load_frame(mesh, point);
  const Eigen::Vector3d& n = frame.normal;
  const Eigen::Vector3d foot = on_face_width(mesh, frame.position - frame.depth * n);
  const Eigen::Vector3d source = foot + source_height * frame.depth * n;
  const auto weight = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& area) {  // area: nu dA
    const Eigen::Vector3d d = x - source;
    const double a = -n.dot(d), square = d.squaredNorm();
    return a > 0 ? 1.5 / units::pi * a * a * std::abs(d.dot(area)) / (square * square * std::sqrt(square)) : 0.0;
  };
  return spread_load(mesh, mesh.surfaces(point.tooth).centre, frame, weight, [&](const FaceNodes& nodes) { return parts(nodes, source); });
}

Eigen::SparseVector<double> flank_functional(const GearMesh& mesh, const FlankPoint& point) {
  const LoadFrame frame = load_frame(mesh, point);
  const double radius = flank_patch * mesh.normal_module;
  const auto weight = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& area) {
    return std::max(0.0, 1 - (x - frame.position).squaredNorm() / (radius * radius)) * area.norm();
  };
  const auto parts_of = [&](const FaceNodes& nodes) {
    const Eigen::Vector3d centre = nodes.leftCols<4>().rowwise().mean();
    const double size = (nodes.leftCols<4>().colwise() - centre).colwise().norm().maxCoeff();
    if ((centre - frame.position).norm() > radius + 1.5 * size) return 0;
    return std::clamp(static_cast<int>(std::ceil(6 * size / radius)), 2, 12);
  };
  return spread_load(mesh, mesh.surfaces(point.tooth).flank, frame, weight, parts_of);
}

SectionMotion shaft_motion(const GearMesh& mesh, double z) {
  const auto above = std::upper_bound(mesh.planes.begin(), mesh.planes.end(), z) - mesh.planes.begin();
  const auto layer = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ssize(mesh.planes) - 2));

  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  std::map<int, Eigen::Matrix<double, 6, 3>> nodal;
  for (const int brick : mesh.shaft_bricks[layer]) {
    const BrickNodes nodes = mesh.solid.brick_nodes(brick);
    const double lower = nodes(2, 0), upper = nodes(2, 4), zeta = std::clamp(2 * (z - lower) / (upper - lower) - 1, -1.0, 1.0);
    for (int i = 0; i < 9; ++i) {
      const BrickShape shape = brick_shape({gauss3_abscissae[i % 3], gauss3_abscissae[i / 3], zeta});
      const Eigen::Matrix3d jacobian = nodes * shape.derivatives;
      const double area = gauss3_weights[i % 3] * gauss3_weights[i / 3] * jacobian.topLeftCorner<2, 2>().determinant();
      const Eigen::Vector3d r = nodes * shape.values - Eigen::Vector3d(0, 0, z);
      Eigen::Matrix<double, 6, 3> rigid;  // transposed: u = rigid' (t, omega)
      rigid << Eigen::Matrix3d::Identity(), Eigen::Matrix3d{{0, -r.z(), r.y()}, {r.z(), 0, -r.x()}, {-r.y(), r.x(), 0}};
      normal += area * rigid * rigid.transpose();
      for (int k = 0; k < 20; ++k) {
        nodal.try_emplace(mesh.solid.bricks(k, brick), Eigen::Matrix<double, 6, 3>::Zero()).first->second += area * shape.values[k] * rigid;
      }
    }
  }
  SectionMotion motion;
  motion.weights.resize(6, 3 * static_cast<Eigen::Index>(nodal.size()));
  for (const auto& [node, weights] : nodal) {
    motion.weights.middleCols<3>(3 * static_cast<Eigen::Index>(motion.nodes.size())) = weights;
    motion.nodes.push_back(node);
  }
  motion.weights = normal.ldlt().solve(motion.weights).eval();
  return motion;
}

Eigen::SparseMatrix<double> NetFunctionals::whole() const { return centre - motions * taken_off; }

NetFunctionals net_functionals(const GearMesh& mesh, const std::vector<FlankPoint>& points, RemovedRigidMotion removed) {
  const auto count = static_cast<int>(points.size());
  std::vector<Eigen::Triplet<double>> motions, taken_off;
  std::map<std::pair<double, int>, int> columns;  // of the motions' parts, by plane and component of (t, omega)
  std::map<double, SectionMotion> sections;
  const auto take_off = [&](double z, int component, double amount, int point) {
    const auto [station, is_new] = columns.try_emplace({z, component}, static_cast<int>(columns.size()));
    taken_off.emplace_back(station->second, point, amount);
    if (!is_new) return;
    if (!sections.contains(z)) sections.emplace(z, shaft_motion(mesh, z));
    const SectionMotion& section = sections.at(z);
    for (int i = 0; i < section.weights.cols(); ++i) {
      motions.emplace_back(3 * section.nodes[static_cast<std::size_t>(i / 3)] + i % 3, station->second, section.weights(component, i));
    }
  };

  NetFunctionals net;
  net.centre.resize(mesh.solid.nodes.size(), count);
  for (int i = 0; i < count; ++i) {
    const FlankPoint& point = points[static_cast<std::size_t>(i)];
    const Eigen::SparseVector<double> load = centre_functional(mesh, point);
    const Eigen::Vector3d centre(0, 0, point.z);
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    net.centre.startVec(i);
    for (Eigen::SparseVector<double>::InnerIterator entry(load); entry; ++entry) {
      net.centre.insertBack(entry.index(), i) = entry.value();
      Eigen::Vector3d part = Eigen::Vector3d::Zero();
      part[entry.index() % 3] = entry.value();
      force += part;
      moment += (mesh.solid.nodes.col(entry.index() / 3) - centre).cross(part);
    }
    if (removed == RemovedRigidMotion::None) continue;
    take_off(point.z, 0, force.x(), i);
    take_off(point.z, 1, force.y(), i);
    if (removed == RemovedRigidMotion::WholeTranslationTorsionAndTilt) take_off(point.z, 2, force.z(), i);
    take_off(mesh.torque_end, 5, moment.z(), i);
    if (removed == RemovedRigidMotion::TranslationAndTorsion) continue;
    take_off(0, 3, moment.x(), i);
    take_off(0, 4, moment.y(), i);
  }
  net.centre.finalize();
  const auto parts = static_cast<Eigen::Index>(columns.size());
  net.motions.resize(mesh.solid.nodes.size(), parts);
  net.motions.setFromTriplets(motions.begin(), motions.end());
  net.taken_off.resize(parts, count);
  net.taken_off.setFromTriplets(taken_off.begin(), taken_off.end());
  return net;
}

double axial_hold_compliance(const GearMesh& mesh, const Material& material, RemovedRigidMotion removed) {
  if (removed == RemovedRigidMotion::WholeTranslationTorsionAndTilt || mesh.rigid_body || mesh.rigid_bore) return 0;
  const auto [E, nu] = material;
  const double a = axial_hold_share * mesh.shaft_diameter / 2;
  const double tan_beta_b = std::tan(mesh.form.helix_angle()) * mesh.form.base_radius() / mesh.form.reference_radius();
  const double sin_squared = tan_beta_b * tan_beta_b / (1 + tan_beta_b * tan_beta_b);
  return sin_squared * 16 * (1 - nu * nu) / (3 * units::pi * units::pi * E * a);
}

}  // namespace flankwright
