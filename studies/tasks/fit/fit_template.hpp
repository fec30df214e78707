#pragma once

#include <string>

namespace flankwright::studies {

/// What `flankwright new fit` prints: a study that runs as it is.
std::string fit_template();

}  // namespace flankwright::studies
