#include "core/compliance/shaft/unit_statics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace flankwright {

MeshGeometry geometry_of(const UnitMesh& mesh) {
  MeshGeometry of;
  const double transverse = std::atan(std::tan(mesh.pressure_angle) / std::cos(mesh.helix_angle));
  for (std::size_t i = 0; i < 2; ++i) {
    of.reference_radius[i] = 0.5 * mesh.normal_module * mesh.gears[i].teeth / std::cos(mesh.helix_angle);
    of.base_radius[i] = of.reference_radius[i] * std::cos(transverse);
  }
  const double reference = of.reference_radius[0] + of.reference_radius[1];
  of.centre_distance = std::isnan(mesh.centre_distance) ? reference : mesh.centre_distance;
  of.working_pressure_angle = std::acos(reference * std::cos(transverse) / of.centre_distance);
  for (std::size_t i = 0; i < 2; ++i) of.working_radius[i] = of.centre_distance * mesh.gears[i].teeth / (mesh.gears[0].teeth + mesh.gears[1].teeth);
  of.base_helix_angle = std::asin(std::sin(mesh.helix_angle) * std::cos(mesh.pressure_angle));
  return of;
}

UnitTorques torque_balance(const ShaftsOfPair& shafts, const GearPair& pair) {
  const std::vector<const ShaftData*> all = shafts.all();
  const UnitData& unit = shafts.unit;
  UnitTorques torques{std::vector<double>(unit.meshes.size(), 0.0), std::vector<double>(all.size(), 0.0), {}};
  // What is known acts on the right-hand side.
  Eigen::VectorXd known = Eigen::VectorXd::Zero(std::ssize(all));
  if (const auto on = shafts.find(Member::Pinion)) known[*on] -= 1.0;
  if (const auto on = shafts.find(Member::Wheel)) known[*on] -= pair.gear_ratio();
  for (const UnitLoad& load : unit.loads) {
    if (!load.constant) known[*shafts.find(load.shaft)] += load.moment.z() / unit.reference_torque;
  }
  std::vector<Eigen::VectorXd> columns;
  std::vector<double*> unknowns;
  for (std::size_t m = 0; m < unit.meshes.size(); ++m) {
    const UnitMesh& mesh = unit.meshes[m];
    Eigen::VectorXd column = Eigen::VectorXd::Zero(known.size());
    column[*shafts.find(mesh.gears[0].shaft)] -= 1.0;
    column[*shafts.find(mesh.gears[1].shaft)] -= static_cast<double>(mesh.gears[1].teeth) / mesh.gears[0].teeth;
    if (!std::isnan(mesh.torque)) {
      torques.mesh[m] = mesh.torque / unit.reference_torque;
      known += torques.mesh[m] * column;
      continue;
    }
    columns.push_back(std::move(column));
    unknowns.push_back(&torques.mesh[m]);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::isnan(all[i]->torque_position)) continue;
    columns.push_back(Eigen::VectorXd::Unit(known.size(), static_cast<Eigen::Index>(i)));
    unknowns.push_back(&torques.coupling[i]);
  }
  Eigen::VectorXd left = known;
  if (!columns.empty()) {
    Eigen::MatrixXd matrix(known.size(), std::ssize(columns));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) matrix.col(j) = columns[static_cast<std::size_t>(j)];
    Eigen::FullPivLU<Eigen::MatrixXd> factored(matrix);
    torques.determined = factored.rank() == matrix.cols();
    const Eigen::VectorXd found = matrix.completeOrthogonalDecomposition().solve(-known);
    // A torque below this part of the largest is round-off of the solution: the mesh or coupling idles.
    constexpr double round_off = 1e-9;
    const double least = round_off * std::max({1.0, known.cwiseAbs().maxCoeff(), found.cwiseAbs().maxCoeff()});
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      const double torque = found[static_cast<Eigen::Index>(j)];
      *unknowns[j] = std::abs(torque) > least ? torque : 0.0;
    }
    left += matrix * found;
  }
  constexpr double balanced = 1e-9;  // |sum of the torques on a shaft| at most this part of the largest known torque
  Eigen::Index worst = 0;            // least squares leave something over on every shaft that the meshes join
  for (Eigen::Index i = 0; i < left.size(); ++i) {
    if (std::abs(left[i]) > std::abs(left[worst])) worst = i;
  }
  if (left.size() > 0) {
    const Eigen::Index i = worst;
    if (std::abs(left[i]) > balanced * std::max(1.0, known.cwiseAbs().maxCoeff())) torques.unbalanced.emplace_back(static_cast<int>(i), left[i]);
  }
  return torques;
}

