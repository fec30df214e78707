#include "studies/study_file/study_syntax.hpp"

#include <algorithm>
#include <cctype>

#include "studies/base/printable.hpp"

namespace flankwright::studies {

namespace {

constexpr std::size_t longest_value = 40;  // characters; what is longer is no number with a unit

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Length of a number without exponent at the beginning of the text, its decimals behind `point`; 0 where there is none.
std::size_t number_length(std::string_view text, char point) {
  std::size_t i = !text.empty() && (text.front() == '+' || text.front() == '-') ? 1 : 0;
  const std::size_t start = i;
  bool has_point = false;
  for (; i < text.size() && (is_digit(text[i]) || (text[i] == point && !has_point)); ++i) has_point = has_point || text[i] == point;
  return i > start && is_digit(text[start]) ? i : 0;
}

}  // namespace

std::string syntax_hint(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return "";
  const std::string_view rest = line.substr(equals + 1);
  const std::string_view value = trimmed(rest.substr(0, rest.find('#')));
  if (value.size() > longest_value || value.find_first_of("[]{}\"'") != std::string_view::npos) return "";
  if (value.find(',') != std::string_view::npos && value.back() != ',' && number_length(value, ',') == value.size()) {
    std::string with_point(value);
    std::ranges::replace(with_point, ',', '.');
    return "; decimals stand behind a point: " + with_point;
  }
  const std::size_t length = number_length(value, '.');
  if (length == 0 || length == value.size() || value.find(',') != std::string_view::npos) return "";
  const auto first = static_cast<unsigned char>(trimmed(value.substr(length)).front());
  if (std::isalpha(first) == 0 && first < 0x80U) return "";  // of °, µ the first byte
  return "; a value with its unit is a text in quotes: \"" + std::string(value) + "\"";
}

}  // namespace flankwright::studies
