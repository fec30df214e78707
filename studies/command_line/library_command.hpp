#pragma once

#include <string>

namespace flankwright::studies {

/// Makes the library of fits that comes with the program: solves the finite elements of each of its gears by a fine and
/// a coarse mesh, fits the difference, and writes the file anew after every few. Goes on where a file made with the
/// same meshes ends. Apart from its times the result does not depend on the threads.
/// @return exit code: 1 where a fit did not converge
/// @throws InvalidInput where the file is no library, or one made with other meshes
int library_command(const std::string& path);

}  // namespace flankwright::studies
