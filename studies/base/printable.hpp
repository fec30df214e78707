#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace flankwright::studies {

/// Bytes of the control character at the start of a text in UTF-8: C0 with NUL and DEL one, C1 (U+0080 .. U+009F) two; 0 where it is none.
inline std::size_t control_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0xffU; };
  if (byte(0) < 0x20 || byte(0) == 0x7f) return text.empty() ? 0 : 1;
  return byte(0) == 0xc2 && byte(1) >= 0x80 && byte(1) <= 0x9f ? 2 : 0;
}

inline bool has_control_character(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (control_character(text.substr(i)) > 0) return true;
  }
  return false;
}

/// A text with a blank for every control character of ASCII: in one line, as comments and names may stand in other files.
inline std::string without_control_characters(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
  return text;
}

/// A text without the white space at its ends, or without other characters there.
inline std::string_view trimmed(std::string_view text, std::string_view around = " \t\r\n") {
  const std::size_t first = text.find_first_not_of(around);
  return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(around) - first + 1);
}

/// A text as a terminal may show it: a control character becomes its number, as \x1b. Line ends stay where `kept` has them.
inline std::string printable(std::string_view text, std::string_view kept = "") {
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bytes = control_character(text.substr(i));
    if (bytes == 0 || (bytes == 1 && kept.find(text[i]) != std::string_view::npos)) {
      shown += text[i++];
      continue;
    }
    shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i + bytes - 1]));
    i += bytes;
  }
  return shown;
}

}  // namespace flankwright::studies
