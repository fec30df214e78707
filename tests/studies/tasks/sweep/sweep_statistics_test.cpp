#include "studies/tasks/sweep/sweep_statistics.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "studies/study_file/study_file.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"
#include "tests/common/about.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {
namespace {

/// Statistics of given outputs at the samples of a study's design.
template <class Function>
SweepStatistics statistics_of(const Study& study, const Function& outputs_at) {
  const std::vector<SweepOutput> outputs{{"sum", "-"}, {"stiffness", "-", true}};
  const SweepDesign design(study.table<SweepTable>());
  SweepStore store(":memory:", study, outputs);
  for (long long i = design.samples(); i-- > 0;) {  // in any order
    const std::vector<double> values = design.values(i);
    store.add({i, values, outputs_at(i, values)});
  }
  store.commit(1.0);
  return sweep_statistics(store, design, outputs);
}

TEST_CASE("Statistics of counted samples are their closed forms", "[studies][sweep]") {
  const Study study = parse_study(small::sweep("samples = 101\nindices = \"off\""), "s.toml");
  const auto statistics = statistics_of(study, [](long long i, const auto&) {
    return SampleResult{"", {static_cast<double>((37 * i) % 101), 5.0 - 0.01 * static_cast<double>(i)}};  // 0 .. 100, shuffled
  });
  const OutputStatistics& of = statistics.outputs[0];
  CHECK(statistics.samples == 101);
  CHECK(of.count == 101);
  CHECK(of.mean == Approx(50.0).epsilon(1e-14));
  CHECK(of.deviation == Approx(std::sqrt(101.0 * 102.0 / 12.0)).epsilon(1e-14));
  for (std::size_t k = 0; k < quantile_shares.size(); ++k) CHECK(of.quantiles[k] == Approx(100.0 * quantile_shares[k]).epsilon(1e-13));
  CHECK((37 * of.worst) % 101 == 100);
  CHECK(statistics.outputs[1].worst == 100);  // stiffness: the smallest is the worst
  CHECK(statistics.worst[0].id == of.worst);
  long long counted = 0;
  for (const long long count : of.histogram.counts) counted += count;
  CHECK(counted == 101);
  CHECK(of.indices.empty());
}

TEST_CASE("Levels of a grid have a cell each in a map, however far apart they are", "[studies][sweep]") {
  const Study study = parse_study(
      small::sweep("sampler = \"grid\"\nindices = \"off\""), "s.toml",
      {{"sweep.parameters", "{ \"misalignment.mesh_misalignment\" = { values = [10, 0, 3] }, \"load.torque\" = { values = [800, 900] } }"}});
  const auto statistics = statistics_of(study, [](long long, const auto& v) { return SampleResult{"", {v[0] + 1e-2 * v[1], 1.0}}; });
  const std::size_t torque = study.table<SweepTable>().parameters[0].path == "load.torque" ? 0 : 1, misalignment = 1 - torque;
  CHECK(statistics.parameters[misalignment].levels == std::vector<double>{0.0, 3.0, 10.0});
  CHECK(statistics.parameters[misalignment].counts == std::vector<long long>{2, 2, 2});
  const auto map = std::ranges::find(statistics.maps, std::size_t{0}, &ResponseMap::output);
  REQUIRE(map != statistics.maps.end());
  constexpr double levels[] = {0.0, 3.0, 10.0}, torques[] = {800.0, 900.0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double expected = torque == 0 ? torques[k] + 1e-2 * levels[i] : levels[i] + 1e-2 * torques[k];
      CHECK(map->mean(torque == 0 ? k : i, torque == 0 ? i : k) == Approx(expected).epsilon(1e-14));
    }
  }
}

