#pragma once

#include <cstdint>

namespace flankwright {

/// Random numbers by counter: number k of a stream is computed on its own, so that nothing depends on who asks first. Bits are mixed
/// by the finaliser of SplitMix64 [Steele, Lea & Flood, Fast splittable pseudorandom number generators, OOPSLA 2014].
inline std::uint64_t mixed_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// 64 bits of number `counter` of a stream.
inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  return mixed_bits(mixed_bits(mixed_bits(seed) ^ stream) ^ counter);
}

/// Uniform in the open interval (0, 1): the middles of 2^52 equal parts.
inline double random_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  return (static_cast<double>(random_bits(seed, stream, counter) >> 12) + 0.5) * 0x1p-52;
}

}  // namespace flankwright
