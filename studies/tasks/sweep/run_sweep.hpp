#pragma once

#include <filesystem>

#include "studies/base/progress.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "studies/tasks/sweep/sweep_store.hpp"

namespace flankwright::studies {

/// Analyses every sample of a sweep's shard that the store does not have yet, in parallel; a sample that fails is kept with its reason.
/// The result of a sample depends on the study and its number alone, not on the threads or on how often the sweep was interrupted.
void run_samples(SweepStore& store, const SweepDesign& design, const SampleAnalysis& analysis, Shard shard, const ProgressReport& progress);

/// The sweep of a nominal result, as far as it is not in the store yet, and its statistics; they enter the result as `sweep`. A share of
/// failed samples is no failure of the sweep, none that succeeds is: a requirement that is not met.
/// @param folder  gets results.sqlite while samples are analysed, samples.csv and the studies of the worst samples after; empty: nothing is kept
void run_sweep(StudyResults& nominal, const std::filesystem::path& folder, const ProgressReport& progress);

/// A shard of it: samples only, no statistics.
void run_sweep_shard(const StudyResults& nominal, const std::filesystem::path& file, Shard shard, const ProgressReport& progress);

}  // namespace flankwright::studies
