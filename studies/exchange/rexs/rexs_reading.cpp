#include "studies/exchange/rexs/rexs_errors.hpp"
#include "studies/exchange/rexs/rexs_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

bool agree(double a, double b) {
  constexpr double same = 1e-9;
  return std::abs(a - b) <= same * (1.0 + std::abs(a));
}

void Reading::warn(std::string text) {
  if (std::ranges::find(warnings_, text) == warnings_.end()) warnings_.push_back(std::move(text));
}

std::string Reading::name_of(const Component& component) { return fmt::format("{} {}", component.type, component.id); }

void Reading::refuse_attribute(const Component& component, std::string_view attribute, const std::string& value, const std::string& allowed) const {
  const Attribute* found = component.find(attribute);
  const int line = found != nullptr ? found->line : component.line;
  refuse(file_, line, full_name(component) + " " + std::string(attribute), value, allowed);
}

double Reading::unit_of(const Component& component, const Attribute& attribute, Dimension dimension) const {
  constexpr double standard_angle = units::deg, standard_torque = 1e3, standard_stiffness = 1e-3, standard_density = 1e3, standard_share = 0.01;
  if (attribute.unit.empty() || attribute.unit == "none") {
    return dimension == Dimension::Angle       ? standard_angle
           : dimension == Dimension::Torque    ? standard_torque
           : dimension == Dimension::Stiffness ? standard_stiffness
           : dimension == Dimension::Density   ? standard_density
           : dimension == Dimension::Share     ? standard_share
                                               : 1.0;
  }
  const std::optional<double> size = unit_size(attribute.unit, dimension);
  if (!size) refuse_attribute(component, attribute.id, "a value in " + attribute.unit, "a unit of " + units_in_words(dimension));
  return *size;
}

double Reading::value_of(const Component& component, const Attribute& attribute, const std::string& text, double unit) const {
  double value = 0.0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(begin, end, value);
  if (status != std::errc{} || stop != end || !std::isfinite(value * unit)) {
    refuse_attribute(component, attribute.id, text, "a finite number with a decimal point");
  }
  return value * unit;
}

std::optional<Taken> Reading::number(const Component* component, std::string_view attribute, Dimension dimension) {
  const Attribute* found = component == nullptr ? nullptr : component->find(attribute);
  if (found == nullptr) return std::nullopt;
  read_.insert(found);
  if (found->text.empty()) return std::nullopt;
  const double offset = dimension == Dimension::Temperature ? unit_offset(found->unit) : 0.0;
  return Taken{value_of(*component, *found, found->text, unit_of(*component, *found, dimension)) + offset, name_of(*component) + " " + found->id};
}

std::optional<double> Reading::length(const Component& component, std::string_view attribute) {
  const auto taken = number(&component, attribute, Dimension::Length);
  return taken ? std::optional(taken->value) : std::nullopt;
}

std::optional<Taken> Reading::first_of(const Component* component, std::initializer_list<std::string_view> attributes, Dimension dimension) {
  for (const std::string_view attribute : attributes) {
    if (auto taken = number(component, attribute, dimension)) return taken;
  }
  return std::nullopt;
}

std::string Reading::word(const Component* component, std::string_view attribute) {
  const Attribute* found = component == nullptr ? nullptr : component->find(attribute);
  if (found == nullptr) return {};
  read_.insert(found);
  return found->text;
}

std::optional<std::vector<double>> Reading::numbers(const Component* component, std::string_view attribute, Dimension dimension) {
  const Attribute* found = component == nullptr ? nullptr : component->find(attribute);
  if (found == nullptr || found->type != ValueType::NumberArray) return std::nullopt;
  read_.insert(found);
  const double unit = unit_of(*component, *found, dimension);
  std::vector<double> values;
  for (const std::string& text : found->array) values.push_back(value_of(*component, *found, text, unit));
  return values;
}

std::vector<const Component*> Reading::related(const Component& of, std::initializer_list<std::string_view> types) const {
  std::vector<std::pair<int, const Component*>> found;
  for (const Relation& relation : model_.relations) {
    if (std::ranges::find(relation.refs, of.id, &Reference::id) == relation.refs.end()) continue;
    for (const Reference& reference : relation.refs) {
      const Component* other = model_.find(reference.id);
      if (other == nullptr || other == &of || std::ranges::find(types, other->type) == types.end()) continue;
      if (std::ranges::find(found, other, &std::pair<int, const Component*>::second) == found.end()) {
        found.emplace_back(relation.order.value_or(0), other);
      }
    }
  }
  std::ranges::stable_sort(found, {}, &std::pair<int, const Component*>::first);
  std::vector<const Component*> components;
  for (const auto& [order, component] : found) components.push_back(component);
  return components;
}

const Component& Reading::in_role(const Relation& relation, std::string_view role) const {
  const std::string name = fmt::format("relation {} role", relation.id);
  const std::optional<int> id = relation.role(role);
  if (!id) refuse(file_, relation.line, name, "without " + std::string(role), "a ref with role \"" + std::string(role) + "\"");
  const Component* component = model_.find(*id);
  if (component == nullptr) {
    refuse(file_, relation.line, name + " " + std::string(role), std::to_string(*id), "the id of a component of this file");
  }
  return *component;
}

std::vector<std::string> Reading::unread(const Component& component) const {
  std::vector<std::string> ids;
  for (const Attribute& attribute : component.attributes) {
    if (!read_.contains(&attribute)) ids.push_back(attribute.id);
  }
  return ids;
}

}  // namespace flankwright::studies::rexs
