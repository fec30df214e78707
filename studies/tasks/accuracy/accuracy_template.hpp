#pragma once

#include <string>

namespace flankwright::studies {

/// What `flankwright new accuracy` prints: a study that runs as it is.
std::string accuracy_template();

}  // namespace flankwright::studies
