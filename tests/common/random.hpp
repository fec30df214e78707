#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace flankwright::tests {

/// Random numbers that are the same on every machine, of the standard's Mersenne twister.
template <typename Engine>
class RandomNumbers {
 public:
  explicit RandomNumbers(typename Engine::result_type seed) : engine_(seed) {}

  double operator()(double from, double to) { return from + (to - from) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  double log_uniform(double from, double to) { return std::exp((*this)(std::log(from), std::log(to))); }
  /// Of one word, where the above takes two of 32 bits.
  double coarse(double from, double to) { return from + (to - from) * static_cast<double>(word() >> 11) * 0x1p-53; }
  /// Mean 0 and standard deviation 1, by Marsaglia's polar method, which has two at a time.
  double normal() {
    if (second_) return *std::exchange(second_, std::nullopt);
    for (;;) {
      const double x = (*this)(-1.0, 1.0), y = (*this)(-1.0, 1.0), square = x * x + y * y;
      if (square > 1.0 || square == 0.0) continue;
      const double scale = std::sqrt(-2.0 * std::log(square) / square);
      second_ = scale * x;
      return scale * y;
    }
  }
  /// Both ends included.
  int integer(int from, int to) { return from + static_cast<int>(coarse(0.0, to - from + 1.0)); }
  /// 0 to count - 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  template <typename Value>
  Value one_of(const std::vector<Value>& values) {
    return values[below(values.size())];
  }
  template <typename Value>
  void shuffle(std::vector<Value>& values) {
    for (std::size_t left = values.size(); left > 1; --left) std::swap(values[left - 1], values[below(left)]);
  }
  /// True in that share of the draws.
  bool chance(double share) { return (*this)(0.0, 1.0) < share; }
  bool coin() { return chance(0.5); }
  Eigen::VectorXd vector(Eigen::Index n, double from, double to) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return (*this)(from, to); });
  }
  /// Entries of -1 to 1.
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return (*this)(-1.0, 1.0); });
  }
  Eigen::MatrixXd normal_matrix(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(); });
  }

 private:
  /// One word, its highest bit the highest of 64.
  std::uint64_t word() { return std::uint64_t{engine_()} << (64 - Engine::word_size); }
  /// 64 bits: one word, or two of which the first is the lower.
  std::uint64_t bits() {
    const std::uint64_t lower = word() >> (64 - Engine::word_size);
    return Engine::word_size == 64 ? lower : lower | word();
  }

  Engine engine_;
  std::optional<double> second_;  ///< of the last two normal numbers
};

using Random = RandomNumbers<std::mt19937_64>;
/// The numbers that the distributions of GCC's library draw with std::mt19937: for tests that were written with those. New ones take Random.
using Random32 = RandomNumbers<std::mt19937>;

/// One number of two, every bit of the result depending on every bit of both (finaliser of MurmurHash3, 64 bit).
inline std::uint64_t mixed(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15u + index;
  for (const std::uint64_t factor : {0xff51afd7ed558ccdu, 0xc4ceb9fe1a85ec53u}) {
    x ^= x >> 33;
    x *= factor;
  }
  return x ^ (x >> 33);
}

}  // namespace flankwright::tests
