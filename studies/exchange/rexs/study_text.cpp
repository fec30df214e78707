#include "studies/exchange/rexs/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/base/printable.hpp"

namespace flankwright::studies::rexs {

// Comments and texts of a TOML file hold no control characters but tabs.

void StudyText::comment(const std::string& text) { text_ += "# " + without_control_characters(text) + "\n"; }
void StudyText::table(const std::string& name) { text_ += "\n[" + name + "]\n"; }
void StudyText::list_table(const std::string& name) { text_ += "\n[[" + name + "]]\n"; }

void StudyText::key(const std::string& name, const std::string& value, const std::string& remark) {
  std::string line = name + " = " + value;
  if (!remark.empty()) {
    constexpr std::size_t remark_column = 40;
    line.resize(std::max(line.size() + 1, remark_column), ' ');
    line += "# " + without_control_characters(remark);
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
  for (const char c : without_control_characters(text)) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped + "\"";
}

}  // namespace flankwright::studies::rexs
