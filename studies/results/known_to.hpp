#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <vector>

namespace flankwright::studies {

/// Whether an estimated error leaves nothing of a value: it is larger than the value.
inline bool is_unknown(double value, double error) { return value != 0.0 && error > std::abs(value); }

/// "not known at this resolution, as the error is larger than the value: h1, loss"; a line below a table, empty where `headings` is.
inline std::string unknown_line(const std::vector<std::string>& headings) {
  if (headings.empty()) return {};
  return fmt::format("not known at this resolution in some load case, as the error is larger than the value: {}\n", fmt::join(headings, ", "));
}

/// "± 0.012", two digits; empty where no error was estimated.
inline std::string known_to(double error) { return std::isnan(error) ? std::string() : fmt::format("± {:.2g}", error); }

}  // namespace flankwright::studies
