#include "optimize/sampling/sobol_sequence.hpp"

#include <array>
#include <cassert>

#include "optimize/sampling/random_numbers.hpp"

namespace flankwright {

namespace {

constexpr int bits = 32;

/// Primitive polynomial x^s + a_1 x^(s-1) + ... + a_(s-1) x + 1 and the first odd integers m_1 .. m_s.
struct Direction {
  int degree;                     ///< s
  unsigned coefficients;          ///< a_1 .. a_(s-1) as the digits of one number
  std::array<unsigned, 7> first;  ///< m_1 .. m_s
};

// Joe & Kuo's table from its second dimension on; the first needs none.
constexpr std::array<Direction, sobol_dimensions - 1> directions{{{1, 0, {1}},
                                                                  {2, 1, {1, 3}},
                                                                  {3, 1, {1, 3, 1}},
                                                                  {3, 2, {1, 1, 1}},
                                                                  {4, 1, {1, 1, 3, 3}},
                                                                  {4, 4, {1, 3, 5, 13}},
                                                                  {5, 2, {1, 1, 5, 5, 17}},
                                                                  {5, 4, {1, 1, 5, 5, 5}},
                                                                  {5, 7, {1, 1, 7, 11, 19}},
                                                                  {5, 11, {1, 1, 5, 1, 1}},
                                                                  {5, 13, {1, 1, 1, 3, 11}},
                                                                  {5, 14, {1, 3, 5, 5, 31}},
                                                                  {6, 1, {1, 3, 3, 9, 7, 49}},
                                                                  {6, 13, {1, 1, 1, 15, 21, 21}},
                                                                  {6, 16, {1, 3, 1, 13, 27, 49}},
                                                                  {6, 19, {1, 1, 1, 15, 7, 5}},
                                                                  {6, 22, {1, 3, 1, 15, 13, 25}},
                                                                  {6, 25, {1, 1, 5, 5, 19, 61}},
                                                                  {7, 1, {1, 3, 7, 11, 23, 15, 103}},
                                                                  {7, 4, {1, 3, 7, 13, 13, 15, 69}},
                                                                  {7, 7, {1, 1, 3, 13, 7, 35, 63}},
                                                                  {7, 8, {1, 3, 5, 9, 1, 25, 53}},
                                                                  {7, 14, {1, 3, 1, 13, 9, 35, 107}},
                                                                  {7, 19, {1, 3, 1, 5, 27, 61, 31}},
                                                                  {7, 21, {1, 1, 5, 11, 19, 41, 61}},
                                                                  {7, 28, {1, 3, 5, 3, 3, 13, 69}},
                                                                  {7, 31, {1, 1, 7, 13, 1, 19, 1}},
                                                                  {7, 32, {1, 3, 7, 5, 13, 19, 59}},
                                                                  {7, 37, {1, 1, 3, 9, 25, 29, 41}},
                                                                  {7, 41, {1, 3, 5, 13, 23, 1, 55}},
                                                                  {7, 42, {1, 3, 7, 3, 13, 59, 17}},
                                                                  {7, 50, {1, 3, 1, 3, 5, 53, 69}},
                                                                  {7, 55, {1, 1, 5, 5, 23, 33, 13}},
                                                                  {7, 56, {1, 1, 7, 7, 1, 61, 123}},
                                                                  {7, 59, {1, 1, 7, 9, 13, 61, 49}},
                                                                  {7, 62, {1, 3, 3, 5, 3, 55, 33}}}};

using DirectionNumbers = std::array<std::array<std::uint32_t, bits>, sobol_dimensions>;

/// v_k = m_k / 2^k as 32 bits, m_k = 2 a_1 m_(k-1) ^ ... ^ 2^(s-1) a_(s-1) m_(k-s+1) ^ 2^s m_(k-s) ^ m_(k-s).
constexpr DirectionNumbers make_direction_numbers() {
  DirectionNumbers numbers{};
  for (int k = 0; k < bits; ++k) numbers[0][k] = 1u << (bits - 1 - k);
  for (int j = 1; j < sobol_dimensions; ++j) {
    const Direction& d = directions[j - 1];
    auto& v = numbers[j];
    for (int k = 0; k < bits; ++k) {
      if (k < d.degree) {
        v[k] = d.first[k] << (bits - 1 - k);
        continue;
      }
      v[k] = v[k - d.degree] ^ (v[k - d.degree] >> d.degree);
      for (int i = 1; i < d.degree; ++i) {
        if ((d.coefficients >> (d.degree - 1 - i)) & 1u) v[k] ^= v[k - i];
      }
    }
  }
  return numbers;
}

constexpr DirectionNumbers direction_numbers = make_direction_numbers();

}  // namespace

std::uint32_t sobol_number(std::uint32_t i, int dimension) {
  assert(dimension >= 0 && dimension < sobol_dimensions);
  std::uint32_t x = 0;
  for (int k = 0; i != 0; ++k, i >>= 1) {
    if (i & 1u) x ^= direction_numbers[dimension][k];
  }
  return x;
}

double scrambled_sobol(std::uint32_t i, int dimension, std::uint64_t seed) {
  const std::uint32_t x = sobol_number(i, dimension);
  std::uint32_t scrambled = 0;
  for (int k = 0; k < bits; ++k) {
    const std::uint64_t before = k == 0 ? 0 : x >> (bits - k);
    const std::uint64_t node = (before << 6) | static_cast<std::uint64_t>(k);
    const std::uint32_t digit = (x >> (bits - 1 - k)) & 1u;
    scrambled |= (digit ^ static_cast<std::uint32_t>(random_bits(seed, static_cast<std::uint64_t>(dimension), node) & 1u)) << (bits - 1 - k);
  }
  return (scrambled + 0.5) * 0x1p-32;
}

}  // namespace flankwright
