#pragma once

#include <string>

namespace flankwright::studies {

/// Text of `flankwright new slurm`: a script that runs a sweep in parts.
std::string slurm_script();

}  // namespace flankwright::studies
