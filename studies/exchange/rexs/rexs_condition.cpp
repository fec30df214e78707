#include "studies/exchange/rexs/rexs_condition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

std::string Condition::name() const { return load_case_ == nullptr ? std::string() : fmt::format("load case {}", load_case_->id); }

const Component* Condition::varied(const Component& component) const {
  if (load_case_ == nullptr) return nullptr;
  const auto found = std::ranges::find(load_case_->components, component.id, &Component::id);
  return found == load_case_->components.end() ? nullptr : &*found;
}

std::optional<Taken> Condition::number(const Component* component, std::string_view attribute, Dimension dimension) const {
  if (component == nullptr) return std::nullopt;
  if (auto taken = reading_->number(varied(*component), attribute, dimension)) {
    taken->source = Reading::name_of(*component) + " " + std::string(attribute);
    return taken;
  }
  return reading_->number(component, attribute, dimension);
}

std::string Condition::word_of_case(const Component* component, std::string_view attribute) const {
  return component == nullptr ? std::string() : reading_->word(varied(*component), attribute);
}

std::string Condition::word(const Component* component, std::string_view attribute) const {
  const std::string own = word_of_case(component, attribute);
  return own.empty() ? reading_->word(component, attribute) : own;
}

bool Condition::changes(const Component& component, std::string_view attribute) const {
  const Component* own = varied(component);
  return own != nullptr && std::ranges::find(own->attributes, attribute, &Attribute::id) != own->attributes.end();
}

bool Condition::changes_loads() const {
  return load_case_ != nullptr && std::ranges::any_of(load_case_->components, [this](const Component& own) {
           const Component* component = reading_->model().find(own.id);
           return component != nullptr && component->type == "external_load";
         });
}

std::optional<Taken> Condition::torque_of(const Component& load, const Component& shaft) const {
  for (const Component* stated : {varied(load), &load}) {
    const auto torque = reading_->number(stated, "torque_around_u_axis", Dimension::Torque);
    if (torque && torque->value != 0.0) return Taken{torque->value, Reading::name_of(load) + " torque_around_u_axis"};
    const auto power = reading_->number(stated, "power", Dimension::Power);
    if (power && power->value != 0.0) {
      const auto speed = number(&shaft, "rotational_speed", Dimension::Speed);
      if (!speed || speed->value == 0.0) return std::nullopt;
      constexpr double newton_mm_per_kw = 1e6 * 30.0 / units::pi;  // at 1/min
      return Taken{newton_mm_per_kw * power->value / speed->value, Reading::name_of(load) + " power at the speed of " + Reading::name_of(shaft)};
    }
    if (torque || power) return std::nullopt;
  }
  return std::nullopt;
}

std::vector<Condition> conditions_of(Reading& reading) {
  std::vector<Condition> conditions;
  for (const LoadCase& load_case : reading.model().load_cases) conditions.emplace_back(reading, &load_case);
  if (conditions.empty()) conditions.emplace_back(reading, nullptr);
  return conditions;
}

bool carries_torque(Reading& reading, const Component& load, const Component& shaft) {
  return std::ranges::any_of(conditions_of(reading), [&](const Condition& condition) {
    return condition.word(&load, "transmits_torque") == "true" || condition.torque_of(load, shaft);
  });
}

}  // namespace flankwright::studies::rexs
