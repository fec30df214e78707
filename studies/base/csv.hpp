#pragma once

#include <string>

namespace flankwright::studies {

/// CSV field: quoted where it holds a comma, a quote or a line break.
std::string csv_field(const std::string& text);

}  // namespace flankwright::studies
