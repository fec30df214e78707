#pragma once

#include <string>

namespace flankwright::studies {

/// Template of `flankwright new optimise`: a study that runs as it is.
std::string optimise_template();

}  // namespace flankwright::studies
