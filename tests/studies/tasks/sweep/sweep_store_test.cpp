#include "studies/tasks/sweep/sweep_store.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cstring>
#include <fstream>

#include "studies/study_file/study_file.hpp"
#include "tests/common/random.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/small_file_limit.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;
using command_line::ScratchFolder;
using command_line::text_of;

const std::vector<SweepOutput> stored_outputs{{"stress", "MPa"}};

Study study_with(const std::vector<Override>& overrides = {}) { return parse_study(small::sweep("samples = 100"), "sweep.toml", overrides); }

StoredSample sample(long long id) { return {id, {0.1 * static_cast<double>(id), 2.0, 3.0}, {"", {1.0 / 3.0 + static_cast<double>(id)}}}; }

void fill(SweepStore& store, long long begin, long long end) {
  for (long long i = begin; i < end; ++i) store.add(sample(i));
  store.commit(0.5);
}

TEST_CASE("A store gives back what was put in, bit for bit, and goes on where it ended", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "results.sqlite";
  {
    SweepStore store(file, study_with(), stored_outputs);
    fill(store, 0, 10);
    store.add({20, {1.0, 2.0, 3.0}, {"it failed, \"badly\"", {}}});
    store.commit(0.25);
  }
  SweepStore store(file, study_with(), stored_outputs);
  CHECK(store.count(100) == 11);
  CHECK(store.count(5) == 5);
  CHECK(store.seconds() == 0.75);
  const std::vector<bool> present = store.present(5, 25);
  CHECK((present[0] && present[4] && !present[5] && present[15]));
  const StoredSample third = *store.find(3);
  CHECK(third.values == sample(3).values);
  CHECK(third.result.outputs == sample(3).result.outputs);
  CHECK(store.find(20)->result.failure == "it failed, \"badly\"");
  CHECK(!store.find(21));
}

TEST_CASE("Uncommitted samples are lost, committed ones are not", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "results.sqlite";
  {
    SweepStore store(file, study_with(), stored_outputs);
    fill(store, 0, 10);
    store.add(sample(10));
  }
  CHECK(SweepStore(file, study_with(), stored_outputs).count(100) == 10);
}

TEST_CASE("A store in use is refused to others and free again afterwards", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "results.sqlite";
  {
    SweepStore store(file, study_with(), stored_outputs);
    CHECK_THROWS_WITH(SweepStore(file, study_with(), stored_outputs), Contains("a store that no other run is using"));
    fill(store, 0, 10);
    CHECK_THROWS_WITH(SweepStore(file, study_with(), stored_outputs), Contains("a store that no other run is using"));
  }
  CHECK(SweepStore(file, study_with(), stored_outputs).count(100) == 10);
}

TEST_CASE("A store of another study is refused by the setting that differs", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "results.sqlite";
  { SweepStore store(file, study_with(), stored_outputs); }
  CHECK_THROWS_WITH(SweepStore(file, study_with({{"sweep.seed", "2"}}), stored_outputs),
                    Contains("sweep.seed is not given in the study of the store and 2 here"));
  CHECK_THROWS_WITH(SweepStore(file, study_with({{"load.torque", "900"}}), stored_outputs),
                    Contains("load.torque is 1014.868 in the study of the store and 900 here"));
  CHECK_THROWS_WITH(SweepStore(file, study_with(), stored_outputs, {1, 2}), Contains("the shard is 1/1 in the study of the store and 2/2 here"));
  CHECK_NOTHROW(SweepStore(file, study_with({{"title", "\"another\""}}), stored_outputs));
  CHECK_NOTHROW(SweepStore(file, study_with({{"sweep.samples", "200"}}), stored_outputs));  // Sobol: the beginning is the same
}

TEST_CASE("With a Latin hypercube more samples are other samples", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "results.sqlite";
  const Override sampler{"sweep.sampler", "latin_hypercube"};
  { SweepStore store(file, study_with({sampler}), stored_outputs); }
  CHECK_THROWS_WITH(SweepStore(file, study_with({sampler, {"sweep.samples", "200"}}), stored_outputs),
                    Contains("sweep.samples is 100 in the study of the store and 200 here"));
}

TEST_CASE("A measured grid with other contents is another study", "[studies][sweep][store]") {
  Study study = study_with();
  const ScratchFolder folder;
  study.file = (folder.path() / "sweep.toml").string();
  study.grid.pinion.file = "flank.csv";
  folder.file("flank.csv", "a");
  const auto file = folder.path() / "results.sqlite";
  { SweepStore store(file, study, stored_outputs); }
  CHECK_NOTHROW(SweepStore(file, study, stored_outputs));
  folder.file("flank.csv", "b");
  CHECK_THROWS_WITH(SweepStore(file, study, stored_outputs), Contains("contents of pinion.modification.grid"));
}

