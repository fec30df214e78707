#include "tests/benchmarks/contact_truth/held_structure.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/finite_element/solve_half_space_correction.hpp"
#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::contact_truth {

InfluenceTable held_at_bore(const GearPair& pair, Member member, double bore_radius, double poissons_ratio, const GearMeshOptions& mesh,
                            bool plane_strain) {
  const Gear& gear = pair[member];
  const double module = pair.data.normal_module, half = gear.data.face_width / 2;
  GearToMesh to_mesh{gear.data, module, pair.data.pressure_angle, pair.data.helix_angle, {}};
  to_mesh.gear.tip_diameter = 2 * gear.tip_radius;
  // The mesh wants a shaft somewhat larger than its bore, and an overhang; both bores are held all along.
  to_mesh.body.bore_diameter = 2 * bore_radius;
  to_mesh.body.shaft_diameter = 2 * std::min(bore_radius / 0.8, gear.root_radius - 0.5 * module);
  to_mesh.body.shaft_overhang = 0.001 * module;
  GearMeshOptions options = mesh;
  const int apart = std::max(2, teeth_apart_in_contact(pair));
  options.teeth_each_side = apart;
  options.layer_share = 0;  // any node of the bore is held
  GearMesh model = gear_mesh(to_mesh, options);
  model.supports.clear();
  std::set<int> tied;
  for (const TiedNode& t : model.solid.tied) tied.insert(t.node);
  for (int i = 0; i < model.solid.nodes.cols(); ++i) {
    if (model.solid.nodes.col(i).head<2>().norm() < bore_radius * (1 + 1e-9))
      model.supports.push_back({i});
    else if (plane_strain && !tied.contains(i))  // tied nodes follow others, which do not move along the axis
      model.supports.push_back({i, {false, false, true}});
  }
  const SolidModel solid(model.solid, {1, poissons_ratio}, model.supports);

  const StationGrid grid = station_grid(gear.data.face_width / module);
  std::vector<FlankPoint> points;
  for (int tooth = -apart; tooth <= apart; ++tooth) {
    for (const FlankStation& station : grid.stations(tooth)) {
      points.push_back({tooth, model.form.form_radius() + (station.u + 1) / 2 * (model.form.tip_radius() - model.form.form_radius()),
                        std::clamp(station.zeta * module - half, -half, half)});
    }
  }
  const Eigen::SparseMatrix<double> functionals = net_functionals(model, points, RemovedRigidMotion::None).centre;
  const Eigen::Index n = grid.size();
  const Eigen::SparseMatrix<double> loads = functionals.middleCols(apart * n, n);
  const Eigen::MatrixXd deflections = module * (functionals.transpose() * solid.solve(loads));
  std::vector<Eigen::MatrixXd> tables;
  for (int m = 0; m <= apart; ++m) {
    tables.push_back(0.5 * (deflections.middleRows((apart - m) * n, n) + deflections.middleRows((apart + m) * n, n).transpose()));
  }
  return {grid, tables};
}

std::shared_ptr<const PairCompliance> held_structure(const ContactTask& task, const GearMeshOptions& mesh) {
  const GearPair pair = make_gear_pair(task.pair);
  const auto gear = [&](Member m, double bore) {
    return GearStructure{
        .compliance = std::make_shared<const InfluenceTable>(held_at_bore(pair, m, bore, task.material.poissons_ratio, mesh, task.plane_strain)),
        .youngs_modulus = task.material.youngs_modulus,
        .half_space = std::make_shared<const HalfSpaceCorrection>(
            half_space_correction(LoadedSection(pair[m], pair, task.material.poissons_ratio, fine_section()), pair[m]))};
  };
  return std::make_shared<const StructuralPair>(pair, gear(Member::Pinion, task.bore_radius.pinion), gear(Member::Wheel, task.bore_radius.wheel));
}

GearStructures rigid_bore_structures(const ContactTask& task) {
  ComplianceTask own{
      .pair = make_gear_pair(task.pair), .model = ComplianceModel::Fe, .material = {task.material, task.material}, .root_stress = true};
  own.body.pinion = {.bore_diameter = 2 * task.bore_radius.pinion, .hold = BodyHold::RigidBore};
  own.body.wheel = {.bore_diameter = 2 * task.bore_radius.wheel, .hold = BodyHold::RigidBore};
  return build_compliance(own);
}

}  // namespace flankwright::contact_truth
