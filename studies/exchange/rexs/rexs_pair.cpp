#include "studies/exchange/rexs/rexs_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gear/gear_pair.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright::studies::rexs {

namespace {

constexpr double deburred_edge = 0.05;  ///< radius of a chamfer's edge that the format does not have, in normal modules

class PairReading {
 public:
  PairReading(Reading& reading, const StageParts& parts) : reading_(reading), parts_(parts) {}

  ImportedPair read() {
    take_mesh(read_mesh(reading_, parts_));
    read_stage();
    for (const Member m : {Member::Pinion, Member::Wheel}) read_gear(m);
    return std::move(pair_);
  }

 private:
  const Component& gear(Member m) const { return *parts_[m].gear; }
  GearData& data(Member m) { return pair_.data[m]; }
  static std::string prefix(Member m) { return m == Member::Pinion ? "pinion." : "wheel."; }
  void remark(const std::string& key, const std::string& text) { pair_.remarks[key] = text; }
  std::optional<Taken> number(const Component* component, std::string_view id, Dimension dimension = Dimension::None) {
    return reading_.number(component, id, dimension);
  }

  Taken required(const Component& component, std::string_view id, Dimension dimension) {
    const auto taken = reading_.number(&component, id, dimension);
    if (!taken) reading_.refuse_attribute(component, id, "not given", "a number: a study needs it");
    return *taken;
  }

  void take_mesh(const ImportedMesh& mesh) {
    PairData& data = pair_.data;
    data.normal_module = mesh.normal_module;
    data.pressure_angle = mesh.pressure_angle;
    data.helix_angle = mesh.helix_angle;
    data.pinion_hand = mesh.pinion_hand;
    data.centre_distance = mesh.centre_distance;
    for (const auto& [name, source] : mesh.remarks) remark(name == "pinion_hand" ? "pinion.hand" : "pair." + name, source);
  }

  void read_stage() {
    const auto drives = [&](Member m) {
      const std::string word = reading_.word(parts_[m].data, "is_driving_gear");
      return word == "true" || word == "True" || word == "1";
    };
    const bool pinion = drives(Member::Pinion), wheel = drives(Member::Wheel);
    pair_.data.driver = wheel && !pinion ? Member::Wheel : Member::Pinion;
    remark("pair.driver",
           pinion != wheel ? Reading::name_of(*(pinion ? parts_.gears[0] : parts_.gears[1]).data) + " is_driving_gear" : "not in the file");
    pair_.data.working_flank = parts_.working_flank;
    remark("pair.working_flank", parts_.flank_source);
  }

  void read_gear(Member m) {
    data(m).teeth = parts_.teeth[m == Member::Pinion ? 0 : 1];
    remark(prefix(m) + "teeth", Reading::name_of(gear(m)) + " number_of_teeth");
    const Taken width = required(gear(m), "face_width", Dimension::Length);
    data(m).face_width = width.value;
    remark(prefix(m) + "face_width", width.source);
    read_profile_shift(m);
    read_tooth_thickness_allowance(m);
    read_tip_diameter(m);
    read_rack(m);
    read_tip_chamfer(m);
    // As a study that says nothing of its edges has them.
    if (!(data(m).tip_chamfer.amount > 0.0)) data(m).tip_rounding = usual_edge_radius(m, pair_.data);
    read_end_chamfer(m);
    read_tip_form_diameter(m);
  }

  void read_profile_shift(Member m) {
    const Component* flank = parts_[m].flank;
    const std::string key = prefix(m) + "profile_shift";
    const double module = pair_.data.normal_module;
    if (auto x = number(flank, "addendum_modification_coefficient")) {
      data(m).profile_shift = x->value;
      remark(key, x->source);
    } else if (auto length = number(flank, "addendum_modification", Dimension::Length)) {
      data(m).profile_shift = length->value / module;
      remark(key, length->source + " in modules");
    } else {
      remark(key, "not in the file");
    }
  }