TEST_CASE("A file that is no store, or a damaged one, is refused in one line and left as it is", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& name, const std::string& contents, const std::string& said) {
    const std::string file = folder.file(name, contents);
    CAPTURE(name);
    try {
      SweepStore store(file, study_with(), stored_outputs);
      FAIL("not refused");
    } catch (const InvalidInput& problem) {
      CHECK_THAT(problem.what(), Contains(said));
      CHECK(std::string(problem.what()).find('\n') == std::string::npos);
    }
    CHECK(text_of(file) == contents);
  };
  refused("text", std::string(5000, 'x'), "an undamaged store");
  const auto file = folder.path() / "results.sqlite";
  {
    SweepStore store(file, study_with(), stored_outputs);
    fill(store, 0, 2000);
  }
  const std::string whole = text_of(file);
  refused("cut", whole.substr(0, whole.size() / 2), "an undamaged store");
  tests::Random32 random(5);
  std::string scratched = whole;
  for (std::size_t k = 4096; k < scratched.size(); ++k) scratched[k] = static_cast<char>(random.below(256));
  refused("scratched", scratched, "an undamaged store");
  const auto foreign = folder.path() / "foreign";
  { Database(foreign).execute("CREATE TABLE run (key, value)"); }
  refused("foreign2", text_of(foreign), "the file is no store of a sweep");
}

TEST_CASE("A store with a single bit flipped is refused or gives back the same samples", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "results.sqlite";
  {
    SweepStore store(file, study_with(), stored_outputs);
    fill(store, 0, 40);
    store.add({60, {1.0, 2.0, 3.0}, {"it failed", {}}});
    fill(store, 40, 60);
  }
  const auto contents = [](const std::string& name) {
    SweepStore store(name, study_with(), stored_outputs);
    std::vector<double> all{store.seconds(), static_cast<double>(store.count(1000))};
    store.for_each(1000, [&](const StoredSample& s) {
      all.push_back(static_cast<double>(s.id));
      all.insert(all.end(), s.values.begin(), s.values.end());
      all.insert(all.end(), s.result.outputs.begin(), s.result.outputs.end());
      all.push_back(static_cast<double>(s.result.failure.size()));
    });
    return all;
  };
  const std::vector<double> truth = contents(file.string());
  const std::string whole = text_of(file);
  tests::Random32 random(11);
  int refused = 0, same = 0;
  for (int run = 0; run < 400; ++run) {
    std::string flipped = whole;
    const std::size_t at = random.below(whole.size());
    const std::size_t bit = random.below(8);
    flipped[at] = static_cast<char>(flipped[at] ^ (1U << bit));
    const std::string name = folder.file("flipped", flipped);
    CAPTURE(at, bit);
    try {
      const std::vector<double> found = contents(name);
      CHECK(found == truth);
      ++same;
    } catch (const InvalidInput& problem) {
      CHECK(std::string(problem.what()).find('\n') == std::string::npos);
      ++refused;
    }
  }
  // Most of the pages of so small a store are empty.
  CHECK(refused > 40);
  CHECK(same > 40);
  // A bit of a stored output: the page is sound, the number is not.
  const double stored = sample(17).result.outputs[0];
  std::string bytes(sizeof stored, '\0');
  std::memcpy(bytes.data(), &stored, sizeof stored);
  std::ranges::reverse(bytes);  // SQLite's order
  const std::size_t at = whole.find(bytes);
  REQUIRE(at != std::string::npos);
  std::string flipped = whole;
  flipped[at + 3] = static_cast<char>(flipped[at + 3] ^ 4);
  CHECK_THROWS_WITH(contents(folder.file("number", flipped)), Contains("the samples of batch 1 are not what was written: checksum"));
}

TEST_CASE("A disk that fills up ends a run in one line and leaves what was committed", "[studies][sweep][store]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "results.sqlite";
  {
    SweepStore store(file, study_with(), stored_outputs);
    fill(store, 0, 500);
    const SmallFileLimit full(static_cast<rlim_t>(std::filesystem::file_size(file) + 20'000));
    CHECK_THROWS_WITH(
        [&] {
          for (long long i = 500; i < 100'000; i += 500) fill(store, i, i + 500);
        }(),
        Contains("a place that can be written"));
  }
  SweepStore store(file, study_with(), stored_outputs);
  const long long count = store.count(1'000'000);
  CHECK(count >= 500);
  CHECK(count % 500 == 0);  // whole batches
  fill(store, count, count + 500);
  CHECK(store.find(count + 499)->values == sample(count + 499).values);
}

TEST_CASE("A folder that cannot be written is refused in one line", "[studies][sweep][store]") {
  const ScratchFolder folder;
  folder.file("plain", "no folder");
  CHECK_THROWS_WITH(SweepStore(folder.path() / "plain" / "results.sqlite", study_with(), stored_outputs), Contains("a place that can be written"));
  CHECK_THROWS_WITH(SweepStore(folder.path() / "missing" / "results.sqlite", study_with(), stored_outputs), Contains("a place that can be written"));
  CHECK_THROWS_WITH(SweepStore("/proc/results.sqlite", study_with(), stored_outputs),
                    Contains("a place that can be written"));  // read-only, even to root
}

}  // namespace
}  // namespace flankwright::studies
