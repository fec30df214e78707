#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string>

#include "core/compliance/shaft/shaft_pair.hpp"

namespace flankwright {

namespace {

BearingLawState law_state(const NonlinearBearing& bearing, BearingType type, double force) {
  BearingLawState state;
  state.type = type;
  state.deflection = bearing.law->deflection(force);
  state.tangent = bearing.law->stiffness(state.deflection);
  state.secant = force > 0.0 ? force / state.deflection : state.tangent;
  state.across = force > 0.0 ? force / (bearing.clearance + state.deflection) : bearing.clearance > 0.0 ? 0.0 : state.tangent;
  state.beyond_table = bearing.law->is_beyond_table(force);
  return state;
}

}  // namespace

std::vector<BeamLoad> ShaftPair::mean_loads(double axial_offset) const {
  std::vector<BeamLoad> all = outside_;
  for (const BeamLoad& load : loads({pitch_point(axial_offset)}, axial_offset)) all.push_back(load.times(force_per_torque()));
  return all;
}

Eigen::VectorXd ShaftPair::mean_reactions(double pinion_torque, double axial_offset) const {
  const std::vector<BeamLoad> loads = mean_loads(axial_offset);
  Eigen::VectorXd forces = pinion_torque * system_->reactions(loads, static_cast<int>(loads.size())).col(0);
  if (prestrain_.size() > 0) forces += system_->prestrain_stiffness() * prestrain_;
  if (!constant_.empty()) forces += system_->reactions(constant_, static_cast<int>(constant_.size())).col(0);
  return forces;
}

ClearanceState ShaftPair::bearing_equilibrium(double pinion_torque) const {
  const Eigen::VectorXd closed = -mean_reactions(pinion_torque, 0.0);
  const Eigen::MatrixXd stiffness = system_->prestrain_stiffness();
  std::vector<Eigen::Index> across;
  for (const int index : nonlinear_) {
    const UnitBearing& bearing = supports_.bearings[static_cast<std::size_t>(index)];
    across.insert(across.end(), {bearing.supports[0], bearing.supports[1]});
  }
  return solve_bearings(closed(across), stiffness(across, across), nonlinear_bearings_);
}

bool ShaftPair::keep_bearings_of(int shaft, std::vector<bool>& kept) const {
  bool more = false;
  for (const int index : nonlinear_) {
    const UnitBearing& bearing = supports_.bearings[static_cast<std::size_t>(index)];
    if (bearing.shaft != shaft && bearing.outer_shaft != shaft) continue;
    for (std::size_t r = 0; r < 2; ++r) {
      const auto row = static_cast<std::size_t>(bearing.supports[r]);
      more = more || !kept[row];
      kept[row] = true;
    }
  }
  return more;
}

ShaftPair ShaftPair::with_tangents(const ClearanceState& found, double pinion_torque) const {
  ShaftPair tangent = *this;
  const auto n = static_cast<Eigen::Index>(supports_.supports.size());
  Eigen::MatrixXd further = supports_.further.size() > 0 ? supports_.further : Eigen::MatrixXd(Eigen::MatrixXd::Zero(n, n));
  Eigen::VectorXd prestrain = Eigen::VectorXd::Zero(n);
  std::vector<bool> kept(supports_.supports.size(), true);
  for (std::size_t i = 0; i < nonlinear_.size(); ++i) {
    const std::array<int, 5>& supports = supports_.bearings[static_cast<std::size_t>(nonlinear_[i])].supports;
    const auto at = static_cast<Eigen::Index>(2 * i);
    const BearingTangent small = tangent_of(nonlinear_bearings_[i], found.force.segment<2>(at), found.shift.segment<2>(at), found.carries[i]);
    for (Eigen::Index r = 0; r < 2; ++r) {
      const int row = supports[static_cast<std::size_t>(r)];
      kept[static_cast<std::size_t>(row)] = small.carries;
      if (!small.carries) continue;
      prestrain[row] = small.prestrain[r];
      for (Eigen::Index c = 0; c < 2; ++c) further(row, supports[static_cast<std::size_t>(c)]) += small.compliance(r, c);
    }
  }
  // What carries nothing is not there. A shaft beside the pair's that no force presses to any side stays in the middle of its clearances.
  std::vector<double> lengths;
  for (const ShaftData* shaft : shafts_.all()) lengths.push_back(shaft->length());
  std::optional<LooseMotion> loose;
  for (;;) {
    tangent.supports_.supports.clear();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i]) tangent.supports_.supports.push_back(supports_.supports[i]);
    }
    loose = find_loose_motion(lengths, tangent.supports_.supports);
    if (!loose || loose->beam == index_.pinion || loose->beam == index_.wheel || !keep_bearings_of(loose->beam, kept)) break;
  }
  if (loose) {
    throw InvalidInput("load.torque", in_words(pinion_torque / units::newton_metre),
                       "a load that presses the shaft \"" + shafts_.names()[static_cast<std::size_t>(loose->beam)] +
                           "\" against its bearings: it lies loose within their clearances");
  }
  std::vector<Eigen::Index> left;
  std::vector<int> index(supports_.supports.size(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    index[i] = static_cast<int>(left.size());
    left.push_back(static_cast<Eigen::Index>(i));
  }
  for (UnitBearing& bearing : tangent.supports_.bearings) {
    for (int& support : bearing.supports) support = support < 0 ? -1 : index[static_cast<std::size_t>(support)];
  }
  for (std::vector<int>* held : {&tangent.supports_.turning, &tangent.supports_.tilting}) {
    for (int& support : *held) support = support < 0 ? -1 : index[static_cast<std::size_t>(support)];
  }
  tangent.supports_.further = further(left, left);
  tangent.prestrain_ = prestrain(left);
  tangent.nonlinear_.clear();
  tangent.nonlinear_bearings_.clear();
  tangent.system_.emplace(pieces_, tangent.supports_.supports, tangent.supports_.further);
  return tangent;
}

