#pragma once

#include <string>

namespace flankwright::studies {

/// What `flankwright new sweep` prints: a study that runs as it is.
std::string sweep_template();

}  // namespace flankwright::studies
