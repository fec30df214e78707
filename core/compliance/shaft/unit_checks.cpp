#include "core/compliance/shaft/unit_checks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/findings.hpp"
#include "core/base/positive_definite.hpp"
#include "core/compliance/shaft/unit_statics.hpp"
#include "core/compliance/shaft/unit_supports.hpp"

namespace flankwright {

namespace {

std::string in_mm(double length) { return in_words(length) + " mm"; }

class Checking : Findings {
 public:
  Checking(const ShaftsOfPair& shafts, const GearPair& pair) : shafts_(shafts), unit_(shafts.unit), pair_(pair), all_(shafts.all()) {}

  std::vector<InvalidInput> run() {
    for (const auto check : {&Checking::check_names, &Checking::check_shafts, &Checking::check_meshes, &Checking::check_places,
                             &Checking::check_loads, &Checking::check_joints, &Checking::check_housing, &Checking::check_restraints,
                             &Checking::check_torques, &Checking::check_axes, &Checking::check_room}) {
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

  /// A gear's place along a shaft. A width of 0 takes no place.
  struct Place {
    std::string table, shaft;
    double position, width;
    int teeth;
    double normal_module;
  };

  /// Gears that take the same place are one gear with several meshes.
  void check_places() {
    std::vector<Place> taken;
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (const std::optional<ShaftData>& shaft = shafts_.shaft[m])
        taken.push_back({name_of(m), name_of(m), shaft->gear_position, pair_[m].data.face_width, pair_[m].data.teeth, pair_.data.normal_module});
    }
    for (std::size_t m = 0; m < unit_.meshes.size(); ++m) {
      for (std::size_t g = 0; g < 2; ++g) {
        const UnitGear& gear = unit_.meshes[m].gears[g];
        const std::string table = "unit.meshes." + std::to_string(m), number = g == 0 ? "_1" : "_2";
        const Place place{
            table + ", gear " + std::to_string(g + 1), gear.shaft, gear.position, gear.face_width, gear.teeth, unit_.meshes[m].normal_module};
        for (const Place& other : taken) {
          constexpr double round_off = 1e-9;  // gears that touch overlap by at most this part of their widths
          const bool overlap = place.shaft == other.shaft && place.width > 0.0 && other.width > 0.0 &&
                               std::abs(place.position - other.position) < (0.5 - round_off) * (place.width + other.width);
          require(!overlap || (place.teeth == other.teeth && std::abs(place.normal_module / other.normal_module - 1.0) < 1e-6),
                  table + ".position" + number, place.position,
                  "a place beside that of " + other.table + " (" + std::to_string(other.teeth) + " teeth, " + in_mm(other.normal_module) +
                      "), or the same teeth and module: gears that overlap on a shaft are one gear");
        }
        taken.push_back(place);
      }
    }
  }

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
    ShaftsOfPair analysed = shafts_;
    if (pair_.data.working_flank == WorkingFlank::Left) analysed = mirrored(std::move(analysed));
    const UnitTorques torques = torque_balance(analysed, pair_);
    require(torques.determined, "unit.meshes", "torques that the balance leaves open",
            "torque_1 of a mesh, or a torque among the loads, wherever a shaft shares its torque between several gears and couplings");
    for (const auto& [shaft, left] : torques.unbalanced) {
      require(
          false, shafts_.table(shaft), in_words(left) + " N m left over for each N m on the pinion",
          "torques that balance: a coupling (torque_position), a load or a gear that takes it. About z the pinion's torque is positive where it works on its "
          "right flank, negative on the left one");
    }
  }

  void check_axes() {
    const std::vector<Eigen::Vector2d> axes = axes_of(shafts_, pair_);
    const auto apart = [&](const std::string& one, const std::string& two) -> Eigen::Vector2d {
      return axes[static_cast<std::size_t>(*shafts_.find(two))] - axes[static_cast<std::size_t>(*shafts_.find(one))];
    };
    constexpr double same_axis = 0.1;  // [mm]: centre distances and angles come rounded
    for (std::size_t m = 0; m < unit_.meshes.size(); ++m) {
      const UnitMesh& mesh = unit_.meshes[m];
      const double distance = geometry_of(mesh).centre_distance;
      const Eigen::Vector2d here = apart(mesh.gears[0].shaft, mesh.gears[1].shaft);
      const Eigen::Vector2d wanted(distance * std::cos(mesh.angle), distance * std::sin(mesh.angle));
      const bool meets = !here.allFinite() || (here - wanted).norm() <= same_axis;
      require(meets, "unit.meshes." + std::to_string(m) + ".angle", in_words(mesh.angle / units::deg),
              "the angle (and centre_distance) between the axes as the other meshes and joints have them, " +
                  in_words(std::atan2(here.y(), here.x()) / units::deg) + " deg at " + in_mm(here.norm()));
    }
    for (std::size_t i = 0; i < unit_.joints.size(); ++i) {
      const Eigen::Vector2d here = apart(unit_.joints[i].shaft, unit_.joints[i].outer_shaft);
      require(!here.allFinite() || here.norm() <= same_axis, "unit.joints." + std::to_string(i) + ".outer_shaft", unit_.joints[i].outer_shaft,
              "a shaft on the same axis: these lie " + in_mm(here.norm()) + " apart");
    }
  }

