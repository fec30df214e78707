#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace flankwright {

/// The distribution of points over the unit cube.
enum class Sampler {
  Grid,            ///< every combination of levels, the last coordinate fastest
  Sobol,           ///< scrambled Sobol sequence: best for means and indices
  LatinHypercube,  ///< each coordinate once in each of N equal parts
  MonteCarlo       ///< independent points
};

/// As a study names it: "grid", "sobol", "latin_hypercube", "monte_carlo".
const char* to_string(Sampler sampler);
/// The names of all samplers, in the order of the enumerators.
const std::vector<std::string>& sampler_names();

/// Points of the unit cube, each computed on its own from its number and the seed: any order, any share of them, the
/// same points. With Sobol and Monte Carlo a larger design begins with the smaller one. Coordinates are uniform in the
/// open interval (0, 1), and of a Grid the middles of its levels; Distribution::quantile() makes values of them.
class SampleDesign {
 public:
  /// Sobol, Latin hypercube or Monte Carlo.
  /// @param samples     1 .. 2^32 - 1
  /// @param dimensions  >= 1; Sobol: at most sobol_dimensions
  /// @throws InvalidInput "samples", "sampler" or "parameters"
  SampleDesign(Sampler sampler, long long samples, int dimensions, std::uint64_t seed);
  /// Full factorial.
  /// @param levels  per coordinate, >= 1; at most 2^32 - 1 combinations
  explicit SampleDesign(std::vector<int> levels);

  long long samples() const { return samples_; }
  /// @param i  0 .. samples() - 1
  std::vector<double> point(long long i) const;

 private:
  double coordinate(std::uint64_t i, int dimension) const;

  Sampler sampler_;
  long long samples_;
  int dimensions_;
  std::uint64_t seed_;
  std::vector<int> levels_;  ///< of a Grid
};

/// Position of item i in a random order of n items, computed without the rest: a four-round Feistel network on the next
/// even power of two, repeated until it lands below n (cycle walking) [Black & Rogaway, Ciphers with arbitrary finite
/// domains, CT-RSA 2002].
/// @param i  0 .. n - 1;  n at most 2^32
std::uint64_t shuffled_place(std::uint64_t i, std::uint64_t n, std::uint64_t seed, std::uint64_t stream);

}  // namespace flankwright