ClearanceState ShaftPair::refined(ClearanceState found, const ShaftPair& tangent, double pinion_torque) const {
  const Eigen::VectorXd forces = tangent.mean_reactions(pinion_torque, 0.0);
  for (std::size_t i = 0; i < nonlinear_.size(); ++i) {
    if (!found.carries[i]) continue;
    const std::array<int, 5>& supports = tangent.supports_.bearings[static_cast<std::size_t>(nonlinear_[i])].supports;
    const NonlinearBearing& bearing = nonlinear_bearings_[i];
    const auto at = static_cast<Eigen::Index>(2 * i);
    const Eigen::Vector2d force(-forces[supports[0]], -forces[supports[1]]);
    if (!(force.norm() > 0.0)) continue;
    found.force.segment<2>(at) = force;
    found.shift.segment<2>(at) = (bearing.clearance + (bearing.law ? bearing.law->deflection(force.norm()) : 0.0)) * force.normalized();
  }
  return found;
}

ShaftPair ShaftPair::at_torque(double pinion_torque) const {
  if (nonlinear_.empty()) return *this;
  assert(pinion_torque > 0.0);
  ClearanceState found = bearing_equilibrium(pinion_torque);
  if (!found.converged) {
    throw InvalidInput("load.torque", in_words(pinion_torque / units::newton_metre),
                       "one at which the equilibrium of shafts in their bearings is found; its residual is " + in_words(found.residual));
  }
  ShaftPair tangent = with_tangents(found, pinion_torque);
  const auto has_law = [](const NonlinearBearing& bearing) { return bearing.law.has_value(); };
  if (std::ranges::any_of(nonlinear_bearings_, has_law)) {
    found = refined(std::move(found), tangent, pinion_torque);
    tangent = with_tangents(found, pinion_torque);
  }
  UnitState state = tangent.state(pinion_torque);
  state.linear = false;
  state.converged = found.converged;
  state.clearance_residual = found.residual;
  state.iterations = found.iterations;
  const double mirror = pair_.data.working_flank == WorkingFlank::Left ? -1.0 : 1.0;
  for (std::size_t i = 0; i < nonlinear_.size(); ++i) {
    BearingState& bearing = state.bearings[static_cast<std::size_t>(nonlinear_[i])];
    const NonlinearBearing& given = nonlinear_bearings_[i];
    const Eigen::Vector2d force = found.force.segment<2>(static_cast<Eigen::Index>(2 * i));
    bearing.shift = found.shift.segment<2>(static_cast<Eigen::Index>(2 * i));
    bearing.carries = found.carries[i];
    if (given.law) {
      bearing.law = law_state(given, supports_.bearings[static_cast<std::size_t>(nonlinear_[i])].data.law.type, force.norm());
      // The part of it that is the clearance; where the shaft lies within that, all of it.
      if (force.norm() > 0.0) bearing.shift = given.clearance * force.normalized();
    }
    bearing.shift.y() *= mirror;
  }
  tangent.state_ = std::move(state);
  return tangent;
}

