#include "studies/exchange/rexs/rexs_shaft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/rexs_condition.hpp"

namespace flankwright::studies::rexs {

namespace {

constexpr double same_place = 1e-6;        ///< sections join where the gap between them is at most this [mm]
constexpr double stiffest_bearing = 1e12;  ///< radial and axial stiffnesses from here on are rigid [N/mm]

class ShaftReading {
 public:
  ShaftReading(Reading& reading, const GearParts& parts) : reading_(reading), parts_(&parts), shaft_(*parts.shaft) {}
  /// For bare().
  ShaftReading(Reading& reading, const Component& shaft) : reading_(reading), parts_(nullptr), shaft_(shaft) {}

  BareShaft bare(bool against_z, std::vector<std::string>& notes) {
    if (reading_.related(shaft_, {"shaft_section"}).empty()) throw LeftOut{Reading::name_of(shaft_) + " has no shaft_section"};
    read_sections();
    read_bearings();
    read_material();
    if (against_z) {
      turn_round();
      for (BareJoint& joint : joints_) joint.held.position = end_ - start_ - joint.held.position;
    }
    std::ranges::sort(result_.data.bearings, {}, &ShaftBearing::position);
    notes.insert(notes.end(), notes_.begin(), notes_.end());
    return {std::move(result_.data), std::move(result_.remarks), std::move(joints_), start_, end_, against_z};
  }

  ImportedShaft read(double face_width) {
    check_gears();
    read_sections();
    read_bearings();
    read_positions();
    read_material();
    if (parts_->shaft_against_z) turn_round();
    std::ranges::sort(result_.data.bearings, {}, &ShaftBearing::position);
    // What a shaft lacks of its material is the gear's, and its first bearing holds axially where none is said to.
    ShaftData whole = result_.data;
    if (std::ranges::none_of(whole.bearings, [](const ShaftBearing& bearing) { return bearing.axial_stiffness > 0.0; })) {
      whole.bearings.front().axial_stiffness = std::numeric_limits<double>::infinity();
      note(shaft_, "no bearing has an axial_stiffness, the one of lowest z holds it");
    }
    if (std::isnan(whole.material.youngs_modulus)) whole.material.youngs_modulus = Material{}.youngs_modulus;
    if (std::isnan(whole.material.poissons_ratio)) whole.material.poissons_ratio = Material{}.poissons_ratio;
    const std::vector<InvalidInput> problems = find_problems(whole, face_width);
    if (!problems.empty())
      throw LeftOut{fmt::format("{} = {}: allowed is {}", problems.front().field(), problems.front().value(), problems.front().allowed())};
    for (const std::string& note : notes_) reading_.warn(note);
    return std::move(result_);
  }

 private:
  void note(const Component& c, const std::string& what) { notes_.push_back(Reading::name_of(c) + ": " + what); }

  std::optional<double> number(const Component& c, std::string_view id, Dimension dimension) {
    const auto taken = reading_.number(&c, id, dimension);
    return taken ? std::optional(taken->value) : std::nullopt;
  }
  double required(const Component& c, std::initializer_list<std::string_view> ids) {
    const auto taken = reading_.first_of(&c, ids, Dimension::Length);
    if (!taken) throw LeftOut{fmt::format("{} has no {}", Reading::name_of(c), *ids.begin())};
    return taken->value;
  }

  void check_gears() const {
    int gears = 0;
    for (const Relation& relation : reading_.model().relations) {
      const auto part = relation.role("assembly") == shaft_.id ? relation.role("part") : std::nullopt;
      const Component* component = part ? reading_.model().find(*part) : nullptr;
      gears += component != nullptr && (component->type.ends_with("_gear") || component->type.ends_with("_wheel")) ? 1 : 0;
    }
    if (gears > 1) throw LeftOut{fmt::format("it carries {} gears, and a study knows the load of one", gears)};
    const std::ptrdiff_t meshes = meshes_of(reading_, *parts_->gear);
    if (meshes > 1) throw LeftOut{fmt::format("its gear has {} meshes, and a study knows the load of one", meshes)};
  }

  /// The mean of what the section has at both ends.
  double diameter(const Component& section, const std::string& id, double fallback) {
    const auto begin = number(section, id + "_begin", Dimension::Length), end = number(section, id + "_end", Dimension::Length);
    const double one = begin.value_or(end.value_or(fallback)), two = end.value_or(one);
    if (one < 0.0 || two < 0.0) throw LeftOut{full_name(section) + " has an " + id + " below 0"};
    if (one != two)
      note(section, fmt::format("its cone is taken as a cylinder of the mean {}", id == "outer_diameter" ? "outer diameter" : "inner diameter"));
    return 0.5 * (one + two);
  }

