#include "studies/tasks/sweep/sweep_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flankwright::studies {

namespace {

constexpr std::size_t histogram_parts = 40, fewest_map_parts = 2, most_map_parts = 12, most_levels_shown = 24;
constexpr double samples_per_place = 25.0;  // of a map, on average at least
constexpr std::size_t most_reasons = 1000, shown_reasons = 20;

/// Mean and sum of squared distances from it, value by value [Welford, Technometrics 4 (1962)].
struct Moments {
  long long count{0};
  double mean{0.0}, squares{0.0};
  void add(double value) {
    ++count;
    const double step = value - mean;
    mean += step / static_cast<double>(count);
    squares += step * (value - mean);
  }
};

void widen(Histogram& range, double value) {
  range.low = std::fmin(range.low, value);
  range.high = std::fmax(range.high, value);
}

/// First reading: moments, extremes, the worst samples, failures.
void read_moments(SweepStore& store, long long end, SweepStatistics& statistics) {
  std::vector<Moments> moments(statistics.outputs.size());
  std::map<std::string, FailureCount> failures;
  store.for_each(end, [&](const StoredSample& sample) {
    ++statistics.samples;
    for (std::size_t j = 0; j < sample.values.size(); ++j) widen(statistics.parameters[j], sample.values[j]);
    if (!sample.result.failure.empty()) {
      ++statistics.failed;
      if (failures.size() >= most_reasons && !failures.contains(sample.result.failure)) return;
      FailureCount& failure = failures[sample.result.failure];
      if (failure.count++ == 0) failure.first = sample.id;
      return;
    }
    for (std::size_t k = 0; k < moments.size(); ++k) {
      const double value = sample.result.outputs[k];
      if (std::isnan(value)) continue;
      OutputStatistics& of = statistics.outputs[k];
      const bool is_worse = of.output.smaller_is_worse ? value < of.smallest : value > of.largest;
      if (is_worse || of.worst < 0) of.worst = sample.id;
      of.smallest = std::fmin(of.smallest, value);
      of.largest = std::fmax(of.largest, value);
      moments[k].add(value);
    }
  });
  for (std::size_t k = 0; k < moments.size(); ++k) {
    OutputStatistics& of = statistics.outputs[k];
    of.count = moments[k].count;
    if (of.count > 0) of.mean = moments[k].mean;
    if (of.count > 1) of.deviation = std::sqrt(moments[k].squares / static_cast<double>(of.count - 1));
  }
  for (auto& [reason, failure] : failures) {
    failure.reason = reason;
    statistics.failures.push_back(failure);
  }
  std::ranges::stable_sort(statistics.failures, std::greater{}, &FailureCount::count);
  if (statistics.failures.size() > shown_reasons) statistics.failures.resize(shown_reasons);
}

/// Second reading: histograms and response maps, which need the ranges.
void read_maps(SweepStore& store, const SweepDesign& design, SweepStatistics& statistics) {
  const std::size_t count = statistics.parameters.size();
  for (OutputStatistics& of : statistics.outputs) {
    of.histogram = {of.smallest, of.largest, std::vector<long long>(histogram_parts, 0)};
  }
  for (std::size_t k = 0; k < statistics.outputs.size(); ++k) {
    for (std::size_t x = 0; x < count; ++x) {
      for (std::size_t y = x + 1; y < count; ++y) {
        if (design.is_draw(x) || design.is_draw(y)) continue;
        const std::size_t columns = statistics.parameters[x].counts.size(), places = columns * statistics.parameters[y].counts.size();
        statistics.maps.push_back({k, x, y, columns, std::vector<double>(places, 0.0), std::vector<long long>(places, 0)});
      }
    }
  }
  std::vector<std::size_t> part(count);
  store.for_each(design.samples(), [&](const StoredSample& sample) {
    for (std::size_t j = 0; j < count; ++j) {
      part[j] = statistics.parameters[j].part(sample.values[j]);
      ++statistics.parameters[j].counts[part[j]];
    }
    if (!sample.result.failure.empty()) return;
    for (std::size_t k = 0; k < statistics.outputs.size(); ++k) {
      const double value = sample.result.outputs[k];
      Histogram& histogram = statistics.outputs[k].histogram;
      if (!std::isnan(value)) ++histogram.counts[histogram.part(value)];
    }
    for (ResponseMap& map : statistics.maps) {
      const double value = sample.result.outputs[map.output];
      if (std::isnan(value)) continue;
      const std::size_t place = part[map.y] * map.columns + part[map.x];
      map.sums[place] += value;
      ++map.counts[place];
    }
  });
}

/// Third reading: whole blocks.
void read_indices(SweepStore& store, const SweepDesign& design, SweepStatistics& statistics) {
  const auto size = static_cast<std::size_t>(design.block_size());
  if (size == 0) return;
  std::vector<SobolEstimate> estimates;
  for (const OutputStatistics& of : statistics.outputs) estimates.emplace_back(static_cast<int>(statistics.parameters.size()), of.mean);
  std::vector<std::vector<double>> block;  // per sample its outputs
  long long block_number = -1;
  store.for_each(design.samples(), [&](const StoredSample& sample) {
    const long long number = sample.id / static_cast<long long>(size);
    if (number != block_number) block.clear();
    block_number = number;
    if (sample.result.failure.empty()) block.push_back(sample.result.outputs);
    if (block.size() < size) return;
    ++statistics.blocks;
    std::vector<double> values(size);
    for (std::size_t k = 0; k < estimates.size(); ++k) {
      for (std::size_t i = 0; i < size; ++i) values[i] = block[i][k];
      if (std::ranges::none_of(values, [](double v) { return std::isnan(v); })) estimates[k].add_block(values);
    }
    block.clear();
  });
  for (std::size_t k = 0; k < estimates.size(); ++k) statistics.outputs[k].indices = estimates[k].indices();
}

void read_quantiles(SweepStore& store, long long end, std::size_t output, OutputStatistics& of) {
  of.quantiles.fill(not_given);
  long long rank = 0;
  double previous = not_given;
  std::size_t next = 0;
  store.for_each_sorted(output, end, [&](double value) {
    for (; next < quantile_shares.size(); ++next) {
      const double place = quantile_shares[next] * static_cast<double>(of.count - 1);
      if (place > static_cast<double>(rank)) break;
      const double back = static_cast<double>(rank) - place;  // 0 .. 1
      of.quantiles[next] = back == 0.0 ? value : back * previous + (1.0 - back) * value;
    }
    previous = value;
    ++rank;
  });
}

}  // namespace

