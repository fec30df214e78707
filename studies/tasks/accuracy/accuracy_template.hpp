#pragma once

#include <string>

namespace flankwright::studies {

/// Template of `flankwright new accuracy`: a study that runs as it is.
std::string accuracy_template();

}  // namespace flankwright::studies
