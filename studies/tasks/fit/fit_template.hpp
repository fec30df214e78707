#pragma once

#include <string>

namespace flankwright::studies {

/// Template of `flankwright new fit`: a study that runs as it is.
std::string fit_template();

}  // namespace flankwright::studies
