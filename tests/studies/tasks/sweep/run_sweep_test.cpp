#include "studies/tasks/sweep/run_sweep.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "studies/study_file/study_file.hpp"
#include "studies/tasks/sweep/sweep_statistics.hpp"
#include "studies/tasks/sweep/worst_study.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {
namespace {

Study sweep_study(const std::string& settings, const std::string& more = "", const std::vector<Override>& overrides = {}) {
  return parse_study(small::sweep(settings, more), "sweep.toml", overrides);
}

/// All samples of a study's shard.
std::vector<StoredSample> samples_of(const Study& study, Shard shard = {}) {
  const StudyResults nominal = run_study(study);
  const SampleAnalysis analysis(nominal);
  SweepStore store(":memory:", study, analysis.outputs(), shard);
  run_samples(store, SweepDesign(study.table<SweepTable>()), analysis, shard, {});
  std::vector<StoredSample> samples;
  store.for_each(study.table<SweepTable>().samples, [&](const StoredSample& sample) { samples.push_back(sample); });
  return samples;
}

TEST_CASE("A sample of a sweep is the analysis of its own study, bit for bit", "[studies][sweep]") {
  // Everything that is zero in the study itself: its effect must be on for the samples all the same.
  const bool is_ground = GENERATE(false, true);  // or what the machine takes out of the twist that it grinds
  const std::string errors = "\"wheel.error\" = { iso_1328_class = 7 }\n\"misalignment.axial_offset\" = { uniform = [0, 3] }\n";
  const std::string twist = "\"pinion.twist_compensation\" = { uniform = [0, 1] }\n";
  const std::vector<Override> grinding{{"pinion.process", "generating_grinding"}};
  const Study study = sweep_study("samples = 24", is_ground ? twist : errors, is_ground ? grinding : std::vector<Override>{});
  const std::vector<StoredSample> samples = samples_of(study);
  REQUIRE(samples.size() == 24);
  const StudyResults nominal = run_study(study);
  const auto outputs = SampleAnalysis(nominal).outputs();
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{23}}) {
    const StoredSample& sample = samples[i];
    REQUIRE(sample.result.failure.empty());
    const Study alone = parse_study(sample_study(study, "one", sample.values), "one.toml", {{"cycle.peaks", "sampled"}});
    CHECK(alone.task == &find_task("analyse"));
    const StudyResults results = run_study(alone);
    const CycleSummary& summary = results.loaded.at(0).summary;
    std::size_t found = 0;
    for (const CycleEntry& entry : cycle_entries()) {
      for (std::size_t k = 0; k < outputs.size(); ++k) {
        if (outputs[k].name != entry.key()) continue;
        CAPTURE(entry.key());
        CHECK(sample.result.outputs[k] == entry.value(summary));
        ++found;
      }
    }
    CHECK(found >= 8);  // transmission error, stress, load, stiffness
  }
  CHECK(samples[0].result.outputs[0] != samples[3].result.outputs[0]);
}

TEST_CASE("A sample whose axes are so far apart that no teeth meet has no outputs", "[studies][sweep]") {
  // m_n = 10 mm: the tips overlap by some 20 mm, so that 30 mm leave air.
  const std::vector<Override> apart{{"sweep.parameters", "{ \"misalignment.centre_distance\" = { values = [0, 0.1, 30] } }"}};
  const std::vector<StoredSample> samples = samples_of(sweep_study("sampler = \"grid\"\nindices = \"off\"", "", apart));
  REQUIRE(samples.size() == 3);
  CHECK(samples[0].result.failure.empty());
  CHECK(samples[1].result.failure.empty());
  CHECK_THAT(samples[2].result.failure, Catch::Contains("misalignment.centre_distance") && Catch::Contains("total contact ratio of at least 1"));
}

