#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/base/database.hpp"
#include "studies/tasks/sweep/sample_analysis.hpp"

namespace flankwright::studies {

/// Which part of a sweep's samples: those whose number leaves `index` when divided by `count`.
struct Shard {
  long long index{0}, count{1};
  bool contains(long long sample) const { return sample % count == index; }
  /// How many of so many samples it has.
  long long share_of(long long samples) const { return index < samples ? (samples - index + count - 1) / count : 0; }
  bool operator==(const Shard&) const = default;
};

/// A sample as stored.
struct StoredSample {
  long long id{0};
  std::vector<double> values;  ///< of the parameters
  SampleResult result;         ///< NaN for an output without a value
};

/// The samples of a sweep in an SQLite file, written while it runs. Tables: README.md of this folder.
///
/// While it is open no other process can use the file. What is added is committed at least every commit_interval: whatever ends the process
/// loses the samples since then, never older ones, and the next run goes on from there. What is committed together has a checksum, which is
/// compared when the file is opened again: a bit that changed on the disk is noticed.
class SweepStore {
 public:
  static constexpr std::chrono::milliseconds commit_interval{250};

  /// Opens a sweep's store, or makes it.
  /// @param file     ":memory:" for one that is not kept
  /// @param study    of the task Sweep; a file of another study is refused, naming the first setting that differs. With Sobol and Monte
  ///                 Carlo samples their number may differ: the smaller sweep is the beginning of the larger
  /// @throws InvalidInput "output folder" where the file is in use, damaged, foreign or cannot be written; it is then left as it was
  SweepStore(const std::filesystem::path& file, const Study& study, const std::vector<SweepOutput>& outputs, Shard shard = {});
  ~SweepStore();
  SweepStore(const SweepStore&) = delete;
  SweepStore& operator=(const SweepStore&) = delete;

  /// Which shard an existing store is of. Throws as opening does.
  static Shard shard_of(const std::filesystem::path& file);

  /// Adds a sample.
  void add(const StoredSample& sample);
  /// Ends the batch.
  /// @param seconds  of computing since the last call, added to seconds()
  void commit(double seconds);

  double seconds();  ///< spent on computing, over all runs
  /// Samples below `end`.
  long long count(long long end);
  /// Which of the samples begin .. end - 1 are there.
  std::vector<bool> present(long long begin, long long end);
  /// Visits the samples below `end` in the order of their numbers.
  void for_each(long long end, const std::function<void(const StoredSample&)>& visit);
  std::optional<StoredSample> find(long long id);
  /// Visits one output of all samples below `end` that have it, in ascending order.
  void for_each_sorted(std::size_t output, long long end, const std::function<void(double)>& visit);

 private:
  void create(const Study& study, Shard shard);
  void check_same(const Study& study, Shard shard);
  void check_samples();
  StoredSample sample_at(const Statement& row) const;

  Database database_;
  std::vector<std::string> parameter_columns_, output_columns_;
  std::optional<Statement> insert_;

  /// Samples committed together. Their fingerprints are added up, so that the order in which they were done does not matter.
  struct Batch {
    long long samples{0};
    std::uint64_t sum{0};
    void add(std::uint64_t fingerprint) {
      ++samples;
      sum += fingerprint;
    }
    long long checksum(long long id, double seconds) const;
  };
  std::optional<Batch> batch_;  ///< that is being written
  long long batch_id_{0};
};

/// The settings that decide what the samples of a study are: its keys but for titles, [expect] and what may be extended, the contents of
/// measured grids, and the program's version.
std::vector<GivenValue> deciding_settings(const Study& study);

}  // namespace flankwright::studies
