#include "studies/base/json_format.hpp"

template class nlohmann::basic_json<nlohmann::ordered_map>;
