#include "studies/exchange/rexs/rexs_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

namespace {

/// Torque on a gear about its shaft, by its size only.
struct GearTorque {
  double torque;
  std::string source;
};

/// One condition: the model with what a load case changes.
class Condition {
 public:
  Condition(Reading& reading, const LoadCase* load_case) : reading_(reading), load_case_(load_case) {}

  std::optional<ImportedTorque> torque_on_pinion(const StageParts& parts) {
    // Of the stage's own data; a gear of several stages says here what it takes in this one.
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      const auto torque = number(parts[m].data, "torque", Dimension::Torque);
      if (torque && torque->value != 0.0) return on_pinion(parts, m, {std::abs(torque->value), torque->source});
    }
    spread();
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (const auto known = gears_.find(parts[m].gear->id); known != gears_.end()) return on_pinion(parts, m, known->second);
    }
    return std::nullopt;
  }

 private:
  static ImportedTorque on_pinion(const StageParts& parts, Member m, const GearTorque& torque) {
    const double share = m == Member::Pinion ? 1.0 : static_cast<double>(parts.teeth[0]) / parts.teeth[1];
    return {.torque = torque.torque * share, .source = torque.source + (m == Member::Pinion ? "" : ", through the teeth")};
  }

  /// Of the load case, else of the model.
  std::optional<Taken> number(const Component* component, std::string_view id, Dimension dimension) {
    if (component == nullptr) return std::nullopt;
    if (load_case_ != nullptr) {
      for (const Component& varied : load_case_->components) {
        if (varied.id != component->id) continue;
        if (auto taken = reading_.number(&varied, id, dimension)) {
          taken->source = Reading::name_of(*component) + " " + std::string(id);
          return taken;
        }
      }
    }
    return reading_.number(component, id, dimension);
  }

  std::optional<Taken> torque_of(const Component& load, const Component& shaft) {
    if (auto torque = number(&load, "torque_around_u_axis", Dimension::Torque); torque && torque->value != 0.0) return torque;
    const auto power = number(&load, "power", Dimension::Power), speed = number(&shaft, "rotational_speed", Dimension::Speed);
    if (!power || !speed || power->value == 0.0 || speed->value == 0.0) return std::nullopt;
    constexpr double newton_mm_per_kw = 1e6 * 30.0 / units::pi;  // at 1/min
    return Taken{newton_mm_per_kw * power->value / speed->value, power->source + " at the speed of " + Reading::name_of(shaft)};
  }

  /// A gear of several meshes, such as a sun: files do not give the torque of each mesh.
  bool shares_torque(const Component& gear) const {
    return std::ranges::count_if(reading_.model().relations, [&](const Relation& relation) {
             return relation.type == "stage" && (relation.role("gear_1") == gear.id || relation.role("gear_2") == gear.id);
           }) > 1;
  }

  /// A shaft that carries loads and gears, of whose torques one is unknown: either its gear's, or that of an output.
  void spread_over(const Component& shaft) {
    std::optional<Taken> load;
    int loads = 0, silent_loads = 0;
    for (const Component* external : reading_.related(shaft, {"external_load"})) {
      if (const auto torque = torque_of(*external, shaft)) {
        load = torque;
        ++loads;
      } else if (reading_.word(external, "transmits_torque") == "true") {
        ++silent_loads;
      }
    }
    std::vector<const Component*> unknown, known;
    for (const Component* gear : reading_.related(shaft, {"cylindrical_gear"})) (gears_.contains(gear->id) ? known : unknown).push_back(gear);
    if (unknown.size() != 1 || silent_loads > 0 || shares_torque(*unknown.front())) return;
    // Two torques on a shaft balance each other whatever their signs; of three the signs would have to be known.
    if (loads == 1 && known.empty()) gears_[unknown.front()->id] = {std::abs(load->value), load->source};
    if (loads == 0 && known.size() == 1) gears_[unknown.front()->id] = gears_.at(known.front()->id);
  }

  void spread_over(const Relation& stage) {
    const Component &one = reading_.in_role(stage, "gear_1"), &two = reading_.in_role(stage, "gear_2");
    if (shares_torque(one) || shares_torque(two)) return;
    const auto teeth = [&](const Component& gear) { return number(&gear, "number_of_teeth", Dimension::None); };
    for (const auto& [from, to] : {std::pair{&one, &two}, std::pair{&two, &one}}) {
      if (!gears_.contains(from->id) || gears_.contains(to->id)) continue;
      const auto here = teeth(*from), there = teeth(*to);
      if (!here || !there || here->value == 0.0) continue;
      const GearTorque& torque = gears_.at(from->id);
      gears_[to->id] = {std::abs(torque.torque * there->value / here->value),
                        torque.source + ", through " + Reading::name_of(reading_.in_role(stage, "stage"))};
    }
  }

  /// From shaft to gear to mate to shaft, until nothing more becomes known.
  void spread() {
    for (std::size_t before = gears_.size() + 1; before != gears_.size();) {
      before = gears_.size();
      for (const Component& component : reading_.model().components) {
        if (component.type == "shaft") spread_over(component);
      }
      for (const Relation& relation : reading_.model().relations) {
        if (relation.type == "stage" && relation.role("gear_1") && relation.role("gear_2")) spread_over(relation);
      }
    }
  }

  Reading& reading_;
  const LoadCase* load_case_;
  std::map<int, GearTorque> gears_;
};

}  // namespace

std::vector<ImportedTorque> read_torques(Reading& reading, const StageParts& parts) {
  std::vector<ImportedTorque> torques;
  for (const LoadCase& load_case : reading.model().load_cases) {
    auto torque = Condition(reading, &load_case).torque_on_pinion(parts);
    if (!torque) continue;
    torque->name = fmt::format("load case {}", load_case.id);
    for (const Component& varied : load_case.components) {
      const Component* component = reading.model().find(varied.id);
      if (component == nullptr || component->type != "gear_unit") continue;
      // Per cent is the standard's unit: a bare number is one too.
      if (const auto share = reading.number(&varied, "operating_time_fraction", Dimension::None)) torque->time_share = share->value;
    }
    torques.push_back(std::move(*torque));
  }
  if (!torques.empty()) return torques;
  if (auto torque = Condition(reading, nullptr).torque_on_pinion(parts)) torques.push_back(std::move(*torque));
  return torques;
}

}  // namespace flankwright::studies::rexs