  /// Along z the shafts lie as their meshes have them, mid face by mid face. [mm], of each shaft's first end from mid face of the pair; NaN of those
  /// that nothing joins.
  std::vector<double> first_ends() const {
    std::vector<double> ends(all_.size(), not_given);
    const auto end_of = [&](const std::string& shaft) -> double& { return ends[static_cast<std::size_t>(*shafts_.find(shaft))]; };
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (shafts_.shaft[m]) end_of(name_of(m)) = -shafts_.shaft[m]->gear_position;
    }
    bool found = true;
    const auto join = [&](const std::string& one, double at_one, const std::string& two, double at_two) {
      double &end_one = end_of(one), &end_two = end_of(two);
      if (std::isnan(end_one) == std::isnan(end_two)) return;
      (std::isnan(end_one) ? end_one = end_two + at_two - at_one : end_two = end_one + at_one - at_two);
      found = true;
    };
    while (found) {
      found = false;
      for (const UnitMesh& mesh : unit_.meshes) join(mesh.gears[0].shaft, mesh.gears[0].position, mesh.gears[1].shaft, mesh.gears[1].position);
      for (const ShaftJoint& joint : unit_.joints) join(joint.shaft, joint.bearing.position, joint.outer_shaft, joint.outer_position);
    }
    return ends;
  }

  /// A gear in the room of the unit. A width of 0 takes none.
  struct Body {
    std::string name, shaft;
    int mesh;  ///< -1: the pair's
    double position, width, root_radius;
  };

  /// Gears of different shafts take no common room: their root cylinders stay apart wherever their faces overlap.
  void check_room() {
    constexpr double dedendum = 1.25;  // h_fP [modules], as of the basic rack; profile shifts of meshes are not known
    std::vector<Body> taken;
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (!shafts_.shaft[m]) continue;
      const double radius = pair_.data.normal_module * pair_[m].data.teeth / (2.0 * std::cos(pair_.data.helix_angle));
      taken.push_back({std::string("the ") + name_of(m), name_of(m), -1, shafts_.shaft[m]->gear_position, pair_[m].data.face_width,
                       radius - dedendum * pair_.data.normal_module});
    }
    const std::vector<Eigen::Vector2d> axes = axes_of(shafts_, pair_);
    const std::vector<double> ends = first_ends();
    const auto index = [&](const std::string& shaft) { return static_cast<std::size_t>(*shafts_.find(shaft)); };
    for (std::size_t m = 0; m < unit_.meshes.size(); ++m) {
      const UnitMesh& mesh = unit_.meshes[m];
      for (std::size_t g = 0; g < 2; ++g) {
        const Body body{"gear " + std::to_string(g + 1) + " of unit.meshes." + std::to_string(m),
                        mesh.gears[g].shaft,
                        static_cast<int>(m),
                        mesh.gears[g].position,
                        mesh.gears[g].face_width,
                        geometry_of(mesh).reference_radius[g] - dedendum * mesh.normal_module};
        for (const Body& other : taken) {
          if (other.shaft == body.shaft || other.mesh == body.mesh || !(std::min(body.width, other.width) > 0.0)) continue;
          const double along = std::abs(ends[index(body.shaft)] + body.position - ends[index(other.shaft)] - other.position);
          const double apart = (axes[index(body.shaft)] - axes[index(other.shaft)]).norm(), least = body.root_radius + other.root_radius;
          const bool meet = along < 0.5 * std::max(body.width, other.width) && apart < least;  // false where either is not known
          require(!meet, "unit.meshes." + std::to_string(m) + ".angle", in_words(mesh.angle / units::deg),
                  "one that leaves room for its gears: " + body.name + " and " + other.name + " overlap along the shafts, with axes " + in_mm(apart) +
                      " apart, and their roots need " + in_mm(least));
        }
        taken.push_back(body);
      }
    }
  }

  const ShaftsOfPair& shafts_;
  const UnitData& unit_;
  const GearPair& pair_;
  std::vector<const ShaftData*> all_;
};

}  // namespace

std::vector<InvalidInput> find_problems(const ShaftsOfPair& shafts, const GearPair& pair) { return Checking(shafts, pair).run(); }

}  // namespace flankwright
