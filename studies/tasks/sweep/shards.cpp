#include "studies/tasks/sweep/shards.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

constexpr long long most_shards = 1'000'000;

/// The stores of the shards by their index.
using ShardFiles = std::map<long long, fs::path>;

/// What is wrong with the shards, a part of a sentence each.
struct Complaints {
  std::vector<std::string> parts;
  void add(const std::string& part) { parts.push_back(part); }
};

std::vector<fs::path> stores_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".sqlite") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// "4, 7 and 9"; after the first ten "and 32 more".
std::string enumerated(const std::vector<long long>& numbers) {
  constexpr std::size_t most = 10;
  std::string text;
  const std::size_t shown = std::min(numbers.size(), most);
  for (std::size_t k = 0; k < shown; ++k) text += fmt::format("{}{}", k == 0 ? "" : ", ", numbers[k]);
  return numbers.size() > shown ? text + fmt::format(" and {} more", numbers.size() - shown) : text;
}

ShardFiles find_shards(const std::vector<fs::path>& files, long long& count, Complaints& complaints) {
  ShardFiles shards;
  for (const fs::path& file : files) {
    const Shard shard = SweepStore::shard_of(file);
    if (count == 0) count = shard.count;
    if (shard.count != count) {
      complaints.add(fmt::format("{} is a shard of {}, others are of {}", file.filename().string(), shard.count, count));
    } else if (const auto [first, is_new] = shards.emplace(shard.index, file); !is_new) {
      complaints.add(fmt::format("shard {} is repeated, in {} and {}", shard.index + 1, first->second.filename().string(), file.filename().string()));
    }
  }
  return shards;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard{0, 0};
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = has_slash ? std::from_chars(first.ptr + 1, end, shard.count) : first;
  const bool is_whole = has_slash && second.ec == std::errc{} && second.ptr == end;
  if (!is_whole || shard.index < 1 || shard.index > shard.count || shard.count > most_shards) {
    throw InvalidInput("--shard", text, "k/n with 1 <= k <= n <= 1000000, as 3/100");
  }
  return {shard.index - 1, shard.count};
}

fs::path shard_file(Shard shard) { return fs::path("shards") / fmt::format("{}-of-{}.sqlite", shard.index + 1, shard.count); }

void merge_shards(const fs::path& folder, const Study& study, const std::vector<SweepOutput>& outputs) {
  Complaints complaints;
  const std::vector<fs::path> files = stores_in(folder / "shards");
  if (files.empty()) throw InvalidInput("shards", (folder / "shards").string(), "the folder of the shards that `run --shard k/n` left");
  long long count = 0;
  const ShardFiles shards = find_shards(files, count, complaints);
  std::vector<long long> lost, unfinished;
  for (long long k = 0; k < count; ++k) {
    if (!shards.contains(k)) lost.push_back(k + 1);
  }
  for (const auto& [index, file] : shards) {
    const Shard shard{index, count};
    SweepStore store(file, study, outputs, shard);
    if (store.count(study.table<SweepTable>().samples) != shard.share_of(study.table<SweepTable>().samples)) unfinished.push_back(index + 1);
  }
  if (!lost.empty()) complaints.add(fmt::format("lost of {}: {}", count, enumerated(lost)));
  if (!unfinished.empty()) complaints.add(fmt::format("unfinished of {}: {}", count, enumerated(unfinished)));
  if (!complaints.parts.empty()) {
    std::string all;
    for (const std::string& part : complaints.parts) all += (all.empty() ? "" : "; ") + part;
    throw InvalidInput("shards", all, "every shard once, run to its end with --shard k/n");
  }
  SweepStore whole(folder / "results.sqlite", study, outputs);
  for (const auto& [index, file] : shards) {
    SweepStore store(file, study, outputs, {index, count});
    store.for_each(study.table<SweepTable>().samples, [&](const StoredSample& sample) {
      if (!whole.present(sample.id, sample.id + 1).front()) whole.add(sample);
    });
    whole.commit(store.seconds());
  }
}

}  // namespace flankwright::studies
