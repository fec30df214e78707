#include "studies/study_file/study_document.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <sstream>
#include <utility>

#include "studies/study_file/byte_of_column.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/study_file/study_syntax.hpp"

namespace flankwright::studies {

namespace {

constexpr std::string_view command_line = "--set";

/// Parts of one dotted key. Every level of nesting costs stack when tables are visited and destroyed; no key of a study
/// has more than six parts.
constexpr int most_key_parts = 16;

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Follows a TOML text far enough to find the dots in keys.
class KeyDepthScan {
 public:
  /// Line of the first key with more than most_key_parts parts, from 1; 0 where there is none.
  int deep_line(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') ++line_;
      i += step(text.substr(i));
      if (dots_ >= most_key_parts) return line_;
    }
    return 0;
  }

 private:
  /// Takes the next character and returns how many more belong to it.
  std::size_t step(std::string_view rest) {
    if (in_comment_) {
      in_comment_ = rest.front() != '\n';
      if (!in_comment_) dots_ = 0;
      return 0;
    }
    if (!delimiter_.empty()) {
      if (delimiter_.front() == '"' && rest.front() == '\\') return 1;
      if (delimiter_.size() == 1 && rest.front() == '\n') delimiter_ = {};
      if (delimiter_.empty() || !rest.starts_with(delimiter_)) return 0;
      return std::exchange(delimiter_, std::string_view{}).size() - 1;
    }
    for (const std::string_view quote : {"\"\"\"", "'''", "\"", "'"}) {
      if (!rest.starts_with(quote)) continue;
      delimiter_ = quote;
      return quote.size() - 1;
    }
    if (rest.front() == '#') in_comment_ = true;
    if (rest.front() == '.') ++dots_;
    if (std::string_view("\n=,[]{}").find(rest.front()) != std::string_view::npos) dots_ = 0;
    return 0;
  }

  int line_{1};
  int dots_{0};
  bool in_comment_{false};
  std::string_view delimiter_;  ///< that ends the text we are in
};

toml::table parse_toml(std::string_view text, const std::string& name) {
  if (const int line = KeyDepthScan().deep_line(text); line > 0) {
    const std::string allowed = "allowed are keys of at most " + std::to_string(most_key_parts) + " parts";
    throw StudyErrors({{name, line, 1, "", "", allowed}});
  }
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    const std::string description(error.description());
    const std::vector<std::string> lines = split(text, '\n');
    const std::string hint = at.line >= 1 && at.line <= lines.size() ? syntax_hint(lines[at.line - 1]) : "";
    throw StudyErrors({{name, static_cast<int>(at.line), static_cast<int>(at.column), "", "", description + hint}});
  }
}

/// The parts of a dotted key; empty where it is not one.
std::vector<std::string> key_parts(const std::string& key) {
  std::vector<std::string> parts;
  try {
    const toml::table chain = parse_toml(key + " = 0", std::string(command_line));
    for (const toml::table* level = &chain; level != nullptr; level = level->begin()->second.as_table()) {
      if (level->size() != 1) return {};
      for (std::string& part : split(level->begin()->first.str(), '.')) parts.push_back(std::move(part));
    }
  } catch (const StudyErrors&) {
    return {};
  }
  return parts.size() <= most_key_parts ? parts : std::vector<std::string>{};
}

/// The value as TOML where it is, else as a text.
toml::table parse_value(const std::string& value) {
  try {
    toml::table parsed = parse_toml("value = " + value, std::string(command_line));
    if (parsed.size() == 1 && parsed.contains("value")) return parsed;
  } catch (const StudyErrors&) {
    // Not TOML: an unquoted text such as 3 arcmin.
  }
  const std::size_t first = std::min(value.find_first_not_of(" \t"), value.size());
  toml::table text;
  text.insert("value", value.substr(first, value.find_last_not_of(" \t") + 1 - first));
  return text;
}

std::string join(const std::vector<std::string>& parts, std::size_t from) {
  std::string joined = parts[from];
  for (std::size_t i = from + 1; i < parts.size(); ++i) joined += "." + parts[i];
  return joined;
}

/// The table that a part of a path leads to in an array of tables; null where it does not.
toml::table* element(toml::node& node, const std::string& index) {
  toml::array* array = node.as_array();
  std::size_t i = 0;
  const auto [end, status] = std::from_chars(index.data(), index.data() + index.size(), i);
  if (array == nullptr || status != std::errc{} || end != index.data() + index.size() || i >= array->size()) return nullptr;
  return array->get(i)->as_table();
}

void assign(toml::table& table, const std::string& name, const toml::node& value) {
  toml::source_region region;
  region.path = std::make_shared<const std::string>(command_line);
  table.erase(name);  // with its key, which would keep its place in the file
  value.visit([&](const auto& node) { table.insert_or_assign(toml::key(name, region), node); });
}

void remove_path(toml::table& root, const std::string& path) {
  const std::vector<std::string> parts = split(path, '.');
  toml::table* table = &root;
  for (std::size_t i = 0; i + 1 < parts.size() && table != nullptr; ++i) {
    toml::node* next = table->get(parts[i]);
    table = next == nullptr ? nullptr : next->as_table();
  }
  if (table != nullptr) table->erase(parts.back());
}

std::string in_one_line(const std::string& text) {
  std::string tidy;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!blank) {
      tidy += c;
    } else if (!tidy.empty() && tidy.back() != ' ') {
      tidy += ' ';
    }
  }
  if (!tidy.empty() && tidy.back() == ' ') tidy.pop_back();
  return tidy;
}

