#include "studies/study_file/study_reading.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "studies/base/printable.hpp"

namespace flankwright::studies {

namespace {

[[noreturn]] void refuse_value(const std::string& allowed) { throw InvalidInput("", "", allowed); }

[[noreturn]] void refuse_range(const SchemaKey& key) { refuse_value(allowed_values(key) + (key.hint.empty() ? "" : "; " + key.hint)); }

/// Inside the range, or on a bound that the conversion of units missed by round-off: then the bound.
double checked(const SchemaKey& key, double value) {
  const double low = internal_value(key.range.low, key.quantity);
  const double high = internal_value(key.range.high, key.quantity);
  constexpr double round_off = 1e-14;  // |value - bound| <= round_off * |bound|: a few ulp
  if (std::isfinite(low) && std::abs(value - low) <= round_off * std::abs(low)) value = low;
  if (std::isfinite(high) && std::abs(value - high) <= round_off * std::abs(high)) value = high;
  const bool above = key.range.low_open ? value > low : value >= low;
  const bool below = key.range.high_open ? value < high : value <= high;
  if (!std::isfinite(value) || !above || !below) refuse_range(key);
  return value;
}

Value read_numbers(const SchemaKey& key, const toml::node& node) {
  Value value;
  const toml::array* list = node.as_array();
  value.is_list = list != nullptr;
  if (list == nullptr) {
    if (key.kind == ValueKind::NumberList) refuse_value(allowed_values(key));
    value.numbers.push_back(read_number(key, node));
    return value;
  }
  if (list->empty()) refuse_value(allowed_values(key) + ", not empty");
  for (const toml::node& element : *list) value.numbers.push_back(read_number(key, element));
  return value;
}

Value read_integer(const SchemaKey& key, const toml::node& node) {
  const auto* integer = node.as_integer();
  if (integer == nullptr) refuse_value(allowed_values(key));
  const long long found = integer->get();
  const bool above = static_cast<double>(found) >= key.range.low;
  const bool below = static_cast<double>(found) <= key.range.high;
  if (!above || !below) refuse_range(key);
  return {.integer = found};
}

/// Index in key.words of the word in the node.
std::size_t read_word(const SchemaKey& key, const toml::node& node) {
  const auto* word = node.as_string();
  if (word == nullptr) refuse_value(allowed_values(key));
  const auto found = std::ranges::find(key.words, word->get());
  if (found == key.words.end()) refuse_value(allowed_values(key));
  return static_cast<std::size_t>(found - key.words.begin());
}

/// Names reach terminals, tables and files of other programs: they are one line of characters that can be seen.
std::string read_text(const SchemaKey& key, const toml::node& node) {
  const auto* text = node.as_string();
  if (text == nullptr) refuse_value(allowed_values(key));
  if (has_control_character(text->get())) refuse_value(allowed_values(key) + " without control characters or line ends");
  return text->get();
}

Value read_text_list(const SchemaKey& key, const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->empty()) refuse_value(allowed_values(key) + ", at least one");
  Value value{.is_list = true};
  for (const toml::node& element : *list) {
    value.words.push_back(read_text(key, element));
  }
  return value;
}

Value read_word_list(const SchemaKey& key, const toml::node& node) {
  const auto* word = node.as_string();
  if (word != nullptr && word->get() == "auto") return {};
  const toml::array* list = node.as_array();
  if (list == nullptr) refuse_value(allowed_values(key));
  Value value{.is_list = true};
  for (const toml::node& element : *list) value.words.push_back(key.words[read_word(key, element)]);
  return value;
}

/// What a dotted path leads to: a key may have dots of its own, and the elements of a list go by their index. Null where nothing is given there.
const toml::node* node_at(const toml::node& from, std::string_view path) {
  if (path.empty()) return &from;
  for (std::size_t dot = path.find('.');; dot = path.find('.', dot + 1)) {
    const std::string_view key = path.substr(0, dot), rest = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
    const toml::node* next = from.is_table() ? from.as_table()->get(key) : nullptr;
    std::size_t index = 0;
    const bool is_index = from.is_array() && std::from_chars(key.data(), key.data() + key.size(), index).ptr == key.data() + key.size();
    if (is_index) next = from.as_array()->get(index);
    if (const toml::node* found = next == nullptr ? nullptr : node_at(*next, rest)) return found;
    if (dot == std::string_view::npos) return nullptr;
  }
}

}  // namespace