TEST_CASE("A sample under a load spectrum has the worst of its loads and the damage of their sum", "[studies][sweep][life]") {
  const std::string spectrum =
      "{ spectrum = [{ torque = 600, cycles = 1e8 }, { torque = 0, cycles = 1e9 }, { torque = 1000, cycles = 1e6, mesh_misalignment = 4 }] }";
  const std::vector<Override> life{{"load", spectrum},
                                   {"material.contact_endurance_limit", "500"},
                                   {"sweep.parameters", "{ \"misalignment.mesh_misalignment\" = { normal = [0, 6] } }"}};
  const Study study = sweep_study("samples = 4\nindices = \"off\"", "", life);
  const std::vector<StoredSample> samples = samples_of(study);
  const auto outputs = SampleAnalysis(run_study(study)).outputs();
  const auto of = [&](const StoredSample& sample, const std::string& name) {
    const auto at = std::ranges::find(outputs, name, &SweepOutput::name);
    REQUIRE(at != outputs.end());
    return sample.result.outputs[static_cast<std::size_t>(at - outputs.begin())];
  };
  CHECK(std::ranges::find(outputs, "pinion_root_damage", &SweepOutput::name) == outputs.end());  // no root stress, no limit
  for (const StoredSample& sample : samples) {
    REQUIRE(sample.result.failure.empty());
    const StudyResults alone = run_study(parse_study(sample_study(study, "one", sample.values), "one.toml", {{"cycle.peaks", "sampled"}}));
    REQUIRE(alone.loaded.size() == 2);
    const CycleSummary &light = alone.loaded[0].summary, &heavy = alone.loaded[1].summary;
    CHECK(of(sample, "peak_contact_stress_MPa") == std::max(light.peak_contact_stress, heavy.peak_contact_stress));
    CHECK(of(sample, "mean_stiffness_N_per_mm_um") == Approx(std::min(light.mean_stiffness, heavy.mean_stiffness)).epsilon(1e-12));
    CHECK(of(sample, "pinion_contact_damage") == alone.life->spectra.at(0).contact.pinion->damage);
    CHECK(of(sample, "wheel_contact_damage") == alone.life->spectra.at(0).contact.wheel->damage);
    const auto least = [](const CaseLife& c) { return std::min(c.contact_safety.pinion, c.contact_safety.wheel); };
    CHECK(of(sample, "contact_safety") == std::min(least(alone.life->cases[0]), least(alone.life->cases[1])));
  }
  CHECK(of(samples[0], "pinion_contact_damage") != of(samples[1], "pinion_contact_damage"));
}

TEST_CASE("Samples have the loss, film and safety that the analysis of their own study has", "[studies][sweep][life]") {
  const bool varies_speed = GENERATE(false, true);
  const std::vector<Override> life{
      {varies_speed ? "sweep.parameters" : "load.speed", varies_speed ? "{ \"load.speed\" = { uniform = [500, 2000] } }" : "1000"},
      {"material.contact_endurance_limit", "1500"},
      {"lubricant.viscosity_40", "220"},
      {"lubricant.viscosity_100", "19"},
      {"lubricant.temperature", "80"},
      {"lubricant.roughness", "0.5"},
      {"lubricant.permissible_film", "0.2"}};
  const Study study = sweep_study("samples = 4\nindices = \"off\"", "", life);
  const std::vector<StoredSample> samples = samples_of(study);
  const auto outputs = SampleAnalysis(run_study(study)).outputs();
  const auto value = [&](const StoredSample& sample, const char* name) {
    const auto found = std::ranges::find(outputs, name, &SweepOutput::name);
    REQUIRE(found != outputs.end());
    return sample.result.outputs[static_cast<std::size_t>(found - outputs.begin())];
  };
  REQUIRE(samples.size() == 4);
  if (varies_speed) CHECK(value(samples[0], "flash_temperature_K") != value(samples[1], "flash_temperature_K"));
  double power_by_speed = 0;
  for (const StoredSample& sample : samples) {
    REQUIRE(sample.result.failure.empty());
    const StudyResults alone = run_study(parse_study(sample_study(study, "one", sample.values), "one.toml", {{"cycle.peaks", "sampled"}}));
    const CaseLife& of = alone.life.value().cases.at(0);
    if (power_by_speed == 0) power_by_speed = of.power / sample.values.at(0);
    CHECK(value(sample, "loss_factor") == of.loss_factor);
    CHECK(value(sample, "loss_power_W") == of.loss_power);
    CHECK(value(sample, "micropitting_safety") == of.micropitting_safety);
    CHECK(value(sample, "flash_temperature_K") == of.flash_temperature);
    CHECK(value(sample, "contact_safety") == std::fmin(of.contact_safety.pinion, of.contact_safety.wheel));
    if (varies_speed) CHECK(of.power / sample.values.at(0) == Approx(power_by_speed).epsilon(1e-12));  // round-off
  }
  // Nobody gave a strength of the roots or a scuffing temperature.
  for (const char* name : {"root_safety", "scuffing_safety"}) CHECK(std::ranges::find(outputs, name, &SweepOutput::name) == outputs.end());
}

