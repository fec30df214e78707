#include "studies/tasks/sweep/run_sweep.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/stopwatch.hpp"
#include "studies/tasks/sweep/sweep_statistics.hpp"
#include "studies/tasks/sweep/sweep_tables.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

namespace {

constexpr long long chunk = 4096;  // samples looked up at a time, so that memory does not grow with their number

/// Takes the samples as they are done, from any thread. One thread at a time writes a batch while the others go on.
class SampleWriter {
 public:
  SampleWriter(SweepStore& store, const ProgressReport& progress, long long total, long long done_before)
      : store_(store), progress_(progress), total_(total), done_before_(done_before) {}

  void add(StoredSample sample) {
    {
      const std::lock_guard lock(waiting_mutex_);
      waiting_.push_back(std::move(sample));
    }
    const std::unique_lock writing(store_mutex_, std::try_to_lock);
    if (writing && batch_.seconds() >= std::chrono::duration<double>(SweepStore::commit_interval).count()) write_batch();
  }
  void finish() { write_batch(); }

 private:
  void write_batch() {
    std::vector<StoredSample> batch;
    {
      const std::lock_guard lock(waiting_mutex_);
      batch.swap(waiting_);
    }
    for (const StoredSample& sample : batch) {
      store_.add(sample);
      failed_ += !sample.result.failure.empty();
    }
    done_ += static_cast<long long>(batch.size());
    const double seconds = batch_.seconds();
    batch_ = Stopwatch();
    store_.commit(seconds);
    if (progress_) progress_("samples", in_int(done_before_ + done_), in_int(total_), remark());
  }
  static int in_int(long long count) { return static_cast<int>(std::min<long long>(count, std::numeric_limits<int>::max())); }
  std::string remark() const {
    const double rate = static_cast<double>(done_) / std::max(clock_.seconds(), 1e-9);
    std::string text = fmt::format("{:.3g}/s", rate);
    const long long left = total_ - done_before_ - done_;
    if (left > 0 && rate > 0.0) text += fmt::format(", {:.0f} s left", static_cast<double>(left) / rate);
    if (failed_ > 0) text += fmt::format(", {} failed", failed_);
    return text;
  }

  SweepStore& store_;
  const ProgressReport& progress_;
  long long total_, done_before_, done_{0}, failed_{0};
  std::mutex waiting_mutex_, store_mutex_;  ///< of waiting_; of everything else that changes
  std::vector<StoredSample> waiting_;
  Stopwatch clock_, batch_;
};

}  // namespace

void run_samples(SweepStore& store, const SweepDesign& design, const SampleAnalysis& analysis, Shard shard, const ProgressReport& progress) {
  const long long samples = design.samples();
  SampleWriter writer(store, progress, shard.share_of(samples), store.count(samples));
  for (long long begin = 0; begin < samples; begin += chunk) {
    const long long end = std::min(begin + chunk, samples);
    const std::vector<bool> present = store.present(begin, end);
    std::vector<long long> missing;
    for (long long id = begin; id < end; ++id) {
      if (shard.contains(id) && !present[static_cast<std::size_t>(id - begin)]) missing.push_back(id);
    }
    tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t k) {
      StoredSample sample{missing[k], design.values(missing[k]), {}};
      // A thread that waits inside a sample shall not begin another one there.
      tbb::this_task_arena::isolate([&] { sample.result = analysis.analyse(sample.values); });
      writer.add(std::move(sample));
    });
  }
  writer.finish();
}

void run_sweep(StudyResults& nominal, const std::filesystem::path& folder, const ProgressReport& progress) {
  const Stopwatch clock;
  const Study& study = nominal.study;
  const SampleAnalysis analysis(nominal);
  const SweepDesign design(study.table<SweepTable>());
  SweepStore store(folder.empty() ? ":memory:" : folder / "results.sqlite", study, analysis.outputs());
  run_samples(store, design, analysis, {}, progress);
  auto statistics = std::make_shared<SweepStatistics>(sweep_statistics(store, design, analysis.outputs()));
  statistics->seconds = store.seconds();
  if (statistics->failed == statistics->samples) {
    nominal.requirements.push_back("every sample of the sweep failed: " + statistics->failures.front().reason);
  }
  if (const std::string warning = index_warning(*statistics); !warning.empty()) nominal.notes.push_back(warning);
  nominal.set_found<SweepStatistics>(statistics);
  if (!folder.empty()) write_sweep_files(nominal, folder, store);
  nominal.seconds += clock.seconds();
  nominal.steps.push_back({"samples", "analyses, statistics and files of all samples", clock.seconds()});
}

void run_sweep_shard(const StudyResults& nominal, const std::filesystem::path& file, Shard shard, const ProgressReport& progress) {
  const SampleAnalysis analysis(nominal);
  SweepStore store(file, nominal.study, analysis.outputs(), shard);
  run_samples(store, SweepDesign(nominal.study.table<SweepTable>()), analysis, shard, progress);
}

}  // namespace flankwright::studies