void StudyReading::refuse(const Position& at, const std::string& key, const toml::node* node, const std::string& allowed) {
  constexpr std::size_t longest_value = 60;
  std::string value = node == nullptr ? "(not given)" : document.text_of(*node);
  if (value.size() > longest_value) {
    std::size_t end = longest_value;
    while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xC0U) == 0x80U) --end;  // whole code points
    value = value.substr(0, end) + "...";
  }
  problems.push_back({at.file, at.line, at.column, key, value, allowed});
}

void StudyReading::refuse_key(const std::string& path, const std::string& allowed) {
  const Match* match = find(path);
  refuse(where(path), path, match == nullptr ? node_at(document.root(), path) : match->node, allowed);
}

void StudyReading::refuse_value(const std::string& path, const std::string& value, const std::string& allowed) {
  const Position at = where(path);
  problems.push_back({at.file, at.line, at.column, path, value, allowed});
}

const Match* StudyReading::find(const std::string& path) const {
  const auto found = matches.find(path);
  return found == matches.end() ? nullptr : &found->second;
}

Position StudyReading::where(const std::string& path) const {
  for (std::string part = path; !part.empty();) {
    if (const auto found = positions.find(part); found != positions.end()) return found->second;
    const std::size_t dot = part.rfind('.');
    part = dot == std::string::npos ? "" : part.substr(0, dot);
  }
  return {document.name(), 1, 1};
}

std::map<std::string, Match> match_keys(StudyReading& reading, const toml::table& table, const KeyIndex& keys, const std::string& prefix) {
  std::map<std::string, Match> matches;
  const auto visit = [&](const auto& self, const toml::table& level, const std::string& above) -> void {
    for (const auto& [name, node] : level) {
      const std::string path = above + std::string(name.str());
      const Position position = reading.document.position(name);
      reading.positions.emplace(prefix + path, position);
      if (const auto known = keys.find(path); known != keys.end()) {
        const bool is_first = matches.emplace(path, Match{known->second, &node, position, prefix + path}).second;
        if (!is_first) reading.refuse(position, prefix + path, &node, "the key is given twice");
        const bool is_either = known->second->kind == ValueKind::WordOrTable || known->second->kind == ValueKind::TableListOrFile;
        if (is_either && node.is_table()) self(self, *node.as_table(), path + ".");
      } else if (is_table(keys, path)) {
        if (const toml::table* inner = node.as_table()) {
          self(self, *inner, path + ".");
        } else {
          reading.refuse(position, prefix + path, &node, "allowed is a table");
        }
      } else if (&keys == &scene_keys() && (study_keys().contains(path) || is_table(study_keys(), path))) {
        reading.refuse(position, prefix + path, &node,
                       "a scene may override misalignment.*, load.torque, load.speed, pinion.error.* and wheel.error.*");
      } else {
        reading.refuse(position, prefix + path, &node, "unknown key" + nearest_key_hint(keys, path));
      }
    }
  };
  visit(visit, table, "");
  return matches;
}

double read_number(const SchemaKey& key, const toml::node& node) {
  if (const auto* text = node.as_string()) {
    try {
      return checked(key, parse_value_with_unit(text->get(), key.quantity));
    } catch (const InvalidInput& problem) {
      if (problem.value().empty()) throw;
      refuse_value(allowed_values(key) + ", or a text: " + problem.allowed());
    }
  }
  const std::optional<double> bare = node.is_number() ? node.value<double>() : std::nullopt;
  if (!bare) refuse_value(allowed_values(key));
  return checked(key, internal_value(*bare, key.quantity));
}