std::shared_ptr<const PairCompliance> ShaftPair::linearised_at(double pinion_torque) const {
  if (nonlinear_.empty()) return nullptr;
  return std::make_shared<const ShaftPair>(at_torque(pinion_torque));
}

void ShaftPair::add_bearings(double pinion_torque, double axial_offset, UnitState& state) const {
  const Eigen::VectorXd forces = mean_reactions(pinion_torque, axial_offset);
  const auto along = [&](int support) { return support < 0 ? 0.0 : forces[support]; };
  const std::vector<std::string> names = shafts_.names();
  for (const UnitBearing& bearing : supports_.bearings) {
    const auto& on = bearing.supports;
    state.bearings.push_back({bearing.name,
                              names[static_cast<std::size_t>(bearing.shaft)],
                              bearing.outer_shaft < 0 ? "" : names[static_cast<std::size_t>(bearing.outer_shaft)],
                              bearing.data.position,
                              {along(on[0]), along(on[1]), along(on[2])},
                              {along(on[3]), along(on[4])},
                              bearing.data.radial_clearance});
  }
}

void ShaftPair::add_shafts(double pinion_torque, double axial_offset, UnitState& state) const {
  const std::vector<BeamLoad> mean = mean_loads(axial_offset);
  const Eigen::VectorXd forces = mean_reactions(pinion_torque, axial_offset);
  const std::vector<Eigen::Vector2d> axes = axes_of(shafts_, pair_);
  // All that acts, to be summed up shaft by shaft.
  std::vector<BeamLoad> acting;
  for (const BeamLoad& load : mean) acting.push_back(load.times(pinion_torque));
  acting.insert(acting.end(), constant_.begin(), constant_.end());
  for (std::size_t i = 0; i < supports_.supports.size(); ++i) {
    const BeamSupport& support = supports_.supports[i];
    const double force = forces[static_cast<Eigen::Index>(i)];
    acting.push_back(support.direction.times(force));
    if (support.against) acting.push_back(support.against->times(-force));
  }
  for (std::size_t i = 0; i < shafts_.all().size(); ++i) {
    const ShaftData& data = *shafts_.all()[i];
    const int beam = static_cast<int>(i);
    ShaftState shaft;
    shaft.name = shafts_.names()[i];
    shaft.axis = axes[i];
    shaft.turning_hold = turning_hold(shafts_, beam, torques_);
    const int holds = supports_.turning[i];
    if (holds >= 0 && !std::isnan(data.torque_position)) shaft.coupling_torque = forces[holds];
    constexpr int pieces = 40;  // stations at equal distances, for a drawing
    double end = 0.0;
    for (int k = 0; k <= pieces; ++k) shaft.z.push_back(data.length() * k / pieces);
    for (const ShaftSection& section : data.sections) shaft.z.push_back(end += section.length);
    for (const UnitBearing& bearing : supports_.bearings) {
      if (bearing.shaft == beam) shaft.z.push_back(bearing.data.position);
      if (bearing.outer_shaft == beam) shaft.z.push_back(bearing.outer_position);
    }
    for (const std::vector<BeamLoad>* loads : {&mean, &constant_}) {
      for (const BeamLoad& load : *loads) {
        if (load.beam == beam) shaft.z.push_back(load.z);
      }
    }
    std::ranges::sort(shaft.z);
    const double round_off = 1e-9 * data.length();  // stations nearer to each other than this are one
    const auto repeated = std::ranges::unique(shaft.z, [&](double a, double b) { return b - a <= round_off; });
    shaft.z.erase(repeated.begin(), repeated.end());
    std::vector<BeamLoad> units;
    for (const double z : shaft.z) {
      for (int k = 0; k < 6; ++k) {
        BeamLoad unit{z, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), beam};
        (k < 3 ? unit.force[k] : unit.moment[k - 3]) = 1.0;
        units.push_back(unit);
      }
    }
    Eigen::VectorXd moved = pinion_torque * system_->flexibility(units, mean, 1, static_cast<int>(mean.size())).col(0);
    if (const Eigen::VectorXd always = fixed_motion(units, 1); always.size() > 0) moved += always;
    for (std::size_t k = 0; k < shaft.z.size(); ++k) {
      shaft.displacement.emplace_back(moved.segment<3>(static_cast<Eigen::Index>(6 * k)));
      shaft.turn.emplace_back(moved.segment<3>(static_cast<Eigen::Index>(6 * k + 3)));
    }
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
    double largest_force = 0.0, largest_moment = 0.0;
    for (const BeamLoad& load : acting) {
      if (load.beam != beam) continue;
      const Eigen::Vector3d about_origin = load.moment + Eigen::Vector3d(0.0, 0.0, load.z).cross(load.force);
      force += load.force;
      moment += about_origin;
      largest_force = std::max(largest_force, load.force.norm());
      largest_moment = std::max({largest_moment, load.moment.norm(), about_origin.norm()});
    }
    shaft.residual = 0.0;
    if (largest_force > 0.0) shaft.residual = force.norm() / largest_force;
    if (largest_moment > 0.0) shaft.residual = std::max(shaft.residual, moment.norm() / largest_moment);
    state.shafts.push_back(std::move(shaft));
  }
}