  void read_sections() {
    std::vector<std::pair<double, const Component*>> along;
    for (const Component* section : reading_.related(shaft_, {"shaft_section"}))
      along.emplace_back(required(*section, {"u_coordinate_on_shaft"}), section);
    std::ranges::stable_sort(along, {}, &std::pair<double, const Component*>::first);
    start_ = end_ = along.front().first;
    for (const auto& [from, section] : along) {
      if (std::abs(from - end_) > same_place)
        throw LeftOut{fmt::format("{} does not begin where the one before it ends", Reading::name_of(*section))};
      const double length = required(*section, {"length"});
      result_.data.sections.push_back({length, diameter(*section, "outer_diameter", 0.0), diameter(*section, "inner_diameter", 0.0)});
      end_ = from + length;
      remark("sections", *section);
    }
  }

  void read_bearings() {
    for (const Relation& relation : reading_.model().relations) {
      const auto inner = relation.role("inner_part"), outer = relation.role("outer_part"), assembly = relation.role("assembly");
      const bool is_inner = inner == shaft_.id;
      const Component* bearing = assembly ? reading_.model().find(*assembly) : nullptr;
      if (bearing == nullptr || bearing->type.find("bearing") == std::string::npos || (!is_inner && outer != shaft_.id)) continue;
      const Component* mate = is_inner ? (outer ? reading_.model().find(*outer) : nullptr) : inner ? reading_.model().find(*inner) : nullptr;
      const bool joins = mate != nullptr && mate->type == "shaft";
      if (joins && parts_ != nullptr) throw LeftOut{fmt::format("its {} sits on {}", Reading::name_of(*bearing), Reading::name_of(*mate))};
      const std::string remarked = result_.remarks["bearings"];
      read_bearing(*bearing, is_inner ? "u_coordinate_on_shaft_inner_side" : "u_coordinate_on_shaft_outer_side");
      if (!joins) continue;
      joints_.push_back({bearing, mate, is_inner, result_.data.bearings.back()});
      result_.data.bearings.pop_back();
      result_.remarks["bearings"] = remarked;
    }
    if (result_.data.bearings.empty() && joints_.empty()) throw LeftOut{"it has no bearings"};
  }

  void read_bearing(const Component& bearing, std::string_view side) {
    ShaftBearing held{.position = required(bearing, {side, "u_coordinate_on_shaft"}) - start_};
    const auto finite = [](double stiffness) { return stiffness < stiffest_bearing ? stiffness : std::numeric_limits<double>::infinity(); };
    const auto radial = number(bearing, "radial_stiffness", Dimension::Stiffness), axial = number(bearing, "axial_stiffness", Dimension::Stiffness);
    if (reading_.word(&bearing, "radial_force_absorption") == "false") throw LeftOut{Reading::name_of(bearing) + " does not hold it radially"};
    const auto tilting = number(bearing, "bending_stiffness", Dimension::TiltingStiffness);
    for (const auto& [stiffness, attribute] :
         {std::pair{radial, "radial_stiffness"}, std::pair{axial, "axial_stiffness"}, std::pair{tilting, "bending_stiffness"}}) {
      if (stiffness && *stiffness < 0.0) throw LeftOut{Reading::name_of(bearing) + " has a " + attribute + " below 0"};
    }
    if (radial && *radial > 0.0) {
      held.radial_stiffness = finite(*radial);
    } else {
      note(bearing, "without radial_stiffness, taken as rigid");
    }
    if (axial) held.axial_stiffness = finite(*axial);
    take_absorption(bearing, held);
    held.tilting_stiffness = tilting.value_or(0.0);
    result_.data.bearings.push_back(held);
    remark("bearings", bearing);
  }

  /// A study's bearing holds axial forces of both directions, or none.
  void take_absorption(const Component& bearing, ShaftBearing& held) {
    const Attribute* absorption = bearing.find("axial_force_absorption");
    if (absorption == nullptr) return;
    if (absorption->text == "both_directions") {
      reading_.word(&bearing, absorption->id);
      if (!(held.axial_stiffness > 0.0)) held.axial_stiffness = std::numeric_limits<double>::infinity();
    } else if (absorption->text == "no_direction") {
      reading_.word(&bearing, absorption->id);
      if (held.axial_stiffness > 0.0) note(bearing, "axial_stiffness is not taken, as no axial force is supported");
      held.axial_stiffness = 0.0;
    } else {
      note(bearing,
           fmt::format("axial_force_absorption = \"{}\" is not taken, a bearing supports axial forces of both directions or none", absorption->text));
    }
  }

  void read_positions() {
    result_.data.gear_position = required(*parts_->gear, {"u_coordinate_on_shaft"}) - start_;
    remark("gear_position", *parts_->gear);
    result_.remarks["gear_position"] += " u_coordinate_on_shaft, taken as mid face";
    std::vector<const Component*> carrying;
    for (const Component* load : reading_.related(shaft_, {"external_load"})) {
      if (carries_torque(reading_, *load, shaft_)) carrying.push_back(load);
    }
    if (carrying.size() != 1) throw LeftOut{carrying.empty() ? "nothing says where its torque enters" : "its torque enters at several places"};
    result_.data.torque_position = required(*carrying.front(), {"u_coordinate_on_shaft"}) - start_;
    remark("torque_position", *carrying.front());
  }

