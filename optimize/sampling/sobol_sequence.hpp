#pragma once

#include <cstdint>

namespace flankwright {

/// Largest number of dimensions for which sobol_number() has direction numbers.
inline constexpr int sobol_dimensions = 37;

/// Coordinate of point i of the Sobol sequence in base 2, as 32 bits after the binary point, in plain (not Gray) order: the first
/// 2^k points of one coordinate are one in each of 2^k equal parts [Sobol, USSR Comp. Math. 7 (1967); direction numbers of
/// Joe & Kuo, SIAM J. Sci. Comput. 30 (2008), "new-joe-kuo-6"].
/// @param dimension  0 .. sobol_dimensions - 1
std::uint32_t sobol_number(std::uint32_t i, int dimension);

/// The same scrambled: every binary digit is flipped or not at random, depending on the digits before it (nested uniform scrambling)
/// [Owen, in Monte Carlo and Quasi-Monte Carlo Methods in Scientific Computing, 1995]. Keeps the stratification, and makes every
/// point uniform. Uniform in the open interval (0, 1).
double scrambled_sobol(std::uint32_t i, int dimension, std::uint64_t seed);

}  // namespace flankwright
