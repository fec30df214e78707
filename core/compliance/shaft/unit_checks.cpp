#include "core/compliance/shaft/unit_checks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/findings.hpp"
#include "core/base/positive_definite.hpp"
#include "core/compliance/shaft/unit_layout.hpp"
#include "core/compliance/shaft/unit_statics.hpp"
#include "core/compliance/shaft/unit_supports.hpp"

namespace flankwright {

namespace {

class Checking : Findings {
 public:
  Checking(const ShaftsOfPair& shafts, const GearPair& pair) : shafts_(shafts), unit_(shafts.unit), pair_(pair), all_(shafts.all()) {}

  std::vector<InvalidInput> run() {
    for (const auto check :
         {&Checking::check_names, &Checking::check_shafts, &Checking::check_meshes, &Checking::check_places, &Checking::check_loads,
          &Checking::check_joints, &Checking::check_housing, &Checking::check_restraints, &Checking::check_torques}) {
      (this->*check)();
      if (!empty()) break;  // what follows needs what came before
    }
    return take();
  }

 private:
  void check_shafts() {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const std::string name = shafts_.names()[i];
      const bool of_pair = std::ranges::find(pair_shafts, name) != pair_shafts.end();
      const double face_width = !of_pair ? 0.0 : pair_[name == pair_shafts[0] ? Member::Pinion : Member::Wheel].data.face_width;
      for (const InvalidInput& problem :
           unit_.empty() ? flankwright::find_problems(*all_[i], face_width) : find_problems_in_unit(*all_[i], face_width)) {
        add({shafts_.table(static_cast<int>(i)) + "." + problem.field(), problem.value(), problem.allowed()});
      }
    }
  }

  void check_names() {
    std::set<std::string> known(pair_shafts.begin(), pair_shafts.end());
    for (std::size_t i = 0; i < unit_.shafts.size(); ++i) {
      const std::string& name = unit_.shafts[i].name;
      require(!name.empty() && known.insert(name).second, "unit.shafts." + std::to_string(i) + ".name", name.empty() ? "(not given)" : name,
              "a name of its own, neither pinion nor wheel");
    }
    if (!unit_.empty()) check_names_of_parts();
  }

  void check_names_of_parts() {
    std::map<std::string, std::string> bearings, meshes;  // by name their keys
    const auto check = [this](std::map<std::string, std::string>& known_names, const std::string& name, const std::string& key) {
      if (name.empty()) return;
      const auto [first, is_new] = known_names.emplace(name, key);
      require(is_new, key, name, "a name of its own: " + first->second + " has this one");
    };
    for (std::size_t i = 0; i < all_.size(); ++i) {
      for (std::size_t k = 0; k < all_[i]->bearings.size(); ++k) {
        check(bearings, all_[i]->bearings[k].name, shafts_.table(static_cast<int>(i)) + ".bearings." + std::to_string(k) + ".name");
      }
    }
    for (std::size_t i = 0; i < unit_.joints.size(); ++i) check(bearings, unit_.joints[i].bearing.name, "unit.joints." + std::to_string(i) + ".name");
    for (std::size_t i = 0; i < unit_.meshes.size(); ++i) check(meshes, unit_.meshes[i].name, "unit.meshes." + std::to_string(i) + ".name");
  }

  std::string shafts_in_words() const {
    std::string words;
    for (const std::string& name : shafts_.names()) words += (words.empty() ? "one of " : ", ") + name;
    return words.empty() ? "none: no shaft is described" : words;
  }

  /// Of something on a shaft that takes this width around its position.
  void check_place(const std::string& table, const std::string& shaft_key, const std::string& shaft, const std::string& position_key, double position,
                   double width) {
    const std::optional<int> on = shafts_.find(shaft);
    require(on.has_value(), table + shaft_key, shaft.empty() ? "(not given)" : shaft, shafts_in_words());
    if (!on) return;
    const double length = all_[static_cast<std::size_t>(*on)]->length(), round_off = 1e-9 * length;
    require(position >= 0.5 * width - round_off && position <= length - 0.5 * width + round_off, table + position_key, position,
            "on the shaft \"" + shaft + "\"" + (width > 0.0 ? " with the whole face" : "") + ", " + in_words(0.5 * width) + " .. " +
                in_mm(length - 0.5 * width));
  }