void ShaftPair::find_drivers(UnitState& state) const {
  // The pinion turns with its torque where it drives; from mesh to mesh turns change sides.
  const double pinion = pair_.data.driver == Member::Pinion ? 1.0 : -1.0;
  std::map<std::string, double> turns{{pair_shafts[0], pinion}, {pair_shafts[1], -pinion}};
  for (std::size_t known = 0; known != turns.size();) {
    known = turns.size();
    for (const MeshState& mesh : state.meshes) {
      for (const auto& [one, two] : {std::pair{0, 1}, std::pair{1, 0}}) {
        const auto from = turns.find(mesh.shafts[static_cast<std::size_t>(one)]);
        if (from != turns.end()) turns.try_emplace(mesh.shafts[static_cast<std::size_t>(two)], -from->second);
      }
    }
  }
  for (MeshState& mesh : state.meshes) {
    if (const auto first = turns.find(mesh.shafts[0]); first != turns.end() && mesh.torque[0] != 0.0)
      mesh.driver = mesh.torque[0] * first->second >= 0.0 ? 0 : 1;
  }
}

void ShaftPair::add_meshes(double pinion_torque, double axial_offset, UnitState& state) const {
  const std::vector<BeamLoad> mean = mean_loads(axial_offset);
  for (std::size_t m = 0; m < shafts_.unit.meshes.size(); ++m) {
    const UnitMesh& mesh = shafts_.unit.meshes[m];
    const double torque = torques_.mesh[m] * pinion_torque, face_width = mesh.face_width();
    MeshState& of = state.meshes.emplace_back();
    of.name = mesh.name.empty() ? "mesh " + std::to_string(m + 1) : mesh.name;
    of.shafts = {mesh.gears[0].shaft, mesh.gears[1].shaft};
    of.torque = {torque, torque * mesh.gears[1].teeth / mesh.gears[0].teeth};
    of.force = mesh_loads(shafts_, mesh, torque)[1].force;
    of.normal_force = of.force.norm();
    of.first_flank = torque >= 0.0 ? WorkingFlank::Right : WorkingFlank::Left;
    if (!(face_width > 0.0)) continue;
    const std::array<BeamLoad, 2> tilt = mesh_tilt(shafts_, mesh, torque);
    const std::vector<BeamLoad> both(tilt.begin(), tilt.end());
    Eigen::VectorXd tilted = pinion_torque * system_->flexibility(both, mean, 2, static_cast<int>(mean.size())).col(0);
    if (const Eigen::VectorXd always = fixed_motion(both, 2); always.size() > 0) tilted += always;
    of.misalignment = face_width * tilted[0];
    if (supports_.tilting[m] < 0) continue;
    const double mean_load = std::hypot(of.force.x(), of.force.y()) / face_width;  // along the transverse base tangent, as the stiffness is
    of.face_load_factor = 1.0 + 0.5 * mesh.stiffness * std::abs(of.misalignment) / mean_load;
  }
}