Value read_value(const SchemaKey& key, const toml::node& node) {
  switch (key.kind) {
    case ValueKind::Number:
      return {.number = read_number(key, node)};
    case ValueKind::NumberOrList:
    case ValueKind::NumberList:
      return read_numbers(key, node);
    case ValueKind::Integer:
      return read_integer(key, node);
    case ValueKind::Percentage: {
      const auto* text = node.as_string();
      if (text == nullptr) refuse_value(allowed_values(key));
      constexpr double percent_of_one = 100.0;
      return {.number = checked(key, percent_of_one * parse_percentage(text->get())) / percent_of_one};
    }
    case ValueKind::IntegerOrAuto:
      if (node.is_string() && node.as_string()->get() == "auto") return {.text = "auto"};
      return read_integer(key, node);
    case ValueKind::NumberOrNone:
      if (node.is_string() && node.as_string()->get() == "none") return {.number = 0.0};
      return {.number = read_number(key, node)};
    case ValueKind::Text:
      return {.text = read_text(key, node)};
    case ValueKind::TextList:
      return read_text_list(key, node);
    case ValueKind::WordOrTable:
      if (node.is_table()) return {};  // its keys have rows of their own
      [[fallthrough]];
    case ValueKind::Word: {
      const std::size_t index = read_word(key, node);
      return {.integer = static_cast<long long>(index), .text = key.words[index]};
    }
    case ValueKind::WordList:
      return read_word_list(key, node);
    case ValueKind::TableList:  // its tables' keys have rows of their own
    case ValueKind::TableListOrFile:
    case ValueKind::Free:
      return {};  // by readers of their own
  }
  return {};
}

namespace {

void store(const SchemaKey& key, const Value& value, StudyBuilder& builder, Scene& scene) {
  if (const auto* in_study = std::get_if<StoreInStudy>(&key.store)) (*in_study)(builder, key.member, value);
  if (const auto* in_scene = std::get_if<StoreInScene>(&key.store)) (*in_scene)(scene, key.member, value);
  Modification& modification = builder.study.modification[key.member];
  if (const auto* parameter = std::get_if<ModificationParameter>(&key.store)) set(modification, *parameter, value.number);
  if (const auto* choice = std::get_if<const ModificationChoice*>(&key.store)) (*choice)->set(modification, static_cast<std::size_t>(value.integer));
}

void read_table_list(StudyReading& reading, const Match& match, Scene& scene) {
  const toml::array* tables = match.node->as_array();
  if (tables == nullptr || tables->empty() || !tables->is_homogeneous(toml::node_type::table)) {
    return reading.refuse(match.position, match.path, match.node, "allowed is " + allowed_values(*match.key));
  }
  const KeyIndex keys = element_keys(match.key->path);
  for (std::size_t i = 0; i < tables->size(); ++i) {
    const std::string path = match.path + "." + std::to_string(i);
    reading.positions.emplace(path, reading.document.position(*tables->get(i), match.position));
    store(*match.key, {}, reading.builder, scene);
    const std::size_t problems = reading.problems.size();
    for (const auto& [name, of_table] : match_keys(reading, *tables->get(i)->as_table(), keys, path + ".")) {
      read_into(reading, of_table, scene);
    }
    if (reading.problems.size() > problems) continue;
    for (const auto& [name, key] : keys) {
      if (!is_required(*key) || reading.positions.contains(path + "." + name)) continue;
      reading.refuse(reading.where(path), path + "." + name, nullptr, "required: allowed is " + allowed_values(*key));
    }
  }
}

}  // namespace

void read_into(StudyReading& reading, const Match& match, Scene& scene) {
  const bool is_list = match.key->kind == ValueKind::TableList || match.key->kind == ValueKind::TableListOrFile;
  if (match.key->kind == ValueKind::TableListOrFile && match.node->is_table()) return;  // its file is read when all keys are known
  if (is_list) return read_table_list(reading, match, scene);
  try {
    store(*match.key, read_value(*match.key, *match.node), reading.builder, scene);
  } catch (const InvalidInput& problem) {
    reading.refuse(match.position, match.path, match.node, "allowed is " + problem.allowed());
  }
}

void store_defaults(StudyBuilder& builder) {
  static const StudyBuilder defaults = [] {
    StudyBuilder made;
    for (const SchemaKey& key : study_schema()) {
      if (is_described_fallback(key)) continue;
      const toml::table fallback = toml::parse("value = " + key.fallback);
      store(key, read_value(key, *fallback.get("value")), made, made.base);
    }
    return made;
  }();
  builder = defaults;
}

}  // namespace flankwright::studies