TEST_CASE("A sample's own study finds the measured grids of the sweep's from anywhere", "[studies][sweep]") {
  Study study = sweep_study("samples = 24");
  study.file = "/gears/pump/sweep.toml";
  study.grid.wheel.file = "../flanks/wheel.csv";
  study.tooth_grids.pinion = {"a.csv", "", "/b.csv"};
  const std::string text = sample_study(study, "one \"worst\"", {0.5, 1000.0, 8.0});
  CHECK_THAT(text, Catch::Contains("'/gears/flanks/wheel.csv'") && Catch::Contains("[ '/gears/pump/a.csv', '', '/b.csv' ]"));
  CHECK_THAT(text, !Catch::Contains("[sweep") && Catch::Contains("one \"worst\""));
}

TEST_CASE("Samples do not depend on the number of threads, nor on the shard they are analysed in", "[studies][sweep]") {
  const Study study = sweep_study("samples = 60\nsampler = \"latin_hypercube\"");
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return samples_of(study);
  };
  const std::vector<StoredSample> one = with_threads(1), four = with_threads(4);
  REQUIRE(one.size() == four.size());
  std::vector<StoredSample> shards;
  for (long long k = 0; k < 3; ++k) {
    for (const StoredSample& sample : samples_of(study, {k, 3})) {
      CHECK(sample.id % 3 == k);
      shards.push_back(sample);
    }
  }
  std::ranges::sort(shards, {}, &StoredSample::id);
  REQUIRE(shards.size() == one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].values == four[i].values);
    CHECK(one[i].result.outputs == four[i].result.outputs);
    CHECK(one[i].result.outputs == shards[i].result.outputs);
  }
}

TEST_CASE("A sweep without torque has the outputs of unloaded contact", "[studies][sweep]") {
  const Study study = parse_study(small::sweep("samples = 10"), "sweep.toml",
                                  {{"load.torque", "0"}, {"sweep.parameters", "{ misalignment.crossing = { values = [0, 2] } }"}});
  const std::vector<StoredSample> samples = samples_of(study);
  const StudyResults nominal = run_study(study);  // crossing at its median, the second value
  for (const StoredSample& sample : samples) {
    REQUIRE(sample.result.failure.empty());
    if (sample.values[0] == 2.0) CHECK(sample.result.outputs[0] == nominal.unloaded.at(0).mesh.peak_to_peak / units::arcsec);
  }
  CHECK(std::ranges::any_of(samples, [](const StoredSample& s) { return s.values[0] == 2.0; }));
}

TEST_CASE("A sample that cannot be analysed fails with its reason and stops no other", "[studies][sweep]") {
  const Study study = sweep_study("samples = 40", "", {{"sweep.parameters.load.torque", "{ normal = [100, 200] }"}});
  StudyResults nominal = run_study(study);
  run_sweep(nominal, {}, {});
  const SweepStatistics& sweep = *nominal.found<SweepStatistics>();
  CHECK(sweep.samples == 40);
  CHECK(sweep.failed > 5);  // a third of the torques is below 0
  CHECK(sweep.failed < 25);
  CHECK_THAT(sweep.failures.front().reason, Catch::Contains("load.torque"));
  CHECK(sweep.outputs[0].count == 40 - sweep.failed);
  CHECK(nominal.requirements.empty());
}

TEST_CASE("Mean peak stress of a sweep is between what its parameters' ends give", "[studies][sweep]") {
  // Contact stress grows with the torque: over torque alone, quantiles of stress are stresses at quantiles of torque.
  const Study study = parse_study(small::sweep("samples = 33\nindices = \"off\""), "sweep.toml",
                                  {{"sweep.parameters", "{ load.torque = { grid = [800, 1200, 33] } }"}, {"sweep.sampler", "latin_hypercube"}});
  StudyResults nominal = run_study(study);
  run_sweep(nominal, {}, {});
  const auto stress_at = [&](double torque) {
    return run_study(parse_study(sample_study(study, "t", {torque}), "t.toml", {{"cycle.peaks", "sampled"}}))
        .loaded.at(0)
        .summary.peak_contact_stress;
  };
  for (const OutputStatistics& of : nominal.found<SweepStatistics>()->outputs) {
    if (of.output.name != "peak_contact_stress_MPa") continue;
    CHECK(of.smallest == stress_at(800.0));
    CHECK(of.largest == stress_at(1200.0));
    CHECK(of.quantiles[3] == stress_at(1000.0));  // the median: all 33 levels once
  }
}

}  // namespace
}  // namespace flankwright::studies
