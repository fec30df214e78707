#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

/// CalculiX (ccx, Debian package calculix-ccx) as an outside truth.
namespace flankwright::calculix {

/// Whether it can be called.
inline bool is_installed() { return std::system("command -v ccx > /dev/null 2>&1") == 0; }

/// Runs it on one thread on the deck NAME.inp of a folder, which gets NAME.dat and ccx.log.
/// @return its exit code
inline int run(const std::filesystem::path& folder, const std::string& name) {
  return std::system(("cd '" + folder.string() + "' && OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 ccx " + name + " > ccx.log 2>&1").c_str());
}

}  // namespace flankwright::calculix