TEST_CASE("A linear output gives each parameter its share of the variance, and a map that is a plane", "[studies][sweep]") {
  const Study study = parse_study(small::sweep("samples = 20480\nseed = 3"), "s.toml");  // 4096 blocks
  // Torque (deviation 400/sqrt(12)), crowning (8/sqrt(12)) and misalignment (6), weighted to variances 1, 4 and 0.
  const auto linear = [](const std::vector<double>& v) {
    return (v[0] - 1000.0) / 400.0 * std::sqrt(12.0) + 2.0 * (v[2] - 8.0) / 8.0 * std::sqrt(12.0);
  };
  REQUIRE(study.table<SweepTable>().parameters[0].path == "load.torque");
  REQUIRE(study.table<SweepTable>().parameters[2].path == "pinion.modification.lead_crowning");
  const auto statistics = statistics_of(study, [&](long long, const auto& v) { return SampleResult{"", {linear(v), 1.0}}; });
  CHECK(statistics.blocks == 4096);
  const OutputStatistics& of = statistics.outputs[0];
  CHECK(of.deviation == Approx(std::sqrt(5.0)).epsilon(0.01));
  const double share[] = {0.2, 0.0, 0.8};
  for (std::size_t j = 0; j < 3; ++j) {
    CHECK(of.indices[j].first == tests::about(share[j], 0.02));
    CHECK(of.indices[j].total == tests::about(share[j], 0.02));
  }
  CHECK(index_warning(statistics).empty());
  CHECK(of.indices[1].total == 0.0);                          // exactly: it does not enter
  CHECK(std::isnan(statistics.outputs[1].indices[0].first));  // does not vary
  const ResponseMap* map = nullptr;
  for (const ResponseMap& m : statistics.maps) {
    if (m.output == 0 && m.x == 0 && m.y == 2) map = &m;
  }
  REQUIRE(map != nullptr);
  // The mean over a part is the value at its middle, within how far the samples' mean lies from it.
  const std::size_t n = map->columns;
  for (std::size_t ix = 0; ix < n; ++ix) {
    const double x = 800.0 + 400.0 * (static_cast<double>(ix) + 0.5) / static_cast<double>(n);
    CHECK(map->mean(ix, 0) == tests::about(linear({x, 0.0, 4.0 + 4.0 / static_cast<double>(n)}), 0.1));
  }
}

TEST_CASE("Failed samples are counted with their reasons and kept out of the statistics and their blocks", "[studies][sweep]") {
  const Study study = parse_study(small::sweep("samples = 50"), "s.toml");  // 10 blocks of 5
  const auto statistics = statistics_of(study, [](long long i, const auto& v) {
    if (i == 7) return SampleResult{"no contact", {}};
    return SampleResult{i == 21 || i == 22 ? "jammed" : "", i == 21 || i == 22 ? std::vector<double>{} : std::vector<double>{v[0], NAN}};
  });
  CHECK(statistics.samples == 50);
  CHECK(statistics.failed == 3);
  REQUIRE(statistics.failures.size() == 2);
  CHECK(statistics.failures[0].reason == "jammed");
  CHECK(statistics.failures[0].count == 2);
  CHECK(statistics.failures[0].first == 21);
  CHECK(statistics.outputs[0].count == 47);
  CHECK(statistics.outputs[1].count == 0);
  CHECK(std::isnan(statistics.outputs[1].mean));
  CHECK(statistics.outputs[1].worst == -1);
  CHECK(statistics.blocks == 8);
}

TEST_CASE("Sobol indices of few blocks come with their confidence and a warning", "[studies][sweep]") {
  const auto of_blocks = [](int blocks) {
    const Study study = parse_study(small::sweep("samples = " + std::to_string(5 * blocks)), "s.toml");
    return statistics_of(study, [](long long, const auto& v) { return SampleResult{"", {v[0] / 100.0 + v[2], 1.0}}; });
  };
  const SweepStatistics few = of_blocks(10), many = of_blocks(4096);
  CHECK_THAT(index_warning(few), Catch::Contains("The Sobol indices come from 10 blocks and are uncertain by up to"));
  CHECK(index_warning(many).empty());
  // Independent blocks: the standard error falls with the root of their number; Sobol's points lie somewhat more evenly.
  const double ratio = few.outputs[0].indices[0].total_error / many.outputs[0].indices[0].total_error;
  CHECK(ratio == Approx(std::sqrt(409.6)).epsilon(0.5));         // statistical: the error of ten blocks is uncertain itself
  CHECK(index_confidence(0.1) == Approx(0.196).epsilon(1e-14));  // round-off
  const Study still = parse_study(small::sweep("samples = 50"), "s.toml");
  CHECK_THAT(index_warning(statistics_of(still,
                                         [](long long, const auto&) {
                                           return SampleResult{"", {2.0, 1.0}};
                                         })),
             Catch::Contains("No output scatters"));
  const Study plain = parse_study(small::sweep("samples = 40\nindices = \"off\""), "s.toml");
  CHECK(index_warning(statistics_of(plain, [](long long, const auto& v) { return SampleResult{"", {v[0], 1.0}}; })).empty());
}

}  // namespace
}  // namespace flankwright::studies
