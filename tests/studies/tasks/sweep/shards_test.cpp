#include "studies/tasks/sweep/shards.hpp"

#include <catch2/catch.hpp>

#include "studies/study_file/study_file.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;
using command_line::Ending;
using command_line::run;
using command_line::ScratchFolder;
using command_line::text_of;
namespace fs = std::filesystem;

const std::vector<SweepOutput> shard_outputs{{"stress", "MPa"}};

Study study() { return parse_study(small::sweep("samples = 17"), "sweep.toml"); }

/// A shard with its samples below `end`.
void write_shard(const fs::path& file, Shard shard, long long end = 17) {
  fs::create_directories(file.parent_path());
  SweepStore store(file, study(), shard_outputs, shard);
  for (long long i = shard.index; i < end; i += shard.count) store.add({i, {1.0, 2.0, 3.0}, {"", {static_cast<double>(i)}}});
  store.commit(1.0);
}

TEST_CASE("Shards are named k/n, counted from 1", "[studies][sweep][shards]") {
  CHECK(parse_shard("3/100") == Shard{2, 100});
  CHECK(parse_shard("1/1") == Shard{0, 1});
  CHECK(shard_file({2, 100}) == fs::path("shards/3-of-100.sqlite"));
  for (const char* text : {"0/3", "4/3", "3", "3/", "/3", "a/3", "1/3x", "-1/3", "1/2000000", ""}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_shard(text), InvalidInput);
  }
}

TEST_CASE("Shards part the samples: each belongs to one, sizes differ by one at most", "[studies][sweep][shards]") {
  for (const long long n : {1, 3, 17, 40}) {
    long long sum = 0;
    for (long long k = 0; k < n; ++k) {
      const Shard shard{k, n};
      long long counted = 0;
      for (long long i = 0; i < 17; ++i) counted += shard.contains(i);
      CHECK(shard.share_of(17) == counted);
      CHECK((counted == 17 / n || counted == 17 / n + 1));
      sum += counted;
    }
    CHECK(sum == 17);
  }
}

TEST_CASE("A merge has every sample of whole shards once, also when it is repeated", "[studies][sweep][shards]") {
  const ScratchFolder folder;
  for (long long k = 0; k < 4; ++k) write_shard(folder.path() / shard_file({k, 4}), {k, 4});
  for (int time = 0; time < 2; ++time) {
    merge_shards(folder.path(), study(), shard_outputs);
    SweepStore whole(folder.path() / "results.sqlite", study(), shard_outputs);
    CHECK(whole.count(1000) == 17);
    for (long long i = 0; i < 17; ++i) CHECK(whole.find(i)->result.outputs[0] == static_cast<double>(i));
  }
}

TEST_CASE("Lost, repeated, unfinished and foreign shards are all named, and nothing is merged", "[studies][sweep][shards]") {
  const ScratchFolder folder;
  const fs::path shards = folder.path() / "shards";
  CHECK_THROWS_WITH(merge_shards(folder.path(), study(), shard_outputs), Contains("the folder of the shards"));
  write_shard(shards / "1-of-4.sqlite", {0, 4});
  write_shard(shards / "3-of-4.sqlite", {2, 4}, 12);
  write_shard(shards / "a copy.sqlite", {0, 4});
  write_shard(shards / "other.sqlite", {1, 5});
  CHECK_THROWS_WITH(merge_shards(folder.path(), study(), shard_outputs), Contains("lost of 4: 2, 4") && Contains("unfinished of 4: 3") &&
                                                                             Contains("shard 1 is repeated, in 1-of-4.sqlite and a copy.sqlite") &&
                                                                             Contains("other.sqlite is a shard of 5, others are of 4"));
  CHECK(!fs::exists(folder.path() / "results.sqlite"));
}

TEST_CASE("A sweep in shards ends with the samples of an unshared one", "[studies][sweep][shards][command-line]") {
  const ScratchFolder folder;
  folder.file("sweep.toml", small::sweep("samples = 40"));
  for (const char* shard : {"2/3", "1/3"}) CHECK(run(folder, {"run", "sweep.toml", "--out", "parts", "--shard", shard}).exit_code == 0);
  const Ending early = run(folder, {"merge", "sweep.toml", "--out", "parts"});
  CHECK(early.exit_code == 2);
  CHECK_THAT(early.err, Contains("lost of 3: 3"));
  CHECK(run(folder, {"run", "sweep.toml", "--out", "parts", "--shard", "3/3", "--threads", "1"}).exit_code == 0);
  CHECK(run(folder, {"merge", "sweep.toml", "--out", "parts"}).exit_code == 0);
  CHECK(run(folder, {"run", "sweep.toml", "--out", "whole"}).exit_code == 0);
  CHECK(text_of(folder.path() / "parts/samples.csv") == text_of(folder.path() / "whole/samples.csv"));
  CHECK(text_of(folder.path() / "parts/sweep_indices.csv") == text_of(folder.path() / "whole/sweep_indices.csv"));

  const Ending wrong = run(folder, {"run", "sweep.toml", "--shard", "4/3"});
  CHECK(wrong.exit_code == 2);
  CHECK_THAT(wrong.err, Contains("--shard"));
  const Ending no_sweep = run(folder, {"run", "sweep.toml", "--shard", "1/3", "--set", "task=analyse", "--set", "sweep.parameters={}"});
  CHECK(no_sweep.exit_code == 2);
}

}  // namespace
}  // namespace flankwright::studies
