#pragma once

#include <string>

namespace flankwright::studies {

/// What `flankwright new analyse` prints: a study that runs as it is.
std::string analyse_template();

}  // namespace flankwright::studies