UnitState ShaftPair::state(double pinion_torque, double axial_offset) const {
  if (state_) return *state_;
  if (!nonlinear_.empty()) return at_torque(pinion_torque).state(pinion_torque, axial_offset);
  UnitState state;
  state.pinion_torque = pinion_torque;
  const double alpha = pair_.working_transverse_pressure_angle, beta = pair_.base_helix_angle, own = force_per_torque() * pinion_torque;
  MeshState& studied = state.meshes.emplace_back();
  studied.name = "pair";
  studied.shafts = {pair_shafts[0], pair_shafts[1]};
  studied.torque = {pinion_torque, pinion_torque * pair_.gear_ratio()};
  studied.normal_force = own;
  studied.force =
      own * Eigen::Vector3d(std::cos(beta) * std::sin(alpha), std::cos(beta) * std::cos(alpha), -pair_.contact_line_sense() * std::sin(beta));
  add_meshes(pinion_torque, axial_offset, state);
  find_drivers(state);
  if (system_) {
    add_bearings(pinion_torque, axial_offset, state);
    add_shafts(pinion_torque, axial_offset, state);
    state.mesh_misalignment = state.outside_misalignment = 0.0;
    const std::vector<ContactPoint> at{pitch_point(axial_offset)};
    const Eigen::VectorXd force = Eigen::VectorXd::Constant(1, own);
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (!has_shaft(m)) continue;
      const double all = motion(m, at, force, axial_offset).misalignment;
      ShaftPair alone = *this;
      alone.outside_.clear();
      alone.constant_.clear();
      alone.prestrain_.resize(0);
      state.mesh_misalignment += all;
      state.outside_misalignment += all - alone.motion(m, at, force, axial_offset).misalignment;
    }
  }
  if (pair_.data.working_flank == WorkingFlank::Right) return state;
  // Back out of the mirror.
  for (MeshState& mesh : state.meshes) {
    mesh.force.y() *= -1.0;
    for (double& torque : mesh.torque) torque *= -1.0;
    mesh.first_flank = mesh.first_flank == WorkingFlank::Right ? WorkingFlank::Left : WorkingFlank::Right;
  }
  for (BearingState& bearing : state.bearings) {
    bearing.force.y() *= -1.0;
    bearing.moment.x() *= -1.0;
    bearing.shift.y() *= -1.0;
  }
  for (ShaftState& shaft : state.shafts) {
    shaft.axis.y() *= -1.0;
    shaft.coupling_torque *= -1.0;
    for (Eigen::Vector3d& moved : shaft.displacement) moved.y() *= -1.0;
    for (Eigen::Vector3d& turned : shaft.turn) turned = {-turned.x(), turned.y(), -turned.z()};
  }
  return state;
}

}  // namespace flankwright
