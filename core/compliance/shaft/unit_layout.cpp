#include "core/compliance/shaft/unit_layout.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/findings.hpp"
#include "core/compliance/shaft/unit_statics.hpp"

namespace flankwright {

namespace {

std::string mesh_table(std::size_t mesh) { return "unit.meshes." + std::to_string(mesh); }

const char* word_of(Hand hand) { return hand == Hand::Right ? "right" : "left"; }

Hand opposite(Hand hand) { return hand == Hand::Right ? Hand::Left : Hand::Right; }

/// A gear's place along a shaft. A width of 0 takes no place.
struct Place {
  std::string table, shaft;
  double position, width;
  int teeth;
  double normal_module, pressure_angle, helix_angle;
  Hand hand;

  bool overlaps(const Place& other) const {
    constexpr double round_off = 1e-9;  // gears that touch overlap by at most this part of their widths
    return shaft == other.shaft && width > 0.0 && other.width > 0.0 &&
           std::abs(position - other.position) < (0.5 - round_off) * (width + other.width);
  }
};

/// Gears that take the same place are one gear with several meshes, and have one set of teeth.
void require_same_teeth(const Place& place, const Place& other, std::size_t mesh, const std::string& number, Findings& findings) {
  constexpr double round_off = 1e-6;  // of modules relative to each other, and of angles [rad]
  const std::string table = mesh_table(mesh), same = "that of " + other.table + ", which is the same gear: ";
  const bool is_other_gear = place.teeth != other.teeth || std::abs(place.normal_module / other.normal_module - 1.0) > round_off;
  findings.require(!is_other_gear, table + ".position" + number, place.position,
                   "a place beside that of " + other.table + " (" + std::to_string(other.teeth) + " teeth, " + in_mm(other.normal_module) +
                       "), or the same teeth and module: gears that overlap on a shaft are one gear");
  if (is_other_gear) return;
  findings.require(std::abs(place.helix_angle - other.helix_angle) <= round_off, table + ".helix_angle", place.helix_angle / units::deg,
                   same + in_words(other.helix_angle / units::deg) + " deg");
  findings.require(std::abs(place.pressure_angle - other.pressure_angle) <= round_off, table + ".pressure_angle", place.pressure_angle / units::deg,
                   same + in_words(other.pressure_angle / units::deg) + " deg");
  if (other.helix_angle == 0.0 || place.helix_angle == 0.0) return;
  const bool is_first = number == "_1";  // hand_1 is given, the other gear's is the opposite
  findings.require(place.hand == other.hand, table + ".hand_1", word_of(is_first ? place.hand : opposite(place.hand)),
                   std::string("\"") + word_of(is_first ? other.hand : opposite(other.hand)) + "\": its gear " + (is_first ? "1" : "2") +
                       " is the same as " + other.table + ", with the hand \"" + word_of(other.hand) + "\"");
}

class Layout : Findings {
 public:
  Layout(const ShaftsOfPair& shafts, const GearPair& pair)
      : shafts_(shafts), unit_(shafts.unit), pair_(pair), all_(shafts.all()), ends_(first_ends()) {}

  std::vector<InvalidInput> run() {
    for (const auto check : {&Layout::check_axes, &Layout::check_along, &Layout::check_speeds, &Layout::check_room}) {
      (this->*check)();
      if (!empty()) break;  // what follows needs what came before
    }
    return take();
  }

 private:
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

  /// Faces of a mesh meet along the shafts, and joints of the same two shafts lie equally far apart on both.
  void check_along() {
    for (std::size_t m = 0; m < unit_.meshes.size(); ++m) {
      const std::array<UnitGear, 2>& gears = unit_.meshes[m].gears;
      if (!(std::min(gears[0].face_width, gears[1].face_width) > 0.0)) continue;
      const double apart = std::abs(along(gears[0].shaft, gears[0].position) - along(gears[1].shaft, gears[1].position));
      const bool misses = apart >= 0.5 * (gears[0].face_width + gears[1].face_width);  // false where the shafts are not joined otherwise
      require(!misses, mesh_table(m) + ".position_2", gears[1].position,
              "one at which its faces meet: as the other meshes and joints have the shafts, mid faces lie " + in_mm(apart) + " apart");
    }
    constexpr double rounding = 0.1;  // [mm]: places come rounded
    for (std::size_t i = 0; i < unit_.joints.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const ShaftJoint &one = unit_.joints[j], &two = unit_.joints[i];
        if (one.shaft != two.shaft || one.outer_shaft != two.outer_shaft) continue;
        const double inner = two.bearing.position - one.bearing.position, outer = two.outer_position - one.outer_position;
        require(std::abs(inner - outer) <= rounding, "unit.joints." + std::to_string(i) + ".outer_position", two.outer_position,
                in_mm(one.outer_position + inner) + ", as far from unit.joints." + std::to_string(j) + " as on the inner shaft");
      }
    }
  }