Eigen::Vector3d transverse_normal(const UnitMesh& mesh, double torque) {
  const double alpha = geometry_of(mesh).working_pressure_angle, right = torque >= 0.0 ? 1.0 : -1.0;
  const Eigen::Vector3d across(std::cos(mesh.angle), std::sin(mesh.angle), 0.0), along(-std::sin(mesh.angle), std::cos(mesh.angle), 0.0);
  return std::sin(alpha) * across + right * std::cos(alpha) * along;
}

std::array<BeamLoad, 2> mesh_tilt(const ShaftsOfPair& shafts, const UnitMesh& mesh, double torque) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero(), opens = Eigen::Vector3d::UnitZ().cross(transverse_normal(mesh, torque));
  return {BeamLoad{mesh.gears[0].position, none, -opens, *shafts.find(mesh.gears[0].shaft)},
          BeamLoad{mesh.gears[1].position, none, opens, *shafts.find(mesh.gears[1].shaft)}};
}

std::vector<BeamLoad> mesh_loads(const ShaftsOfPair& shafts, const UnitMesh& mesh, double torque) {
  using Eigen::Vector3d;
  const MeshGeometry of = geometry_of(mesh);
  const double beta = of.base_helix_angle, right = torque >= 0.0 ? 1.0 : -1.0, hand = mesh.hand == Hand::Right ? 1.0 : -1.0;
  const Vector3d across(std::cos(mesh.angle), std::sin(mesh.angle), 0.0);
  // As the pair's own force in ShaftPair.
  const Vector3d normal = std::cos(beta) * transverse_normal(mesh, torque) - right * hand * std::sin(beta) * Vector3d::UnitZ();
  const Vector3d force = std::abs(torque) / (of.base_radius[0] * std::cos(beta)) * normal;
  const Vector3d first_arm = of.working_radius[0] * across, second_arm = -of.working_radius[1] * across;
  return {{mesh.gears[0].position, -force, first_arm.cross(-force), *shafts.find(mesh.gears[0].shaft)},
          {mesh.gears[1].position, force, second_arm.cross(force), *shafts.find(mesh.gears[1].shaft)}};
}

std::vector<BeamLoad> outside_loads(const ShaftsOfPair& shafts, const UnitTorques& torques) {
  const UnitData& unit = shafts.unit;
  std::vector<BeamLoad> loads;
  for (std::size_t m = 0; m < unit.meshes.size(); ++m) {
    for (const BeamLoad& load : mesh_loads(shafts, unit.meshes[m], torques.mesh[m])) loads.push_back(load);
  }
  for (const UnitLoad& load : unit.loads) {
    if (load.constant) continue;
    loads.push_back(BeamLoad{load.position, load.force, load.moment, *shafts.find(load.shaft)}.times(1.0 / unit.reference_torque));
  }
  return loads;
}

std::vector<BeamLoad> constant_loads(const ShaftsOfPair& shafts) {
  std::vector<BeamLoad> loads;
  for (const UnitLoad& load : shafts.unit.loads) {
    if (load.constant) loads.push_back({load.position, load.force, load.moment, *shafts.find(load.shaft)});
  }
  return loads;
}