  /// The format has the profile shift that the tool of the last step leaves.
  void read_tooth_thickness_allowance(Member m) {
    const auto generating = number(parts_[m].settings, "generated_addendum_modification_coefficient");
    if (!generating || agree(generating->value, data(m).profile_shift)) return;
    const auto stock = number(parts_[m].settings, "machining_allowance", Dimension::Length);
    if (stock && stock->value != 0.0) {
      reading_.warn(fmt::format("{} leaves a machining allowance: not taken for the finished tooth", generating->source));
      return;
    }
    const double allowance = (generating->value - data(m).profile_shift) * 2.0 * pair_.data.normal_module * std::tan(pair_.data.pressure_angle);
    if (allowance < 0.0) {
      data(m).tooth_thickness_allowance = std::round(allowance * 1e9) * 1e-9;  // a difference of coefficients
      remark(prefix(m) + "tooth_thickness_allowance", "from " + generating->source);
    } else {
      reading_.warn(fmt::format("{} = {} is more than the profile shift: not taken", generating->source, number_text(generating->value)));
    }
  }

  void read_tip_diameter(Member m) {
    const auto tip = number(&gear(m), "tip_diameter", Dimension::Length);
    if (!tip) return;
    const double module = pair_.data.normal_module;
    const double reference = data(m).teeth * module / std::cos(pair_.data.helix_angle);
    // A tip below the reference circle less a module's dedendum, or three modules above what profile shift asks for, is a placeholder.
    const double lowest = reference - 2.0 * module, highest = reference + 2.0 * (3.0 + std::max(0.0, data(m).profile_shift)) * module;
    if (tip->value > lowest && tip->value < highest) {
      data(m).tip_diameter = tip->value;
      remark(prefix(m) + "tip_diameter", tip->source);
    } else {
      reading_.warn(fmt::format("{} = {} mm cannot be that of a gear with reference diameter {} mm: not taken, it follows from the rack", tip->source,
                                number_text(tip->value), difference_text(reference)));
    }
  }

  /// The format has the amount alone: its angle is the usual one, its edge that of a deburred one.
  void read_tip_chamfer(Member m) {
    const auto amount = number(parts_[m].flank, "tooth_tip_chamfer", Dimension::Length);
    if (!amount || !(amount->value > 0.0)) return;
    PairData with = pair_.data;
    with[m].tip_chamfer = {.amount = amount->value, .radius = deburred_edge * with.normal_module};
    if (!has_room_for_tip_chamfer(m, with)) {
      reading_.warn(fmt::format("{} = {} mm leaves no tip at 45 deg: not taken", amount->source, number_text(amount->value)));
      return;
    }
    data(m).tip_chamfer = with[m].tip_chamfer;
    remark(prefix(m) + "edges.tip_chamfer.amount", amount->source);
    remark(prefix(m) + "edges.tip_chamfer", amount->source + "; angle and edge radius are not in the file: 45 deg, 0.05 modules");
  }

  /// As the tip's, the format has the amount alone. Without one the ends are those of a study that says nothing.
  void read_end_chamfer(Member m) {
    data(m).end_rounding = usual_edge_radius(m, pair_.data);
    const auto amount = number(&gear(m), "chamfer_at_tooth_end", Dimension::Length);
    if (!amount || !(amount->value > 0.0)) return;
    // The arc of the chamfer's edge takes less than its radius: there the flank turns by less than 90 deg.
    if (!(2.0 * (amount->value + data(m).end_rounding) < data(m).face_width)) {
      reading_.warn(fmt::format("{} = {} mm at both ends leaves nothing of a face width of {} mm: not taken", amount->source,
                                number_text(amount->value), number_text(data(m).face_width)));
      return;
    }
    data(m).end_chamfer = {.amount = amount->value, .radius = data(m).end_rounding};
    data(m).end_rounding = 0.0;
    remark(prefix(m) + "edges.end_chamfer", amount->source + "; angle and edge radius are not in the file: 45 deg and the usual one");
  }

