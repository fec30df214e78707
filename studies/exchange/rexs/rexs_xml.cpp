#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "studies/base/printable.hpp"
#include "studies/exchange/rexs/rexs_errors.hpp"
#include "studies/exchange/rexs/rexs_model.hpp"

namespace flankwright::studies::rexs {

namespace {

/// A REXS file in XML with the positions of its elements.
class XmlReading {
 public:
  XmlReading(std::string_view text, const std::string& name) : text_(text), name_(name) {
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) line_ends_.push_back(at);
  }

  Model read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) refuse(name_, line_at(parsed.offset), "XML", parsed.description(), "well-formed XML");
    const pugi::xml_node root = document.child("model");
    if (!root) refuse(name_, 1, "element", document.document_element().name(), "<model>, the root of a REXS file");
    Model model;
    model.version = root.attribute("version").value();
    model.application = root.attribute("applicationId").value();
    model.application_version = root.attribute("applicationVersion").value();
    model.date = root.attribute("date").value();
    for (const pugi::xml_node list : root.children("relations")) {
      for (const pugi::xml_node node : list.children("relation")) model.relations.push_back(relation(node));
    }
    for (const pugi::xml_node list : root.children("components")) {
      for (const pugi::xml_node node : list.children("component")) model.components.push_back(component(node));
    }
    for (const pugi::xml_node list : root.children("load_spectrum")) {
      for (const pugi::xml_node node : list.children("load_case")) {
        LoadCase load_case{number(node, "id"), {}};
        for (const pugi::xml_node varied : node.children("component")) load_case.components.push_back(component(varied));
        model.load_cases.push_back(std::move(load_case));
      }
    }
    return model;
  }

 private:
  int line_at(std::ptrdiff_t offset) const {
    const auto before = std::ranges::lower_bound(line_ends_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return static_cast<int>(before - line_ends_.begin()) + 1;
  }
  int line_of(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }

  int number(const pugi::xml_node& node, const char* attribute) const {
    const std::string text(trimmed(node.attribute(attribute).value()));
    const std::optional<int> found = whole_number(text);
    if (!found) refuse(name_, line_of(node), fmt::format("{} {}", node.name(), attribute), text, "a whole number of at least 0");
    return *found;
  }

  Relation relation(const pugi::xml_node& node) const {
    Relation relation{.id = number(node, "id"), .type = node.attribute("type").value(), .line = line_of(node)};
    if (node.attribute("order")) relation.order = number(node, "order");
    for (const pugi::xml_node ref : node.children("ref")) {
      relation.refs.push_back({number(ref, "id"), ref.attribute("role").value(), ref.attribute("hint").value()});
    }
    return relation;
  }

  Component component(const pugi::xml_node& node) const {
    Component component{
        .id = number(node, "id"), .type = node.attribute("type").value(), .name = node.attribute("name").value(), .line = line_of(node)};
    for (const pugi::xml_node child : node.children("attribute")) component.attributes.push_back(attribute(child));
    return component;
  }

  Attribute attribute(const pugi::xml_node& node) const {
    Attribute attribute{.id = node.attribute("id").value(), .unit = std::string(trimmed(node.attribute("unit").value())), .line = line_of(node)};
    if (const pugi::xml_node array = node.child("array")) {
      attribute.type = ValueType::NumberArray;
      for (const pugi::xml_node cell : array.children("c")) attribute.array.emplace_back(trimmed(cell.child_value()));
      if (const pugi::xml_attribute code = array.attribute("code")) {
        auto numbers = unpacked(array.child_value(), code.value());
        if (!numbers) refuse(name_, line_of(node), attribute.id, array.child_value(), "base64 of float64, float32 or int32");
        attribute.array = std::move(*numbers);
      }
    } else if (node.child("matrix") || node.child("array_of_arrays")) {
      attribute.type = ValueType::Other;
    } else {
      attribute.text = trimmed(node.child_value());
    }
    return attribute;
  }

  std::string_view text_;
  const std::string& name_;
  std::vector<std::size_t> line_ends_;
};

void add_component(pugi::xml_node list, const Component& component) {
  pugi::xml_node node = list.append_child("component");
  node.append_attribute("id") = component.id;
  node.append_attribute("type") = component.type.c_str();
  if (!component.name.empty()) node.append_attribute("name") = component.name.c_str();
  for (const Attribute& attribute : component.attributes) {
    pugi::xml_node child = node.append_child("attribute");
    child.append_attribute("id") = attribute.id.c_str();
    child.append_attribute("unit") = attribute.unit.c_str();
    if (attribute.type == ValueType::NumberArray) {
      pugi::xml_node array = child.append_child("array");
      for (const std::string& number : attribute.array) array.append_child("c").text().set(number.c_str());
    } else {
      child.text().set(attribute.text.c_str());
    }
  }
}

}  // namespace

Model parse_xml(std::string_view text, const std::string& name) { return XmlReading(text, name).read(); }

std::string xml_text(const Model& model) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("model");
  root.append_attribute("applicationId") = model.application.c_str();
  root.append_attribute("applicationVersion") = model.application_version.c_str();
  root.append_attribute("date") = model.date.c_str();
  root.append_attribute("version") = model.version.c_str();
  pugi::xml_node relations = root.append_child("relations");
  for (const Relation& relation : model.relations) {
    pugi::xml_node node = relations.append_child("relation");
    node.append_attribute("id") = relation.id;
    node.append_attribute("type") = relation.type.c_str();
    if (relation.order) node.append_attribute("order") = *relation.order;
    for (const Reference& reference : relation.refs) {
      pugi::xml_node ref = node.append_child("ref");
      ref.append_attribute("hint") = reference.hint.c_str();
      ref.append_attribute("id") = reference.id;
      ref.append_attribute("role") = reference.role.c_str();
    }
  }
  pugi::xml_node components = root.append_child("components");
  for (const Component& component : model.components) add_component(components, component);
  if (!model.load_cases.empty()) {
    pugi::xml_node spectrum = root.append_child("load_spectrum");
    spectrum.append_attribute("id") = 1;
    for (const LoadCase& load_case : model.load_cases) {
      pugi::xml_node node = spectrum.append_child("load_case");
      node.append_attribute("id") = load_case.id;
      for (const Component& component : load_case.components) add_component(node, component);
    }
  }
  std::ostringstream out;
  document.save(out, "  ", pugi::format_indent, pugi::encoding_utf8);
  return out.str();
}

}  // namespace flankwright::studies::rexs