  void read_material() {
    const auto materials = reading_.related(shaft_, {"material"});
    result_.data.material = {not_given, not_given};
    if (materials.empty()) return;
    if (const auto modulus = number(*materials.front(), "elastic_modulus", Dimension::Stress)) result_.data.material.youngs_modulus = *modulus;
    if (const auto poisson = number(*materials.front(), "poisson_ratio", Dimension::None)) result_.data.material.poissons_ratio = *poisson;
    remark("material", *materials.front());
  }

  /// Positions from the other end, where the shaft's axis runs against z.
  void turn_round() {
    ShaftData& data = result_.data;
    const double length = end_ - start_;
    std::ranges::reverse(data.sections);
    for (ShaftBearing& bearing : data.bearings) bearing.position = length - bearing.position;
    data.gear_position = length - data.gear_position;
    data.torque_position = length - data.torque_position;
  }

  void remark(const std::string& key, const Component& c) {
    std::string& text = result_.remarks[key];
    text += (text.empty() ? "" : ", ") + Reading::name_of(c);
  }

  Reading& reading_;
  const GearParts* parts_;  ///< null: of a unit
  const Component& shaft_;
  std::vector<BareJoint> joints_;
  double start_{0.0}, end_{0.0};  ///< u coordinates of its ends [mm]
  std::vector<std::string> notes_;
  ImportedShaft result_;
};

}  // namespace

BareShaft read_bare_shaft(Reading& reading, const Component& shaft, bool against_z, std::vector<std::string>& notes) {
  return ShaftReading(reading, shaft).bare(against_z, notes);
}

std::optional<ImportedShaft> read_shaft(Reading& reading, const GearParts& parts, double face_width) {
  if (parts.shaft == nullptr || reading.related(*parts.shaft, {"shaft_section"}).empty()) return std::nullopt;
  try {
    return ShaftReading(reading, parts).read(face_width);
  } catch (const LeftOut& left_out) {
    reading.leave_out(*parts.shaft, left_out.why);
    return std::nullopt;
  }
}

std::string sections_text(const ShaftData& shaft) {
  std::vector<std::string> sections;
  for (const ShaftSection& section : shaft.sections) {
    const std::string bore = section.inner_diameter > 0.0 ? ", inner_diameter = " + difference_text(section.inner_diameter) : "";
    sections.push_back(
        fmt::format("{{ length = {}, outer_diameter = {}{} }}", difference_text(section.length), difference_text(section.outer_diameter), bore));
  }
  return fmt::format("[{}]", fmt::join(sections, ", "));
}

std::string stiffness_text(const ShaftBearing& bearing) {
  std::string line;
  constexpr double newton_per_um = 1e3;  // [N/mm]
  if (std::isfinite(bearing.radial_stiffness)) line += ", radial_stiffness = " + number_text(bearing.radial_stiffness / newton_per_um);
  if (bearing.axial_stiffness > 0.0)
    line += ", axial_stiffness = " + number_text(std::min(bearing.axial_stiffness, stiffest_bearing) / newton_per_um);
  if (bearing.tilting_stiffness > 0.0) line += ", tilting_stiffness = " + number_text(bearing.tilting_stiffness / units::newton_metre);
  return line;
}

std::string bearings_text(const ShaftData& shaft) {
  std::vector<std::string> bearings;
  for (const ShaftBearing& bearing : shaft.bearings) {
    bearings.push_back("{ position = " + difference_text(bearing.position) + stiffness_text(bearing) + " }");
  }
  return fmt::format("[{}]", fmt::join(bearings, ", "));
}

void write_shaft(const ImportedShaft& shaft, Member member, StudyText& text) {
  const ShaftData& data = shaft.data;
  const auto remark = [&](const std::string& key) { return shaft.remarks.contains(key) ? shaft.remarks.at(key) : std::string(); };
  text.table(std::string(name_of(member)) + ".shaft");
  text.key("sections", sections_text(data), remark("sections"));
  if (!data.bearings.empty()) text.key("bearings", bearings_text(data), remark("bearings"));
  text.key("gear_position", difference_text(data.gear_position), remark("gear_position"));
  if (!std::isnan(data.torque_position)) text.key("torque_position", difference_text(data.torque_position), remark("torque_position"));
  if (!std::isnan(data.material.youngs_modulus)) text.key("material.youngs_modulus", number_text(data.material.youngs_modulus), remark("material"));
  if (!std::isnan(data.material.poissons_ratio)) text.key("material.poissons_ratio", number_text(data.material.poissons_ratio), remark("material"));
}

}  // namespace flankwright::studies::rexs