  /// Where the flank ends below the tip or below the chamfer an edge begins, whose radius follows.
  void read_tip_form_diameter(Member m) {
    const auto form = number(&gear(m), "tip_form_diameter", Dimension::Length);
    if (!form) return;
    GearData& data = this->data(m);
    const bool is_chamfered = data.tip_chamfer.amount > 0.0;
    const double module = pair_.data.normal_module, reference = data.teeth * module / std::cos(pair_.data.helix_angle);
    const double tip = std::isnan(data.tip_diameter) ? reference + 2.0 * (data.rack.addendum + data.profile_shift) * module : data.tip_diameter;
    const double end = tip - 2.0 * data.tip_chamfer.amount;
    if (form->value >= end || agree(form->value, end)) {  // the flank's sharp end
      (is_chamfered ? data.tip_chamfer.radius : data.tip_rounding) = 0.0;
      remark(prefix(m) + (is_chamfered ? "edges.tip_chamfer" : "edges.tip_rounding"), "sharp, as " + form->source + " says");
      return;
    }
    const auto radius = form->value > reference ? edge_radius_for(m, pair_.data, 0.5 * form->value) : std::nullopt;
    if (!radius) {
      reading_.warn(fmt::format("{} = {} mm is no end of a flank whose tip has a diameter of {} mm: not taken", form->source,
                                number_text(form->value), number_text(tip)));
      return;
    }
    if (is_chamfered) {
      data.tip_chamfer.radius = *radius;
      remark(prefix(m) + "edges.tip_chamfer",
             pair_.remarks[prefix(m) + "edges.tip_chamfer.amount"] + "; the angle is not in the file: 45 deg; edge radius: from " + form->source);
    } else {
      data.tip_rounding = *radius;
      remark(prefix(m) + "edges.tip_rounding", "the rounding with which the flank ends at " + form->source);
    }
  }

  /// A coefficient, or a length in modules; moved to `value` with its remark.
  bool read_coefficient(const Component* component, std::initializer_list<std::string_view> coefficients, std::string_view length, double& value,
                        const std::string& key) {
    if (const auto taken = reading_.first_of(component, coefficients, Dimension::None)) {
      value = taken->value;
      remark(key, taken->source);
      return true;
    }
    if (const auto taken = number(component, length, Dimension::Length)) {
      value = taken->value / pair_.data.normal_module;
      remark(key, taken->source + " in modules");
      return true;
    }
    return false;
  }

  void read_rack(Member m) {
    RackProfile& rack = data(m).rack;
    const GearParts& parts = parts_[m];
    const std::string key = prefix(m) + "rack.";
    if (!read_coefficient(parts.flank, {"addendum_coefficient_basic_profile"}, "", rack.addendum, key + "addendum")) {
      remark(key + "addendum", "not in the file");
    }
    // The tool's addendum cuts the gear's dedendum.
    if (!read_coefficient(parts.tool, {"addendum_coefficient_reference_profile"}, "addendum_reference_profile", rack.dedendum, key + "dedendum")) {
      read_dedendum(m);
    }
    if (!read_coefficient(parts.tool, {"tip_corner_radius_factor_reference_profile", "tip_radius_factor"}, "tip_corner_radius_reference_profile",
                          rack.root_radius, key + "root_radius")) {
      remark(key + "root_radius", "not in the file");
    }
    const double most = full_tip_rounding(rack.dedendum, pair_.data.pressure_angle);
    if (rack.root_radius > most && most > 0.0) {
      const bool given = pair_.remarks[key + "root_radius"] != "not in the file";
      // Rounded down: digits must not carry it over the limit.
      rack.root_radius = std::floor(most * 1e6) * 1e-6;
      const std::string words = pair_.remarks[key + "root_radius"] + ": the full rounding of the tool's tip";
      remark(key + "root_radius", words);
      if (given) reading_.warn(words + ", which is less than the file has, is taken for " + key + "root_radius");
    }
    for (const auto& amount : {number(parts.tool, "protuberance_amount", Dimension::Length), number(parts.tool, "protuberance_amount_factor")}) {
      if (amount && amount->value != 0.0) reading_.warn(amount->source + ": protuberance is not modelled, not taken");
    }
  }

