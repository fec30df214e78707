#include "core/compliance/shaft/unit_supports.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

using Eigen::Vector3d;

constexpr double rigid_support = std::numeric_limits<double>::infinity();

class Making {
 public:
  Making(const ShaftsOfPair& shafts, const UnitTorques& torques) : shafts_(shafts), torques_(torques) {}

  UnitSupports make() {
    const std::vector<const ShaftData*> all = shafts_.all();
    const std::vector<std::string> names = shafts_.names();
    for (std::size_t i = 0; i < all.size(); ++i) {
      int number = 0;
      for (const ShaftBearing& bearing : all[i]->bearings) {
        ++number;
        add({bearing.name.empty() ? names[i] + " " + std::to_string(number) : bearing.name, static_cast<int>(i), -1, not_given, bearing});
      }
      // In the order of the pair's shafts before there was a unit: what holds against turning follows the shaft's bearings.
      const double hold_at = turning_hold(shafts_, static_cast<int>(i), torques_);
      made_.turning.push_back(std::isnan(hold_at) ? -1
                                                  : hold({hold_at, Vector3d::Zero(), Vector3d::UnitZ(), static_cast<int>(i)}, {}, rigid_support));
    }
    for (const ShaftJoint& joint : shafts_.unit.joints) {
      const std::string name = joint.bearing.name.empty() ? joint.shaft + " in " + joint.outer_shaft : joint.bearing.name;
      add({name, *shafts_.find(joint.shaft), *shafts_.find(joint.outer_shaft), joint.outer_position, joint.bearing});
    }
    for (std::size_t m = 0; m < shafts_.unit.meshes.size(); ++m) add_mesh(shafts_.unit.meshes[m], torques_.mesh[m]);
    add_matrices();
    add_housing();
    return std::move(made_);
  }

 private:
  int hold(const BeamLoad& direction, const std::optional<BeamLoad>& against, double stiffness) {
    if (!(stiffness > 0.0)) return -1;
    made_.supports.push_back({direction, 1.0 / stiffness, against});  // 1/infinity: rigid
    return static_cast<int>(made_.supports.size()) - 1;
  }

  void add(UnitBearing bearing) {
    const auto held = [&](const Vector3d& force, const Vector3d& moment, double stiffness) {
      std::optional<BeamLoad> against;
      if (bearing.outer_shaft >= 0) against = BeamLoad{bearing.outer_position, force, moment, bearing.outer_shaft};
      return hold({bearing.data.position, force, moment, bearing.shaft}, against, stiffness);
    };
    const Vector3d none = Vector3d::Zero(), x = Vector3d::UnitX(), y = Vector3d::UnitY();
    const ShaftBearing& data = bearing.data;
    const std::array<bool, 5> holds = data.holds();
    const auto stiffness = [&](std::size_t i, double own) { return !holds[i] ? 0.0 : data.has_matrix() ? rigid_support : own; };
    bearing.supports[0] = held(x, none, stiffness(0, data.radial_stiffness));
    bearing.supports[3] = held(none, x, stiffness(3, data.tilting_stiffness));
    bearing.supports[1] = held(y, none, stiffness(1, data.radial_stiffness));
    bearing.supports[4] = held(none, y, stiffness(4, data.tilting_stiffness));
    bearing.supports[2] = held(Vector3d::UnitZ(), none, stiffness(2, data.axial_stiffness));
    made_.bearings.push_back(std::move(bearing));
  }

  void add_mesh(const UnitMesh& mesh, double torque) {
    made_.tilting.push_back(-1);
    if (!mesh.resists_tilting() || torque == 0.0) return;
    const std::array<BeamLoad, 2> tilt = mesh_tilt(shafts_, mesh, torque);
    // Of one against the other: the same moment as `direction`, see BeamSupport.
    made_.tilting.back() = hold(tilt[1], tilt[0].times(-1.0), mesh.stiffness * std::pow(mesh.face_width(), 3) / 12.0);
  }

  /// Adds a compliance between some of the supports.
  /// @param support_of  of each row the index of its support, -1: none, which counts as rigid
  void add_further(const Eigen::MatrixXd& compliance, const std::vector<int>& support_of) {
    const auto all = std::ssize(made_.supports);
    if (made_.further.size() == 0) made_.further = Eigen::MatrixXd::Zero(all, all);
    for (Eigen::Index i = 0; i < compliance.rows(); ++i) {
      for (Eigen::Index j = 0; j < compliance.cols(); ++j) {
        const int at_i = support_of[static_cast<std::size_t>(i)], at_j = support_of[static_cast<std::size_t>(j)];
        if (at_i >= 0 && at_j >= 0) made_.further(at_i, at_j) += 0.5 * (compliance(i, j) + compliance(j, i));
      }
    }
  }

  static Eigen::MatrixXd inverse(const Eigen::MatrixXd& stiffness) {
    return stiffness.ldlt().solve(Eigen::MatrixXd::Identity(stiffness.rows(), stiffness.cols()));
  }

  /// The inverses of the bearings' matrices, where these hold.
  void add_matrices() {
    for (const UnitBearing& bearing : made_.bearings) {
      if (!bearing.data.has_matrix()) continue;
      std::vector<Eigen::Index> held;
      std::vector<int> support_of;
      for (std::size_t k = 0; k < bearing.supports.size(); ++k) {
        if (bearing.supports[k] < 0) continue;
        held.push_back(static_cast<Eigen::Index>(k));
        support_of.push_back(bearing.supports[k]);
      }
      add_further(inverse(bearing.data.stiffness_matrix(held, held)), support_of);
    }
  }

  /// The inverse of the housing's stiffness, where its seats have supports.
  void add_housing() {
    const Housing& housing = shafts_.unit.housing;
    if (housing.seats.empty()) return;
    const Eigen::MatrixXd compliance = inverse(housing.stiffness);
    std::vector<int> support_of(static_cast<std::size_t>(compliance.rows()), -1);
    for (std::size_t s = 0; s < housing.seats.size(); ++s) {
      const auto bearing = std::ranges::find(made_.bearings, housing.seats[s], &UnitBearing::name);
      for (std::size_t k = 0; k < 3 && bearing != made_.bearings.end(); ++k) support_of[3 * s + k] = bearing->supports[k];
    }
    add_further(compliance, support_of);
  }

  const ShaftsOfPair& shafts_;
  const UnitTorques& torques_;
  UnitSupports made_;
};

}  // namespace

UnitSupports make_supports(const ShaftsOfPair& shafts) {
  return make_supports(shafts, UnitTorques{std::vector(shafts.unit.meshes.size(), 0.0), {}, {}});
}

UnitSupports make_supports(const ShaftsOfPair& shafts, const UnitTorques& torques) { return Making(shafts, torques).make(); }

std::string restraint_in_words(const LooseMotion& loose) {
  const auto is = [](double part) { return std::abs(part) == 1.0; };  // the largest part, see LooseMotion
  if (is(loose.translation.z())) return "one that is held along its axis: axial_stiffness of a bearing";
  if (is(loose.turn.z())) return "one that is held against turning: torque_position, a gear of another mesh, or a load with a torque";
  if (is(loose.turn.x()) || is(loose.turn.y())) return "one that is held against tilting: a second bearing, or tilting_stiffness";
  return "one that is held across its axis: a bearing, or a second one or tilting_stiffness";
}

}  // namespace flankwright
