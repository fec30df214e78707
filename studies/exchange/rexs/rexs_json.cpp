#include <fmt/format.h>

#include <algorithm>

#include "studies/base/json_format.hpp"
#include "studies/exchange/rexs/rexs_errors.hpp"
#include "studies/exchange/rexs/rexs_model.hpp"

namespace flankwright::studies::rexs {

namespace {

/// A REXS file in JSON. Elements have no lines once parsed: what is refused is named by its id.
class JsonReading {
 public:
  JsonReading(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Model read() const {
    Json json;
    try {
      json = Json::parse(text_, Limit{});
    } catch (const Json::parse_error& error) {
      const std::size_t byte = std::min(error.byte, text_.size());
      const auto line = std::ranges::count(text_.substr(0, byte > 0 ? byte - 1 : 0), '\n') + 1;
      refuse(name_, static_cast<int>(line), "JSON", text_of_error(error.what()), "well-formed JSON");
    } catch (const Json::out_of_range& error) {
      // Well-formed, but no double is as large: "1e999". This error knows no place.
      const std::string_view what = error.what();
      refuse(name_, 0, "JSON", std::string(what.substr(std::min(what.find("] ") + 2, what.size()))), "numbers of at most 1.8e308");
    }
    const Json& root = member(json, "model", "file");
    if (!root.is_object()) refuse(name_, 0, "model", shown(root), "a JSON object");
    Model model;
    model.version = text(root, "version");
    model.application = text(root, "applicationId");
    model.application_version = text(root, "applicationVersion");
    model.date = text(root, "date");
    for (const Json& node : items(root, "relations")) model.relations.push_back(relation(node));
    for (const Json& node : items(root, "components")) model.components.push_back(component(node));
    if (const auto spectrum = root.find("load_spectrum"); spectrum != root.end() && spectrum->is_object()) {
      for (const Json& node : items(*spectrum, "load_cases")) {
        LoadCase load_case{number(node, "id", "load case"), {}};
        for (const Json& varied : items(node, "components")) load_case.components.push_back(component(varied));
        model.load_cases.push_back(std::move(load_case));
      }
    }
    return model;
  }

 private:
  /// Nesting of a REXS file is six deep; what nests much deeper would only exhaust the stack of whoever walks it.
  struct Limit {
    bool operator()(int depth, Json::parse_event_t, Json&) const { return depth <= 64; }
  };

  /// The parser's message without its number and position, which the line of the error has.
  static std::string text_of_error(std::string_view what) {
    const std::size_t colon = what.rfind("; ");
    return std::string(colon == std::string_view::npos ? what.substr(what.find(": ") + 2) : what.substr(colon + 2));
  }

  static std::string shown(const Json& node) { return node.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 100); }

  const Json& member(const Json& node, const char* key, const std::string& of) const {
    const auto found = node.is_object() ? node.find(key) : node.end();
    if (!node.is_object() || found == node.end()) refuse(name_, 0, of, shown(node), fmt::format("an object with \"{}\"", key));
    return *found;
  }

  static std::string text(const Json& node, const char* key) {
    const auto found = node.is_object() ? node.find(key) : node.end();
    return node.is_object() && found != node.end() && found->is_string() ? found->get<std::string>() : "";
  }

  /// The list of this key; empty where there is none.
  const Json& items(const Json& node, const char* key) const {
    static const Json none = Json::array();
    const auto found = node.is_object() ? node.find(key) : node.end();
    if (!node.is_object() || found == node.end() || found->is_null()) return none;
    if (!found->is_array()) refuse(name_, 0, key, shown(*found), "a list");
    return *found;
  }

  int number(const Json& node, const char* key, const std::string& of) const {
    const Json& value = member(node, key, of);
    const std::optional<int> found = whole_number(value.is_string() ? value.get<std::string>() : shown(value));
    if (!found) refuse(name_, 0, of + " " + key, shown(value), "a whole number of at least 0");
    return *found;
  }

  Relation relation(const Json& node) const {
    Relation relation{.id = number(node, "id", "relation"), .type = text(node, "type")};
    const std::string of = fmt::format("relation {}", relation.id);
    if (node.contains("order") && !node["order"].is_null()) relation.order = number(node, "order", of);
    for (const Json& ref : items(node, "refs")) relation.refs.push_back({number(ref, "id", of + " ref"), text(ref, "role"), text(ref, "hint")});
    return relation;
  }