  /// Without a tool the root diameter gives the dedendum.
  void read_dedendum(Member m) {
    RackProfile& rack = data(m).rack;
    const std::string key = prefix(m) + "rack.dedendum";
    remark(key, "not in the file");
    const auto root = number(&gear(m), "root_diameter", Dimension::Length);
    if (!root) return;
    const double reference = data(m).teeth * pair_.data.normal_module / std::cos(pair_.data.helix_angle);
    const double dedendum = generating_profile_shift(data(m), pair_.data.normal_module, pair_.data.pressure_angle) +
                            (reference - root->value) / (2.0 * pair_.data.normal_module);
    if (dedendum > 0.5 && dedendum < 2.5) {
      rack.dedendum = std::round(dedendum * 1e9) * 1e-9;
      remark(key, "from " + root->source);
    } else {
      reading_.warn(fmt::format("{} = {} mm is no root of this gear: not taken", root->source, number_text(root->value)));
    }
  }

  Reading& reading_;
  const StageParts& parts_;
  ImportedPair pair_;
};

void write_gear(const ImportedPair& pair, Member m, StudyText& text) {
  const GearData& gear = pair.data[m];
  const std::string name = name_of(m);
  const auto remark = [&](const std::string& key) {
    const auto found = pair.remarks.find(name + "." + key);
    return found == pair.remarks.end() ? std::string() : found->second;
  };
  text.table(name);
  text.key("teeth", std::to_string(gear.teeth), remark("teeth"));
  text.key("face_width", number_text(gear.face_width), remark("face_width"));
  if (m == Member::Pinion) text.key("hand", pair.data.pinion_hand == Hand::Right ? "\"right\"" : "\"left\"", remark("hand"));
  text.key("profile_shift", number_text(gear.profile_shift), remark("profile_shift"));
  if (gear.tooth_thickness_allowance != 0.0) {
    text.key("tooth_thickness_allowance", number_text(gear.tooth_thickness_allowance / units::um), remark("tooth_thickness_allowance"));
  }
  if (!std::isnan(gear.tip_diameter)) text.key("tip_diameter", number_text(gear.tip_diameter), remark("tip_diameter"));
  if (!remark("edges.tip_rounding").empty()) text.key("edges.tip_rounding", number_text(gear.tip_rounding), remark("edges.tip_rounding"));
  for (const auto& [key, chamfer] : {std::pair{"edges.tip_chamfer", gear.tip_chamfer}, std::pair{"edges.end_chamfer", gear.end_chamfer}}) {
    if (!(chamfer.amount > 0.0)) continue;
    text.key(key,
             fmt::format("{{ amount = {}, angle = {}, radius = {} }}", number_text(chamfer.amount), number_text(chamfer.angle / units::deg),
                         number_text(chamfer.radius)),
             remark(key));
  }
  text.key("rack.addendum", number_text(gear.rack.addendum), remark("rack.addendum"));
  text.key("rack.dedendum", number_text(gear.rack.dedendum), remark("rack.dedendum"));
  text.key("rack.root_radius", number_text(gear.rack.root_radius), remark("rack.root_radius"));
}

}  // namespace

ImportedPair read_pair(Reading& reading, const StageParts& parts) { return PairReading(reading, parts).read(); }

void write_pair(const ImportedPair& pair, StudyText& text) {
  const PairData& data = pair.data;
  const auto remark = [&](const std::string& key) {
    const auto found = pair.remarks.find("pair." + key);
    return found == pair.remarks.end() ? std::string() : found->second;
  };
  text.table("pair");
  text.key("normal_module", number_text(data.normal_module), remark("normal_module"));
  text.key("pressure_angle", number_text(data.pressure_angle / units::deg), remark("pressure_angle"));
  text.key("helix_angle", number_text(data.helix_angle / units::deg), remark("helix_angle"));
  if (!std::isnan(data.centre_distance)) text.key("centre_distance", number_text(data.centre_distance), remark("centre_distance"));
  text.key("driver", data.driver == Member::Pinion ? "\"pinion\"" : "\"wheel\"", remark("driver"));
  text.key("working_flank", data.working_flank == WorkingFlank::Right ? "\"right\"" : "\"left\"", remark("working_flank"));
  write_gear(pair, Member::Pinion, text);
  write_gear(pair, Member::Wheel, text);
}

}  // namespace flankwright::studies::rexs
