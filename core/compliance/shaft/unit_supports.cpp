#include "core/compliance/shaft/unit_supports.hpp"

#include <algorithm>
#include <cmath>

#include "core/compliance/shaft/unit_statics.hpp"

namespace flankwright {

namespace {

using Eigen::Vector3d;

constexpr double turns_rigidly = std::numeric_limits<double>::infinity();

class Making {
 public:
  explicit Making(const ShaftsOfPair& shafts) : shafts_(shafts) {}

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
      const double hold_at = turning_hold(shafts_, static_cast<int>(i));
      made_.turning.push_back(std::isnan(hold_at) ? -1
                                                  : hold({hold_at, Vector3d::Zero(), Vector3d::UnitZ(), static_cast<int>(i)}, {}, turns_rigidly));
    }
    for (const ShaftJoint& joint : shafts_.unit.joints) {
      const std::string name = joint.bearing.name.empty() ? joint.shaft + " in " + joint.outer_shaft : joint.bearing.name;
      add({name, *shafts_.find(joint.shaft), *shafts_.find(joint.outer_shaft), joint.outer_position, joint.bearing});
    }
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
    bearing.supports[0] = held(x, none, bearing.data.radial_stiffness);
    bearing.supports[3] = held(none, x, bearing.data.tilting_stiffness);
    bearing.supports[1] = held(y, none, bearing.data.radial_stiffness);
    bearing.supports[4] = held(none, y, bearing.data.tilting_stiffness);
    bearing.supports[2] = held(Vector3d::UnitZ(), none, bearing.data.axial_stiffness);
    made_.bearings.push_back(std::move(bearing));
  }

  /// The inverse of the housing's stiffness, where its seats have supports.
  void add_housing() {
    const Housing& housing = shafts_.unit.housing;
    if (housing.seats.empty()) return;
    const Eigen::MatrixXd compliance = housing.stiffness.ldlt().solve(Eigen::MatrixXd::Identity(housing.stiffness.rows(), housing.stiffness.cols()));
    std::vector<int> support_of(static_cast<std::size_t>(compliance.rows()), -1);
    for (std::size_t s = 0; s < housing.seats.size(); ++s) {
      const auto bearing = std::ranges::find(made_.bearings, housing.seats[s], &UnitBearing::name);
      for (std::size_t k = 0; k < 3 && bearing != made_.bearings.end(); ++k) support_of[3 * s + k] = bearing->supports[k];
    }
    made_.housing = Eigen::MatrixXd::Zero(std::ssize(made_.supports), std::ssize(made_.supports));
    for (Eigen::Index i = 0; i < compliance.rows(); ++i) {
      for (Eigen::Index j = 0; j < compliance.cols(); ++j) {
        const int at_i = support_of[static_cast<std::size_t>(i)], at_j = support_of[static_cast<std::size_t>(j)];
        if (at_i >= 0 && at_j >= 0) made_.housing(at_i, at_j) = 0.5 * (compliance(i, j) + compliance(j, i));
      }
    }
  }

  const ShaftsOfPair& shafts_;
  UnitSupports made_;
};

}  // namespace

UnitSupports make_supports(const ShaftsOfPair& shafts) { return Making(shafts).make(); }

std::string restraint_in_words(const LooseMotion& loose) {
  const auto is = [](double part) { return std::abs(part) == 1.0; };  // the largest part, see LooseMotion
  if (is(loose.translation.z())) return "one that is held along its axis: axial_stiffness of a bearing";
  if (is(loose.turn.z())) return "one that is held against turning: torque_position, a gear of another mesh, or a load with a torque";
  if (is(loose.turn.x()) || is(loose.turn.y())) return "one that is held against tilting: a second bearing, or tilting_stiffness";
  return "one that is held across its axis: a bearing, or a second one or tilting_stiffness";
}

}  // namespace flankwright