  /// Gears in a loop turn at one speed each.
  void check_speeds() {
    const double ratio = static_cast<double>(pair_.data.pinion.teeth) / pair_.data.wheel.teeth;
    std::map<std::string, double> speeds{{name_of(Member::Pinion), 1.0}, {name_of(Member::Wheel), -ratio}};
    std::vector<bool> used(unit_.meshes.size(), false);
    const auto pass_on = [&] {
      bool found = false;
      for (std::size_t m = 0; m < unit_.meshes.size(); ++m) {
        const UnitMesh& mesh = unit_.meshes[m];
        const double per_first = -static_cast<double>(mesh.gears[0].teeth) / mesh.gears[1].teeth;
        const auto first = speeds.find(mesh.gears[0].shaft), second = speeds.find(mesh.gears[1].shaft);
        if (used[m] || (first == speeds.end() && second == speeds.end())) continue;
        used[m] = found = true;
        if (first == speeds.end()) {
          speeds[mesh.gears[0].shaft] = second->second / per_first;
        } else if (second == speeds.end()) {
          speeds[mesh.gears[1].shaft] = first->second * per_first;
        } else {
          constexpr double round_off = 1e-9;
          const double others = second->second / first->second;
          require(std::abs(others - per_first) <= round_off * std::abs(per_first), mesh_table(m) + ".teeth_2", mesh.gears[1].teeth,
                  "teeth with which the gears can turn: this mesh asks for a speed of " + in_words(per_first) +
                      " times that of gear 1, and the other meshes of the loop for " + in_words(others) + " times");
        }
      }
      return found;
    };
    do {
      while (pass_on()) continue;
      // Shafts that nothing joins to the pair's: the first of them at any speed.
      const auto rest = std::ranges::find(used, false);
      if (rest == used.end()) break;
      speeds[unit_.meshes[static_cast<std::size_t>(rest - used.begin())].gears[0].shaft] = 1.0;
    } while (true);
  }

  double along(const std::string& shaft, double position) const { return ends_[static_cast<std::size_t>(*shafts_.find(shaft))] + position; }

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
          const double distance = std::abs(along(body.shaft, body.position) - along(other.shaft, other.position));
          const double apart = (axes[index(body.shaft)] - axes[index(other.shaft)]).norm(), least = body.root_radius + other.root_radius;
          const bool meet = distance < 0.5 * std::max(body.width, other.width) && apart < least;  // false where either is not known
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
  std::vector<double> ends_;  ///< first_ends()
};

}  // namespace

std::vector<InvalidInput> find_place_problems(const ShaftsOfPair& shafts, const GearPair& pair) {
  Findings findings;
  std::vector<Place> taken;
  const PairData& data = pair.data;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const std::optional<ShaftData>& shaft = shafts.shaft[m];
    if (!shaft) continue;
    const Hand hand = m == Member::Pinion ? data.pinion_hand : opposite(data.pinion_hand);
    taken.push_back({name_of(m), name_of(m), shaft->gear_position, data[m].face_width, data[m].teeth, data.normal_module, data.pressure_angle,
                     data.helix_angle, hand});
  }
  for (std::size_t m = 0; m < shafts.unit.meshes.size(); ++m) {
    const UnitMesh& mesh = shafts.unit.meshes[m];
    for (std::size_t g = 0; g < 2; ++g) {
      const UnitGear& gear = mesh.gears[g];
      const Place place{mesh_table(m) + ", gear " + std::to_string(g + 1),
                        gear.shaft,
                        gear.position,
                        gear.face_width,
                        gear.teeth,
                        mesh.normal_module,
                        mesh.pressure_angle,
                        mesh.helix_angle,
                        g == 0 ? mesh.hand : opposite(mesh.hand)};
      for (const Place& other : taken) {
        if (place.overlaps(other)) require_same_teeth(place, other, m, g == 0 ? "_1" : "_2", findings);
      }
      taken.push_back(place);
    }
  }
  return findings.take();
}

std::vector<InvalidInput> find_layout_problems(const ShaftsOfPair& shafts, const GearPair& pair) { return Layout(shafts, pair).run(); }

}  // namespace flankwright
