#include "tests/benchmarks/contact_truth/flank_load.hpp"

#include <algorithm>
#include <cmath>

#include "core/compliance/finite_element/fillet_stress.hpp"
#include "core/compliance/finite_element/load_functional.hpp"
#include "core/compliance/finite_element/solid_model.hpp"
#include "core/compliance/model/compliance_task.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::contact_truth {
namespace {

/// One unit of force per module of face along the flank at a radius, inwards: on every element's face where it crosses it.
Eigen::VectorXd load_on_flank(const GearMesh& mesh, double radius) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh.solid.nodes.size());
  for (const MeshFace& face : mesh.surfaces(0).flank) {
    const FaceNodes nodes = mesh.face_nodes(face);
    const auto above = [&](double xi, double eta) {
      return (nodes * face_shape(xi, eta).values).head<2>().norm() - radius;
    };  // xi runs down the flank
    for (std::size_t k = 0; k < 3; ++k) {
      const double eta = gauss3_abscissae[k];
      if (!(above(-1, eta) > 0 && above(1, eta) <= 0)) continue;
      double upper = -1, lower = 1;
      for (int i = 0; i < 50; ++i) (above((upper + lower) / 2, eta) > 0 ? upper : lower) = (upper + lower) / 2;
      const FaceShape shape = face_shape(upper, eta);
      const double length = std::abs(nodes.row(2) * shape.derivatives.col(1)) * gauss3_weights[k];
      const Eigen::Vector3d normal = load_frame(mesh, {0, radius, (nodes * shape.values).z()}).normal;
      for (int i = 0; i < 8; ++i) load.segment<3>(3 * face[static_cast<std::size_t>(i)]) -= shape.values[i] * length * normal;
    }
  }
  return load;
}

/// The same by the program's own functionals.
Eigen::VectorXd load_on_centre(const GearMesh& mesh, double radius) {
  constexpr int points = 41;
  std::vector<FlankPoint> line;
  Eigen::VectorXd weights(points);
  const double step = mesh.face_width / (points - 1);
  for (int i = 0; i < points; ++i) {
    line.push_back({0, radius, std::clamp(-mesh.face_width / 2 + i * step, -mesh.face_width / 2, mesh.face_width / 2)});
    weights[i] = i == 0 || i == points - 1 ? step / 2 : step;
  }
  return net_functionals(mesh, line, RemovedRigidMotion::None).centre * weights;
}

}  // namespace

double flank_over_centre_load(const ContactTask& task, Member member, int tooth, double along) {
  ComplianceTask own{
      .pair = make_gear_pair(task.pair), .model = ComplianceModel::Fe, .material = {task.material, task.material}, .root_stress = true};
  own.body[member] = {.bore_diameter = 2 * task.bore_radius[member == Member::Pinion ? 0 : 1], .hold = BodyHold::RigidBore};
  const InfluenceTableTask gear = influence_table_task(own, member);
  GearMeshOptions options = gear.mesh;
  options.teeth_each_side = 1;
  options.end_element = 0.3;
  options.largest_element = 0.6;
  const GearMesh mesh = gear_mesh(in_modules(gear).gear, options);
  const Material material{1, task.material.poissons_ratio};

  const double pinion_roll = PathOfContact(own.pair).roll_at(task.phase + tooth);
  const double roll = member == Member::Pinion ? pinion_roll : own.pair.path_length - pinion_roll;
  const double radius = std::hypot(roll, own.pair[member].base_radius) / task.pair.normal_module;
  Eigen::MatrixXd loads(mesh.solid.nodes.size(), 2);
  loads << load_on_flank(mesh, radius), load_on_centre(mesh, radius);
  const Eigen::SparseMatrix<double> readings = FilletStress(mesh, material).functionals({{along, 0.0}});
  const Eigen::MatrixXd stress = readings.transpose() * SolidModel(mesh.solid, material, mesh.supports).solve(loads.sparseView());
  return largest_principal(stress.col(0)).value / largest_principal(stress.col(1)).value;
}

}  // namespace flankwright::contact_truth