  void check_meshes() {
    for (std::size_t m = 0; m < unit_.meshes.size(); ++m) {
      const UnitMesh& mesh = unit_.meshes[m];
      const std::string table = "unit.meshes." + std::to_string(m) + ".";
      for (std::size_t g = 0; g < 2; ++g) {
        const std::string number = g == 0 ? "_1" : "_2";
        const UnitGear& gear = mesh.gears[g];
        check_place(table, "shaft" + number, gear.shaft, "position" + number, gear.position, gear.face_width);
        require(gear.teeth >= 5, table + "teeth" + number, gear.teeth, "at least 5");
      }
      require(mesh.gears[0].shaft != mesh.gears[1].shaft, table + "shaft_2", mesh.gears[1].shaft, "another shaft than shaft_1");
      require(mesh.normal_module > 0.0, table + "normal_module", mesh.normal_module, "above 0 mm");
      require(!std::isnan(mesh.angle), table + "angle", mesh.angle, "a number");
      require(std::isnan(mesh.stiffness) || mesh.stiffness > 0.0, table + "stiffness", mesh.stiffness, "above 0");
      require(!mesh.resists_tilting() || mesh.face_width() > 0.0, table + "stiffness", in_words(mesh.stiffness / 1e3) + " N/(mm um)",
              "none without face_width_1 and face_width_2, along which the teeth hold the shafts against tilting");
      if (!empty()) return;
      const MeshGeometry of = geometry_of(mesh);
      const double least = of.base_radius[0] + of.base_radius[1];
      constexpr double reach = 5.0;  // (a_w - a) / m_n is at most this: addenda of 1.25 m_n, and both profile shifts together 2.5 m_n
      const double most = of.reference_radius[0] + of.reference_radius[1] + reach * mesh.normal_module;
      require(std::isnan(mesh.centre_distance) || (mesh.centre_distance > least && mesh.centre_distance <= most), table + "centre_distance",
              mesh.centre_distance,
              "above " + in_mm(least) + ", the sum of the base radii, and at most " + in_mm(most) + ", beyond which teeth do not reach each other");
    }
  }

  void check_places() { add(find_place_problems(shafts_, pair_)); }

  void check_loads() {
    bool given = false;
    for (std::size_t i = 0; i < unit_.loads.size(); ++i) {
      const UnitLoad& load = unit_.loads[i];
      const std::string table = "unit.loads." + std::to_string(i) + ".";
      check_place(table, "shaft", load.shaft, "position", load.position, 0.0);
      require(!load.constant || load.moment.z() == 0.0, table + "torque", load.moment.z() / units::newton_metre,
              "0 with constant = \"yes\": torques are in proportion to the load, or they do not balance");
      given = given || !load.constant;
    }
    for (const UnitMesh& mesh : unit_.meshes) given = given || !std::isnan(mesh.torque);
    require(!given || unit_.reference_torque > 0.0, "unit.reference_torque", unit_.reference_torque,
            "above 0 N m: the pinion's torque at which loads and torques of meshes are meant");
  }

  void check_joints() {
    std::set<std::pair<std::string, double>> places;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      for (const ShaftBearing& bearing : all_[i]->bearings) places.emplace(shafts_.names()[i], bearing.position);
    }
    for (std::size_t i = 0; i < unit_.joints.size(); ++i) {
      const ShaftJoint& joint = unit_.joints[i];
      const std::string table = "unit.joints." + std::to_string(i) + ".";
      check_place(table, "shaft", joint.shaft, "position", joint.bearing.position, 0.0);
      check_place(table, "outer_shaft", joint.outer_shaft, "outer_position", joint.outer_position, 0.0);
      require(joint.shaft != joint.outer_shaft, table + "outer_shaft", joint.outer_shaft, "another shaft than the inner one");
      require(places.emplace(joint.shaft, joint.bearing.position).second, table + "position", joint.bearing.position, "a position of its own");
      require(places.emplace(joint.outer_shaft, joint.outer_position).second, table + "outer_position", joint.outer_position,
              "a position of its own");
      require(joint.bearing.radial_stiffness > 0.0, table + "radial_stiffness", joint.bearing.radial_stiffness, "above 0");
      require(joint.bearing.axial_stiffness >= 0.0, table + "axial_stiffness", joint.bearing.axial_stiffness, "at least 0");
      require(joint.bearing.tilting_stiffness >= 0.0, table + "tilting_stiffness", joint.bearing.tilting_stiffness, "at least 0");
      for (const InvalidInput& problem : find_yielding_problems(joint.bearing))
        require(false, table + problem.field(), problem.value(), problem.allowed());
    }
  }

