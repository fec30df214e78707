#pragma once

namespace flankwright::studies {

/// Version of the program, "0.1.0".
const char* version();

}  // namespace flankwright::studies
