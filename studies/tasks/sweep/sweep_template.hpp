#pragma once

#include <string>

namespace flankwright::studies {

/// Template of `flankwright new sweep`: a study that runs as it is.
std::string sweep_template();

}  // namespace flankwright::studies