bool is_on_pair_gear(const ShaftsOfPair& shafts, const GearPair& pair, Member member, const UnitGear& gear) {
  const std::optional<ShaftData>& shaft = shafts.shaft[member];
  if (!shaft || gear.shaft != name_of(member)) return false;
  return std::abs(gear.position - shaft->gear_position) < 0.5 * (gear.face_width + pair[member].data.face_width);
}

UnitTorques torques_as_analysed(ShaftsOfPair shafts, const GearPair& pair) {
  if (pair.data.working_flank == WorkingFlank::Left) shafts = mirrored(std::move(shafts));
  return torque_balance(shafts, pair);
}

namespace {

/// Meshes of the unit on one of the pair's gears.
/// @param is_counted  of the torque that a mesh leaves on its gears: of one sign on both, as that of the pair, which is negative
template <class IsCounted>
int meshes_on(const ShaftsOfPair& shafts, const GearPair& pair, Member member, const IsCounted& is_counted) {
  const UnitTorques torques = torques_as_analysed(shafts, pair);
  int meshes = 0;
  for (std::size_t m = 0; m < shafts.unit.meshes.size(); ++m) {
    const auto same = [&](const UnitGear& gear) { return is_on_pair_gear(shafts, pair, member, gear); };
    if (std::ranges::any_of(shafts.unit.meshes[m].gears, same) && is_counted(torques.mesh[m])) ++meshes;
  }
  return meshes;
}

}  // namespace

int meshes_per_revolution(const ShaftsOfPair& shafts, const GearPair& pair, Member member) {
  return 1 + meshes_on(shafts, pair, member, [](double torque) { return torque > 0.0; });
}

int meshes_on_other_flank(const ShaftsOfPair& shafts, const GearPair& pair, Member member) {
  return meshes_on(shafts, pair, member, [](double torque) { return torque < 0.0; });
}

double turning_hold(const ShaftsOfPair& shafts, int shaft, const UnitTorques& torques) {
  struct Place {
    double position, torque;
  };
  std::vector<Place> places;
  const auto index = static_cast<std::size_t>(shaft);
  const ShaftData& data = *shafts.all()[index];
  const bool has_coupling = !std::isnan(data.torque_position);
  if (has_coupling && (torques.coupling.empty() || torques.coupling[index] != 0.0)) return data.torque_position;  // its torque is what the hold takes
  if (has_coupling) places.push_back({data.torque_position, 0.0});
  const std::string name = shafts.names()[index];
  for (std::size_t m = 0; m < shafts.unit.meshes.size(); ++m) {
    const UnitMesh& mesh = shafts.unit.meshes[m];
    const double ratio = static_cast<double>(mesh.gears[1].teeth) / mesh.gears[0].teeth, torque = std::abs(torques.mesh[m]);
    if (mesh.gears[0].shaft == name) places.push_back({mesh.gears[0].position, torque});
    if (mesh.gears[1].shaft == name) places.push_back({mesh.gears[1].position, ratio * torque});
  }
  for (const UnitLoad& load : shafts.unit.loads) {
    if (load.shaft == name && load.moment.z() != 0.0) places.push_back({load.position, std::abs(load.moment.z()) / shafts.unit.reference_torque});
  }
  if (places.empty()) return not_given;
  constexpr double alike = 1.0 - 1e-9;  // shares of a torque that are equal but for round-off: the first of them holds
  const double largest = std::ranges::max(places, {}, &Place::torque).torque;
  return std::ranges::find_if(places, [&](const Place& place) { return place.torque >= alike * largest; })->position;
}

void settle_turning_holds(ShaftsOfPair& shafts, const GearPair& pair) {
  const UnitTorques torques = shafts.unit.empty() ? UnitTorques{} : torques_as_analysed(shafts, pair);
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (const auto index = shafts.find(m)) shafts.shaft[m]->held_position = turning_hold(shafts, *index, torques);
  }
}

}  // namespace flankwright
