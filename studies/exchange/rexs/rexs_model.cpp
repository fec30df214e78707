#include "studies/exchange/rexs/rexs_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <map>

#include "studies/base/printable.hpp"
#include "studies/exchange/rexs/rexs_archive.hpp"
#include "studies/exchange/rexs/rexs_errors.hpp"

namespace flankwright::studies::rexs {

namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Byte of the first character that is no UTF-8; npos where all is.
std::size_t first_foreign_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xc2 && lead < 0xe0 ? 2
                               : lead >= 0xe0 && lead < 0xf0 ? 3
                               : lead >= 0xf0 && lead < 0xf5 ? 4
                                                             : 0;
    if (length == 0 || i + length > text.size()) return i;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return i;
    }
    i += length;
  }
  return std::string_view::npos;
}

/// Elements, attributes, entries and texts that a file could have at most: a gear unit has some ten thousand. The trees of XML and JSON
/// take up to a hundred bytes for each, whatever it says.
constexpr std::size_t most_parts = 2'000'000;

void check_parts(std::string_view text, const std::string& name) {
  std::size_t parts = 0;
  for (const char c : text) parts += c == '<' || c == '{' || c == '[' || c == ',' || c == '=' || c == ':';
  if (parts > most_parts)
    refuse(name, 0, "file", fmt::format("a text of {} parts", parts), fmt::format("at most {} elements and values", most_parts));
}

/// An attribute may be repeated, but not with another value.
void check_attributes(const Component& component, const std::string& name) {
  std::map<std::string_view, const Attribute*> seen;
  for (const Attribute& attribute : component.attributes) {
    const Attribute& first = *seen.emplace(attribute.id, &attribute).first->second;
    if (first.text == attribute.text && first.unit == attribute.unit && first.array == attribute.array) continue;
    const std::string value = attribute.array.empty() ? attribute.text : fmt::format("{}", fmt::join(attribute.array, " "));
    refuse(name, attribute.line, full_name(component) + " " + attribute.id, value, "one value: this attribute has another before it");
  }
}

void check_ids(const Model& model, const std::string& name) {
  std::map<int, const Component*> seen;
  for (const Component& component : model.components) {
    const auto [first, is_new] = seen.emplace(component.id, &component);
    if (!is_new)
      refuse(name, component.line, "component id", std::to_string(component.id), "each id once: " + full_name(*first->second) + " has this one");
    check_attributes(component, name);
  }
  for (const LoadCase& load_case : model.load_cases) {
    for (const Component& varied : load_case.components) check_attributes(varied, name);
  }
}

}  // namespace

const Attribute* Component::find(std::string_view attribute) const {
  const auto found = std::ranges::find(attributes, attribute, &Attribute::id);
  return found == attributes.end() ? nullptr : &*found;
}

std::string full_name(const Component& component) {
  const std::string name = without_control_characters(component.name);
  return fmt::format("{} {}{}", component.type, component.id, name.empty() ? "" : " \"" + name + "\"");
}

std::optional<int> Relation::role(std::string_view name) const {
  const auto found = std::ranges::find(refs, name, &Reference::role);
  return found == refs.end() ? std::nullopt : std::optional(found->id);
}

const Component* Model::find(int id) const {
  const auto found = std::ranges::find(components, id, &Component::id);
  return found == components.end() ? nullptr : &*found;
}

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = status == std::errc{} && end == text.data() + text.size() && number >= 0;
  return whole ? std::optional(number) : std::nullopt;
}

std::optional<std::vector<std::string>> unpacked(std::string_view base64, std::string_view code) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int held = 0;
  while (base64.ends_with('=')) base64.remove_suffix(1);
  for (const char c : base64) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xfffU;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> held & 0xffU));
  }
  const std::size_t width = code == "float64" ? 8 : code == "float32" || code == "int32" ? 4 : 0;
  if (width == 0 || bytes.size() % width != 0) return std::nullopt;
  std::vector<std::string> numbers;
  for (std::size_t at = 0; at < bytes.size(); at += width) {
    std::uint64_t word = 0;
    for (std::size_t k = width; k-- > 0;) word = word << 8 | bytes[at + k];
    const auto low = static_cast<std::uint32_t>(word);
    numbers.push_back(code == "float64"   ? fmt::format("{}", std::bit_cast<double>(word))
                      : code == "float32" ? fmt::format("{}", std::bit_cast<float>(low))
                                          : fmt::format("{}", std::bit_cast<std::int32_t>(low)));
  }
  return numbers;
}

Model parse_model(std::string_view text, const std::string& name) {
  std::string unpacked_text;
  if (is_archive(text)) text = unpacked_text = unpack(text, name);
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  if (const std::size_t foreign = first_foreign_byte(text); foreign != std::string_view::npos) {
    const auto line = std::ranges::count(text.substr(0, foreign), '\n') + 1;
    refuse(name, static_cast<int>(line), "byte", fmt::format("0x{:02x}", static_cast<unsigned char>(text[foreign])), "UTF-8");
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) refuse(name, 0, "file", "without content", "a REXS model, XML or JSON");
  if (text[first] != '<' && text[first] != '{') {
    refuse(name, 0, "file", std::string(text.substr(first, 20)), "a REXS model: XML starts with <, JSON with {");
  }
  check_parts(text, name);
  const Model model = text[first] == '<' ? parse_xml(text, name) : parse_json(text, name);
  check_ids(model, name);
  return model;
}

std::string model_text(const Model& model, Form form) {
  return std::string(byte_order_mark) + (form == Form::Xml ? xml_text(model) : json_text(model));
}

}  // namespace flankwright::studies::rexs