/// A value from the command line as TOML, numbers in their shortest form.
std::string formatted(const toml::node& node) {
  std::ostringstream out;
  const auto list = [&out](const char* open, const auto& elements, const auto& write, const char* close) {
    out << open;
    const char* separator = "";
    for (const auto& element : elements) {
      out << std::exchange(separator, ", ");
      write(element);
    }
    out << close;
  };
  if (const toml::array* array = node.as_array()) {
    list(
        "[", *array, [&out](const toml::node& element) { out << formatted(element); }, "]");
  } else if (const toml::table* table = node.as_table()) {
    const auto write = [&out](const auto& entry) { out << entry.first.str() << " = " << formatted(entry.second); };
    list("{ ", *table, write, " }");
  } else if (const auto* number = node.as_floating_point()) {
    std::array<char, 32> digits{};
    const auto [end, status] = std::to_chars(digits.data(), digits.data() + digits.size(), number->get());
    out << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
  } else {
    node.visit([&out](const auto& value) { out << toml::toml_formatter{value}; });
  }
  return in_one_line(out.str());
}

}  // namespace

StudyDocument::StudyDocument(std::string_view text, std::string name, const std::vector<Override>& overrides, std::vector<StudyProblem>& problems)
    : name_(std::move(name)), lines_(split(text, '\n')), root_(parse_toml(text, name_)) {
  for (const Override& one : overrides) merge(one, problems);
}

void StudyDocument::merge(const Override& override_, std::vector<StudyProblem>& problems) {
  const auto refuse = [&](const std::string& allowed) {
    problems.push_back({std::string(command_line), 0, 0, override_.key, override_.value, allowed});
  };
  const std::vector<std::string> parts = key_parts(override_.key);
  if (parts.empty()) return refuse("allowed is --set key.path=value");
  const toml::table parsed = parse_value(override_.value);
  const toml::node& value = *parsed.get("value");

  toml::table* table = &root_;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    // A key may have quoted dots in the file: "pinion.modification.lead_crowning" = [0, 40].
    if (const std::string rest = join(parts, i); table->contains(rest)) return assign(*table, rest, value);
    toml::node* next = table->get(parts[i]);
    if (next != nullptr && next->is_array()) {
      table = element(*next, parts[i + 1]);
      if (table == nullptr || i + 2 == parts.size()) return refuse("allowed is a table of this array, counted from 0, and its key");
      ++i;
      continue;
    }
    if (next == nullptr && std::ranges::all_of(parts[i + 1], [](char c) { return c >= '0' && c <= '9'; })) {
      return refuse("allowed is a table of the study; it has no [[" + override_.key.substr(0, override_.key.find("." + parts[i + 1])) + "]]");
    }
    if (next == nullptr || !next->is_table()) {
      assign(*table, parts[i], toml::table{});
      next = table->get(parts[i]);
    }
    table = next->as_table();
  }
  assign(*table, parts.back(), value);
  const std::string path = join(parts, 0);
  for (const ExclusiveKeys& keys : exclusive_keys()) {
    if (path == keys.first) remove_path(root_, keys.second);
    if (path == keys.second) remove_path(root_, keys.first);
  }
}

Position StudyDocument::position(const toml::key& key) const {
  const toml::source_region& source = key.source();
  if (source.path && *source.path == command_line) return {std::string(command_line), 0, 0};
  return {name_, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

Position StudyDocument::position(const toml::node& node, const Position& around) const {
  if (around.file == command_line || node.source().begin.line == 0) return around;
  return {name_, static_cast<int>(node.source().begin.line), static_cast<int>(node.source().begin.column)};
}

std::string StudyDocument::text_of(const toml::node& node) const {
  if (const toml::table* table = node.as_table(); table != nullptr && !table->is_inline()) return "a table";
  const toml::source_region& source = node.source();
  const bool in_file = source.begin.line >= 1 && source.end.line <= lines_.size() && source.begin.line <= source.end.line &&
                       !(source.path && *source.path == command_line);
  if (!in_file) return formatted(node);
  std::string text;
  for (std::size_t line = source.begin.line; line <= source.end.line; ++line) {
    const std::string& whole = lines_[line - 1];
    const std::size_t from = line == source.begin.line ? byte_of_column(whole, source.begin.column) : 0;
    const std::size_t to = line == source.end.line ? byte_of_column(whole, source.end.column) : whole.size();
    if (from < to) text += whole.substr(from, to - from) + "\n";
  }
  return in_one_line(text);
}

std::string StudyDocument::text() const {
  std::ostringstream out;
  out << toml::toml_formatter{root_};
  return out.str();
}

std::vector<GivenValue> StudyDocument::given() const {
  std::vector<GivenValue> values;
  const auto collect = [&](const auto& self, const toml::node& node, const std::string& path) -> void {
    const std::string prefix = path.empty() ? "" : path + ".";
    if (const toml::table* table = node.as_table()) {
      for (const auto& [key, value] : *table) self(self, value, prefix + std::string(key.str()));
    } else if (const toml::array* array = node.as_array(); array != nullptr && array->is_homogeneous(toml::node_type::table) && !array->empty()) {
      for (std::size_t i = 0; i < array->size(); ++i) self(self, *array->get(i), prefix + std::to_string(i));
    } else {
      values.push_back({path, text_of(node)});
    }
  };
  collect(collect, root_, "");
  return values;
}

}  // namespace flankwright::studies
