#pragma once

#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "studies/compliance/run_cache.hpp"

namespace flankwright::studies {

/// Everything that defines the outcome of a task, in modules, as the key of its stored run.
Json cache_key(const InfluenceTableTask& task);

/// @param run  Factorised
StoredRun to_store(const InfluenceTableRun& run);

/// A run as to_store() writes it.
/// @throws Json::exception, InvalidInput where something is missing
InfluenceTableRun from_store(const InfluenceTableTask& task, const StoredRun& stored);

}  // namespace flankwright::studies
