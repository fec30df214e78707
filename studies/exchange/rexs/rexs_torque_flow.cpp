#include "studies/exchange/rexs/rexs_torque_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/rexs_stage.hpp"

namespace flankwright::studies::rexs {

TorqueFlow::TorqueFlow(const Condition& condition, const std::array<double, 3>& z) {
  read_meshes(condition.reading());
  read_shafts(condition, z);
  while (spread(&TorqueFlow::sizes_of) || spread(&TorqueFlow::signs_of)) {
  }
}

void TorqueFlow::read_meshes(Reading& reading) {
  for (const Relation& relation : reading.model().relations) {
    if (relation.type != "stage" || !relation.role("stage") || !relation.role("gear_1") || !relation.role("gear_2")) continue;
    Mesh& mesh = meshes_.emplace_back();
    mesh.stage = &reading.in_role(relation, "stage");
    std::array<double, 2> teeth{};
    for (std::size_t g = 0; g < 2; ++g) {
      const Component& gear = reading.in_role(relation, g == 0 ? "gear_1" : "gear_2");
      const auto shafts = reading.related(gear, {"shaft"});
      mesh.gears[g] = &gear;
      if (!shafts.empty()) mesh.shafts[g] = shafts.front();
      const auto number = reading.number(&gear, "number_of_teeth", Dimension::None);
      if (gear.type == "cylindrical_gear" && number) teeth[g] = number->value;
    }
    mesh.passes_torque = teeth[0] > 0.0 && teeth[1] > 0.0;
    if (mesh.passes_torque) mesh.ratio[1] = teeth[1] / teeth[0];
  }
}

void TorqueFlow::read_shafts(const Condition& condition, const std::array<double, 3>& z) {
  Reading& reading = condition.reading();
  for (const Component& component : reading.model().components) {
    if (component.type != "shaft") continue;
    Shaft& shaft = shafts_.emplace_back();
    shaft.component = &component;
    const double sense = runs_against(z, u_axis(reading, component)) ? -1.0 : 1.0;
    for (const Component* load : reading.related(component, {"external_load"})) {
      if (const auto torque = condition.torque_of(*load, component)) {
        shaft.loads.push_back({sense * torque->value, torque->source});
      } else if (condition.word(load, "transmits_torque") == "true") {
        shaft.has_open_load = true;
      }
    }
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      for (std::size_t g = 0; g < 2; ++g) {
        if (meshes_[m].shafts[g] == &component) shaft.places.push_back({m, g});
      }
    }
  }
}

GearTorque TorqueFlow::torque_at(const Place& place) const {
  const Mesh& mesh = meshes_[place.mesh];
  GearTorque torque = *mesh.first;
  if (torque.has_size) torque.torque *= mesh.ratio[place.gear];
  if (mesh.shafts[place.gear] != mesh.origin) torque.source += ", through " + Reading::name_of(*mesh.stage);
  return torque;
}

std::optional<GearTorque> TorqueFlow::left_for_gears(const Shaft& shaft) const {
  if (shaft.has_open_load) return std::nullopt;
  std::vector<GearTorque> terms;
  for (const Taken& load : shaft.loads) terms.push_back({load.value, true, load.source});
  for (const Place& place : shaft.places) {
    if (is_open(place)) continue;
    terms.push_back(torque_at(place));
    terms.back().torque *= -1.0;
  }
  if (terms.empty()) return std::nullopt;
  GearTorque left{.has_size = true};
  double largest = 0.0;
  bool rises = false, falls = false;
  for (const GearTorque& term : terms) {
    left.torque += term.torque;
    left.has_size = left.has_size && term.has_size;
    largest = std::max(largest, std::abs(term.torque));
    rises = rises || term.torque > 0.0;
    falls = falls || term.torque < 0.0;
  }
  left.source = terms.size() == 1 ? terms.front().source : "the balance of " + Reading::name_of(*shaft.component);
  if (left.has_size) {
    constexpr double round_off = 1e-9;  // |sum| at most this part of the largest term counts as 0
    if (std::abs(left.torque) <= round_off * largest) left.torque = 0.0;
    return left;
  }
  if (rises == falls) return std::nullopt;
  left.torque = rises ? 1.0 : -1.0;
  return left;
}

std::vector<TorqueFlow::Found> TorqueFlow::sizes_of(const Shaft& shaft) const {
  const auto is_open_place = [&](const Place& place) { return is_open(place); };
  if (std::ranges::count_if(shaft.places, is_open_place) != 1) return {};
  const auto open = std::ranges::find_if(shaft.places, is_open_place);
  const auto left = left_for_gears(shaft);
  if (!left || !left->has_size) return {};
  return {{*open, *left, shaft.component}};
}

std::vector<TorqueFlow::Found> TorqueFlow::signs_of(const Shaft& shaft) const {
  std::vector<Found> found;
  const auto left = left_for_gears(shaft);
  if (!left || left->torque == 0.0) return found;
  for (const Place& place : shaft.places) {
    if (is_open(place)) found.push_back({place, {left->torque > 0.0 ? 1.0 : -1.0, false, left->source}, shaft.component});
  }
  return found;
}

bool TorqueFlow::spread(std::vector<Found> (TorqueFlow::*found_on)(const Shaft&) const) {
  std::vector<Found> all;
  for (const Shaft& shaft : shafts_) {
    for (Found& found : (this->*found_on)(shaft)) {
      if (meshes_[found.at.mesh].passes_torque) all.push_back(std::move(found));
    }
  }
  bool is_new = false;
  for (Found& found : all) {
    Mesh& mesh = meshes_[found.at.mesh];
    if (mesh.first) continue;  // by another shaft
    if (found.torque.has_size) found.torque.torque /= mesh.ratio[found.at.gear];
    mesh.first = std::move(found.torque);
    mesh.origin = found.origin;
    is_new = true;
  }
  return is_new;
}

std::optional<GearTorque> TorqueFlow::on(const Component& gear, const Component& stage) const {
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    if (meshes_[m].stage != &stage || !meshes_[m].first) continue;
    for (std::size_t g = 0; g < 2; ++g) {
      if (meshes_[m].gears[g] == &gear) return torque_at({m, g});
    }
  }
  return std::nullopt;
}

std::vector<std::string> TorqueFlow::contradictions() const {
  std::vector<std::string> words;
  for (const Shaft& shaft : shafts_) {
    const bool is_known =
        !shaft.has_open_load && std::ranges::none_of(shaft.places, [&](const Place& place) { return is_open(place) || !torque_at(place).has_size; });
    const bool leaves_out_load = shaft.loads.empty() && shaft.places.size() < 2;  // as of a machine that is driven
    if (!is_known || leaves_out_load) continue;
    double of_loads = 0.0, of_gears = 0.0, largest = 0.0;
    for (const Taken& load : shaft.loads) {
      of_loads += load.value;
      largest = std::max(largest, std::abs(load.value));
    }
    for (const Place& place : shaft.places) {
      of_gears += torque_at(place).torque;
      largest = std::max(largest, std::abs(torque_at(place).torque));
    }
    if (std::abs(of_loads - of_gears) <= largest_loss * largest) continue;
    words.push_back(fmt::format(
        "external loads contradict each other: {} has {:.6g} N m from its loads, and its gears take {:.6g} N m by the loads of other shafts",
        Reading::name_of(*shaft.component), of_loads / units::newton_metre, of_gears / units::newton_metre));
  }
  return words;
}

}  // namespace flankwright::studies::rexs