  void check_housing() {
    const Housing& housing = unit_.housing;
    if (housing.seats.empty())
      return require(housing.stiffness.size() == 0, "unit.housing.seats", "(not given)", "the bearings that the stiffness is of");
    const UnitSupports supports = make_supports(without_housing());
    std::set<std::string> named;
    for (const std::string& seat : housing.seats) {
      const auto bearing = std::ranges::find(supports.bearings, seat, &UnitBearing::name);
      const bool on_housing = bearing != supports.bearings.end() && bearing->outer_shaft < 0;
      require(on_housing && std::ranges::count(supports.bearings, seat, &UnitBearing::name) == 1, "unit.housing.seats", seat,
              "the name of one bearing, on the housing");
      require(named.insert(seat).second, "unit.housing.seats", seat, "each bearing once");
    }
    const Eigen::Index size = 3 * std::ssize(housing.seats);
    const Eigen::MatrixXd& k = housing.stiffness;
    require(k.rows() == size && k.cols() == size, "unit.housing.stiffness", std::to_string(k.size()) + " numbers",
            std::to_string(size * size) + " numbers: a row for x, y and z of each of " + std::to_string(housing.seats.size()) + " seats");
    if (!empty()) return;
    constexpr double round_off = 1e-6;  // |k_ij - k_ji| at most this part of sqrt(k_ii k_jj): matrices come rounded
    const Eigen::ArrayXd scale = k.diagonal().array().abs().sqrt();
    const bool is_symmetric = ((k - k.transpose()).array().abs() <= round_off * (scale.matrix() * scale.matrix().transpose()).array()).all();
    require(is_symmetric, "unit.housing.stiffness", "not symmetric", "a symmetric matrix");
    require(is_positive_definite(k), "unit.housing.stiffness", "not positive definite",
            "a matrix that is positive definite, to the seventh digit: no motion of the seats without force");
  }

  ShaftsOfPair without_housing() const {
    ShaftsOfPair others = shafts_;
    others.unit.housing = {};
    return others;
  }

  void check_restraints() {
    if (unit_.empty() || all_.empty()) return;
    std::vector<double> lengths;
    for (const ShaftData* shaft : all_) lengths.push_back(shaft->length());
    const std::optional<LooseMotion> loose = find_loose_motion(lengths, make_supports(shafts_).supports);
    if (!loose) return;
    const bool turns = std::abs(loose->turn.z()) == 1.0;
    require(false, shafts_.table(loose->beam) + (turns ? ".torque_position" : ".bearings"),
            "a shaft \"" + shafts_.names()[static_cast<std::size_t>(loose->beam)] + "\" that can move as a rigid body", restraint_in_words(*loose));
  }

  void check_torques() {
    if (unit_.empty()) return;
    const UnitTorques torques = torques_as_analysed(shafts_, pair_);
    require(torques.determined, "unit.meshes", "torques that the balance leaves open",
            "torque_1 of a mesh, or a torque among the loads, wherever a shaft shares its torque between several gears and couplings");
    for (const auto& [shaft, left] : torques.unbalanced) {
      require(
          false, shafts_.table(shaft), in_words(left) + " N m left over for each N m on the pinion",
          "torques that balance: a coupling (torque_position), a load or a gear that takes it. About z the pinion's torque is positive where it works on its "
          "right flank, negative on the left one");
    }
  }

  const ShaftsOfPair& shafts_;
  const UnitData& unit_;
  const GearPair& pair_;
  std::vector<const ShaftData*> all_;
};

}  // namespace

std::vector<InvalidInput> find_problems(const ShaftsOfPair& shafts, const GearPair& pair) {
  std::vector<InvalidInput> problems = Checking(shafts, pair).run();
  return problems.empty() ? find_layout_problems(shafts, pair) : problems;
}

}  // namespace flankwright
