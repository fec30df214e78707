#include "studies/base/csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace flankwright::studies {

namespace {

bool starts_a_formula(const std::string& text) { return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos; }

bool is_number(const std::string& text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [last, status] = std::from_chars(text.data(), end, number);
  return status == std::errc{} && last == end;
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (starts_a_formula(text) && !is_number(text)) return csv_field("'" + text);
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_field(double number) { return std::isnan(number) ? std::string() : fmt::format("{}", number); }

}  // namespace flankwright::studies
