#pragma once

#include <filesystem>
#include <string>

#include "studies/tasks/sweep/sweep_store.hpp"

namespace flankwright::studies {

/// "3/100" as the command line counts shards, from 1.
/// @throws InvalidInput "--shard" unless 1 <= k <= n <= 1000000
Shard parse_shard(const std::string& text);

/// Where a shard of a sweep lies below the results folder: "shards/3-of-100.sqlite".
std::filesystem::path shard_file(Shard shard);

/// Puts the samples of all shards in the folder into its results.sqlite. Nothing is written unless every shard is there once and whole.
/// @throws InvalidInput "shards", naming all that are lost, repeated, unfinished or of another division; what SweepStore refuses
void merge_shards(const std::filesystem::path& folder, const Study& study, const std::vector<SweepOutput>& outputs);

}  // namespace flankwright::studies
