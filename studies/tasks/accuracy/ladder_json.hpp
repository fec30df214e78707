#pragma once

#include "studies/base/json_format.hpp"
#include "studies/tasks/accuracy/ladder.hpp"

namespace flankwright::studies {

/// Section `accuracy` of results.json: every level beside the finest; see results.md.
Json ladder_json(const Ladder& ladder);

}  // namespace flankwright::studies
