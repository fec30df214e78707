#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace flankwright::studies {

/// "± 0.012", two digits; empty where no error was estimated.
inline std::string known_to(double error) { return std::isnan(error) ? std::string() : fmt::format("± {:.2g}", error); }

}  // namespace flankwright::studies