std::size_t Histogram::part(double value) const {
  if (!levels.empty()) {
    const auto away = [&](double level) { return std::abs(level - value); };
    return static_cast<std::size_t>(std::ranges::min_element(levels, {}, away) - levels.begin());
  }
  if (!(high > low)) return 0;
  const auto n = static_cast<double>(counts.size());
  return std::min(counts.size() - 1, static_cast<std::size_t>(std::max(0.0, n * ((value - low) / (high - low)))));
}

double ResponseMap::mean(std::size_t ix, std::size_t iy) const {
  const std::size_t place = iy * columns + ix;
  return counts[place] == 0 ? not_given : sums[place] / static_cast<double>(counts[place]);
}

std::string index_warning(const SweepStatistics& statistics) {
  constexpr double wide = 0.1;
  double widest = 0.0;
  bool has_indices = false;
  for (const OutputStatistics& of : statistics.outputs) {
    for (const SobolIndex& index : of.indices) {
      has_indices = true;
      for (const double error : {index.first_error, index.total_error}) widest = std::fmax(widest, index_confidence(error));
    }
  }
  if (!has_indices) return {};
  if (statistics.blocks < 2) return "The Sobol indices need two blocks of samples at least: set sweep.samples higher, or sweep.indices = \"off\".";
  if (widest == 0.0) return "No output scatters: none of the parameters has an influence, and the Sobol indices mean nothing.";
  if (widest <= wide && statistics.blocks >= fewest_index_blocks) return {};
  const double needed = std::max(static_cast<double>(statistics.blocks) * (widest / wide) * (widest / wide), 1.0 * fewest_index_blocks);
  return fmt::format(
      "The Sobol indices come from {} blocks and are uncertain by up to {:.2g} either way (95 % confidence); about {:.2g} blocks would make it {}.",
      statistics.blocks, widest, needed, wide);
}

SweepStatistics sweep_statistics(SweepStore& store, const SweepDesign& design, const std::vector<SweepOutput>& outputs) {
  SweepStatistics statistics;
  for (const SweepOutput& output : outputs) statistics.outputs.push_back({.output = output, .histogram = {}, .indices = {}});
  statistics.parameters.resize(design.parameters());
  read_moments(store, design.samples(), statistics);
  const double side = std::sqrt(static_cast<double>(statistics.samples) / samples_per_place);
  const std::size_t parts = std::clamp(static_cast<std::size_t>(side), fewest_map_parts, most_map_parts);
  for (std::size_t j = 0; j < design.parameters(); ++j) {
    Histogram& of = statistics.parameters[j];
    of.levels = design.levels(j);
    if (of.levels.size() > most_levels_shown) of.levels.clear();
    of.counts.assign(of.levels.empty() ? parts : of.levels.size(), 0);
  }
  read_maps(store, design, statistics);
  read_indices(store, design, statistics);
  for (const OutputStatistics& of : statistics.outputs) statistics.worst.push_back(store.find(of.worst).value_or(StoredSample{-1, {}, {}}));
  for (std::size_t k = 0; k < outputs.size(); ++k) read_quantiles(store, design.samples(), k, statistics.outputs[k]);
  return statistics;
}

}  // namespace flankwright::studies