  Component component(const Json& node) const {
    Component component{.id = number(node, "id", "component"), .type = text(node, "type"), .name = text(node, "name")};
    for (const Json& child : items(node, "attributes")) component.attributes.push_back(attribute(child, component.id));
    return component;
  }

  Attribute attribute(const Json& node, int component) const {
    const std::string of = fmt::format("component {} attribute", component);
    if (!member(node, "id", of).is_string()) refuse(name_, 0, of, shown(node), "an object with a text \"id\"");
    Attribute attribute{.id = text(node, "id"), .unit = text(node, "unit")};
    for (const auto& [key, value] : node.items()) {
      if (key != "id" && key != "unit") fill(attribute, key, value, of + " " + attribute.id);
    }
    return attribute;
  }

  /// The value has a key that names its type.
  void fill(Attribute& attribute, const std::string& type, const Json& value, const std::string& of) const {
    const auto text_of = [](const Json& v) { return v.is_string() ? v.get<std::string>() : v.is_null() ? "" : shown(v); };
    if (type.ends_with("_array_coded") && value.is_object()) {
      auto numbers = unpacked(text(value, "value"), text(value, "code"));
      if (!numbers) refuse(name_, 0, of, shown(value), "base64 of float64, float32 or int32");
      attribute.type = ValueType::NumberArray;
      attribute.array = std::move(*numbers);
    } else if (value.is_array() && type.ends_with("_array")) {
      attribute.type = ValueType::NumberArray;
      for (const Json& entry : value) attribute.array.push_back(text_of(entry));
    } else if (value.is_structured()) {
      attribute.type = ValueType::Other;
    } else {
      attribute.type = type == "boolean"          ? ValueType::Boolean
                       : type == "integer"        ? ValueType::Integer
                       : type == "floating_point" ? ValueType::Number
                       : type == "enum"           ? ValueType::Word
                                                  : ValueType::Text;
      attribute.text = text_of(value);
    }
  }

  std::string_view text_;
  const std::string& name_;
};

Json value_json(const Attribute& attribute) {
  switch (attribute.type) {
    case ValueType::Boolean:
      return {{"boolean", attribute.text == "true"}};
    case ValueType::Integer:
      return {{"integer", Json::parse(attribute.text)}};
    case ValueType::Number:
      return {{"floating_point", Json::parse(attribute.text)}};
    case ValueType::Word:
      return {{"enum", attribute.text}};
    case ValueType::NumberArray: {
      Json numbers = Json::array();
      for (const std::string& number : attribute.array) numbers.push_back(Json::parse(number));
      return {{"floating_point_array", numbers}};
    }
    case ValueType::Text:
    case ValueType::Other:
      break;
  }
  return {{"string", attribute.text}};
}

Json component_json(const Component& component) {
  Json json{{"id", component.id}, {"type", component.type}};
  if (!component.name.empty()) json["name"] = component.name;
  json["attributes"] = Json::array();
  for (const Attribute& attribute : component.attributes) {
    Json entry{{"id", attribute.id}, {"unit", attribute.unit}};
    entry.update(value_json(attribute));
    json["attributes"].push_back(entry);
  }
  return json;
}

}  // namespace

Model parse_json(std::string_view text, const std::string& name) { return JsonReading(text, name).read(); }

std::string json_text(const Model& model) {
  Json root{{"version", model.version}, {"applicationId", model.application}, {"applicationVersion", model.application_version},
            {"date", model.date},       {"relations", Json::array()},         {"components", Json::array()}};
  for (const Relation& relation : model.relations) {
    Json json{{"id", relation.id}, {"type", relation.type}, {"refs", Json::array()}};
    if (relation.order) json["order"] = *relation.order;
    for (const Reference& ref : relation.refs) json["refs"].push_back({{"id", ref.id}, {"role", ref.role}, {"hint", ref.hint}});
    root["relations"].push_back(json);
  }
  for (const Component& component : model.components) root["components"].push_back(component_json(component));
  if (!model.load_cases.empty()) {
    Json cases = Json::array();
    for (const LoadCase& load_case : model.load_cases) {
      Json json{{"id", load_case.id}, {"components", Json::array()}};
      for (const Component& component : load_case.components) json["components"].push_back(component_json(component));
      cases.push_back(json);
    }
    root["load_spectrum"] = {{"id", 1}, {"load_cases", cases}};
  }
  return Json{{"model", root}}.dump(2) + "\n";
}

}  // namespace flankwright::studies::rexs
