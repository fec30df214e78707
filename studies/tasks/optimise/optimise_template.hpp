#pragma once

#include <string>

namespace flankwright::studies {

/// What `flankwright new optimise` prints: a study that runs as it is.
std::string optimise_template();

}  // namespace flankwright::studies
