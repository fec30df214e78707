#pragma once

#include <string>

namespace flankwright::studies {

/// What `flankwright new slurm` prints: a script that runs a sweep in parts.
std::string slurm_script();

}  // namespace flankwright::studies
