#pragma once

#include <string>

namespace flankwright::studies {

/// Template of `flankwright new analyse`: a study that runs as it is.
std::string analyse_template();

}  // namespace flankwright::studies
