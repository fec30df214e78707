#pragma once

#include <string_view>

namespace flankwright {

/// `library/teeth.txt`, embedded when the program is built.
extern const std::string_view shipped_corrections;

}  // namespace flankwright
