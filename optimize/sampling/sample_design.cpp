#include "optimize/sampling/sample_design.hpp"

#include <bit>
#include <cassert>

#include "core/base/error.hpp"
#include "optimize/sampling/random_numbers.hpp"
#include "optimize/sampling/sobol_sequence.hpp"

namespace flankwright {

namespace {

constexpr long long most_samples = 0xffffffffLL;

// Streams of the random numbers of one coordinate, so that no two uses share one.
constexpr std::uint64_t jitter_streams = 1ULL << 32, shuffle_streams = 2ULL << 32;

long long combinations(const std::vector<int>& levels) {
  if (levels.empty()) throw InvalidInput("parameters", "none", "at least one");
  long long product = 1;
  for (const int n : levels) {
    if (n < 1) throw InvalidInput("levels", std::to_string(n), "at least 1");
    product *= n;
    if (product > most_samples) throw InvalidInput("levels", "more than 2^32 combinations", "fewer levels, or another sampler");
  }
  return product;
}

}  // namespace

const std::vector<std::string>& sampler_names() {
  static const std::vector<std::string> names{"grid", "sobol", "latin_hypercube", "monte_carlo"};
  return names;
}

const char* to_string(Sampler sampler) { return sampler_names()[static_cast<std::size_t>(sampler)].c_str(); }

SampleDesign::SampleDesign(Sampler sampler, long long samples, int dimensions, std::uint64_t seed)
    : sampler_(sampler), samples_(samples), dimensions_(dimensions), seed_(seed) {
  if (sampler == Sampler::Grid) throw InvalidInput("sampler", to_string(sampler), "levels per coordinate");
  if (samples < 1 || samples > most_samples) throw InvalidInput("samples", std::to_string(samples), "1 .. 2^32 - 1");
  if (dimensions < 1) throw InvalidInput("parameters", "none", "at least one");
  if (sampler == Sampler::Sobol && dimensions > sobol_dimensions) {
    throw InvalidInput("parameters", std::to_string(dimensions) + " coordinates",
                       "at most " + std::to_string(sobol_dimensions) + " coordinates of the sampler \"sobol\"");
  }
}

SampleDesign::SampleDesign(std::vector<int> levels)
    : sampler_(Sampler::Grid), samples_(combinations(levels)), dimensions_(static_cast<int>(levels.size())), seed_(0), levels_(std::move(levels)) {}

std::vector<double> SampleDesign::point(long long i) const {
  assert(i >= 0 && i < samples_);
  std::vector<double> point(static_cast<std::size_t>(dimensions_));
  if (sampler_ == Sampler::Grid) {
    for (std::size_t j = point.size(); j-- > 0; i /= levels_[j]) {
      point[j] = (static_cast<double>(i % levels_[j]) + 0.5) / levels_[j];
    }
    return point;
  }
  for (int j = 0; j < dimensions_; ++j) point[static_cast<std::size_t>(j)] = coordinate(static_cast<std::uint64_t>(i), j);
  return point;
}

double SampleDesign::coordinate(std::uint64_t i, int dimension) const {
  const auto stream = static_cast<std::uint64_t>(dimension);
  switch (sampler_) {
    case Sampler::Sobol:
      return scrambled_sobol(static_cast<std::uint32_t>(i), dimension, seed_);
    case Sampler::LatinHypercube: {
      const auto n = static_cast<std::uint64_t>(samples_);
      const std::uint64_t part = shuffled_place(i, n, seed_, shuffle_streams | stream);
      return (static_cast<double>(part) + random_uniform(seed_, jitter_streams | stream, i)) / static_cast<double>(n);
    }
    case Sampler::MonteCarlo:
      return random_uniform(seed_, stream, i);
    case Sampler::Grid:
      break;
  }
  __builtin_unreachable();
}

std::uint64_t shuffled_place(std::uint64_t i, std::uint64_t n, std::uint64_t seed, std::uint64_t stream) {
  assert(i < n);
  const int half = n < 2 ? 1 : (static_cast<int>(std::bit_width(n - 1)) + 1) / 2;
  const std::uint64_t mask = (1ULL << half) - 1;
  do {
    std::uint64_t left = i >> half, right = i & mask;
    for (std::uint64_t round = 0; round < 4; ++round) {
      const std::uint64_t mixed = left ^ (random_bits(seed, stream, (round << 32) | right) & mask);
      left = right;
      right = mixed;
    }
    i = (left << half) | right;
  } while (i >= n);
  return i;
}

}  // namespace flankwright
