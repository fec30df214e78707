#include "studies/exchange/rexs/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flankwright::studies::rexs {

namespace {

constexpr std::size_t remark_column = 40;

/// Comments of a TOML file hold no control characters but tabs.
std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
  return text;
}

}  // namespace

void StudyText::comment(const std::string& text) { text_ += "# " + printable(text) + "\n"; }
void StudyText::table(const std::string& name) { text_ += "\n[" + name + "]\n"; }
void StudyText::list_table(const std::string& name) { text_ += "\n[[" + name + "]]\n"; }

void StudyText::key(const std::string& name, const std::string& value, const std::string& remark) {
  std::string line = name + " = " + value;
  if (!remark.empty()) {
    line.resize(std::max(line.size() + 1, remark_column), ' ');
    line += "# " + printable(remark);
  }
  text_ += line + "\n";
}

std::string number_text(double value) { return fmt::format("{:.15g}", value); }

std::string difference_text(double value) {
  constexpr double step = 1e-9;
  return number_text(std::round(value / step) * step);
}

std::string quoted(const std::string& text) {
  std::string escaped = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped + "\"";
}

}  // namespace flankwright::studies::rexs
