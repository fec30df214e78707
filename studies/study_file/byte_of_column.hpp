#pragma once

#include <cstddef>
#include <string_view>

namespace flankwright::studies {

/// The byte of a column of a TOML position. Columns count code points from 1, which are one to four bytes long.
inline std::size_t byte_of_column(std::string_view line, std::size_t column) {
  std::size_t byte = 0;
  for (std::size_t passed = 1; passed < column && byte < line.size(); ++passed) {
    do {
      ++byte;
    } while (byte < line.size() && (static_cast<unsigned char>(line[byte]) & 0xC0U) == 0x80U);
  }
  return byte;
}

}  // namespace flankwright::studies
