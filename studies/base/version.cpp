#include "studies/base/version.hpp"

namespace flankwright::studies {

const char* version() { return FLANKWRIGHT_VERSION; }

}  // namespace flankwright::studies
