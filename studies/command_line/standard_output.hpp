#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace flankwright::studies {

/// Throws InvalidInput "standard output" with the system's reason where what was printed did not arrive: a full device, a closed pipe.
inline void check_standard_output(bool arrived) {
  if (!arrived) throw InvalidInput("standard output", "not written", std::string("a place that can be written (") + std::strerror(errno) + ")");
}

/// Prints a text. Throws as check_standard_output() does.
inline void print(std::string_view text) { check_standard_output(std::fwrite(text.data(), 1, text.size(), stdout) == text.size()); }

/// Hands on what is still held back. Throws as check_standard_output() does.
inline void flush_standard_output() { check_standard_output(std::fflush(stdout) == 0 && std::ferror(stdout) == 0); }

}  // namespace flankwright::studies
