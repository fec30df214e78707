#include "optimize/sampling/sample_design.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/base/error.hpp"
#include "optimize/sampling/sobol_sequence.hpp"

using namespace flankwright;

namespace {

/// In how many of n equal parts of (0, 1) one coordinate of the design has exactly one point.
int parts_met_once(const SampleDesign& design, int dimension) {
  std::vector<int> met(static_cast<std::size_t>(design.samples()), 0);
  for (long long i = 0; i < design.samples(); ++i) {
    const double u = design.point(i)[static_cast<std::size_t>(dimension)];
    REQUIRE((u > 0.0 && u < 1.0));
    ++met[static_cast<std::size_t>(u * static_cast<double>(design.samples()))];
  }
  int once = 0;
  for (const int m : met) once += m == 1;
  return once;
}

/// Error of the mean of prod (1 + (u_j - 1/2)), whose mean is 1.
double mean_error(const SampleDesign& design) {
  double sum = 0.0;
  for (long long i = 0; i < design.samples(); ++i) {
    double product = 1.0;
    for (const double u : design.point(i)) product *= 0.5 + u;
    sum += product;
  }
  return std::abs(sum / static_cast<double>(design.samples()) - 1.0);
}

}  // namespace

TEST_CASE("The Sobol sequence begins as published", "[optimize][sampling]") {
  const auto number = [](std::uint32_t i, int j) { return sobol_number(i, j) * 0x1p-32; };
  // Coordinate 1 is van der Corput's; coordinate 2 from p(x) = x + 1, m_1 = 1.
  const double first[] = {0.0, 0.5, 0.25, 0.75, 0.125}, second[] = {0.0, 0.5, 0.75, 0.25, 0.625};
  for (std::uint32_t i = 0; i < 5; ++i) {
    CHECK(number(i, 0) == first[i]);
    CHECK(number(i, 1) == second[i]);
  }
}

TEST_CASE("Every coordinate of the Sobol sequence meets each of 2^k equal parts once, scrambled or not", "[optimize][sampling]") {
  const std::uint32_t n = 1024;
  for (int j = 0; j < sobol_dimensions; ++j) {
    std::set<std::uint32_t> plain;
    for (std::uint32_t i = 0; i < n; ++i) plain.insert(sobol_number(i, j) >> 22);
    CAPTURE(j);
    CHECK(plain.size() == n);
    CHECK(parts_met_once({Sampler::Sobol, n, sobol_dimensions, 3}, j) == static_cast<int>(n));
  }
}

TEST_CASE("Pairs of Sobol coordinates fill elementary boxes once", "[optimize][sampling]") {
  // The first two coordinates form a (0, k, 2)-net: every box 2^-a x 2^-(k-a) holds one point; scrambling keeps that.
  const SampleDesign design(Sampler::Sobol, 256, 2, 11);
  for (int a = 0; a <= 8; ++a) {
    std::set<std::pair<int, int>> boxes;
    for (long long i = 0; i < 256; ++i) {
      const auto p = design.point(i);
      boxes.insert({static_cast<int>(p[0] * (1 << a)), static_cast<int>(p[1] * (1 << (8 - a)))});
    }
    CHECK(boxes.size() == 256);
  }
}

TEST_CASE("A Latin hypercube meets each part of every coordinate once, whatever the number of samples", "[optimize][sampling]") {
  for (const long long n : {1, 2, 7, 100, 1023}) {
    const SampleDesign design(Sampler::LatinHypercube, n, 4, 5);
    for (int j = 0; j < 4; ++j) CHECK(parts_met_once(design, j) == n);
  }
}

TEST_CASE("A random order is a permutation", "[optimize][sampling]") {
  for (const std::uint64_t n : {1u, 2u, 3u, 16u, 17u, 1000u}) {
    std::set<std::uint64_t> places;
    for (std::uint64_t i = 0; i < n; ++i) places.insert(shuffled_place(i, n, 9, 1));
    CHECK(places.size() == n);
    CHECK(*places.rbegin() == n - 1);
  }
}

TEST_CASE("A grid counts through all combinations, the last coordinate fastest", "[optimize][sampling]") {
  const SampleDesign design({2, 3});
  REQUIRE(design.samples() == 6);
  CHECK(design.point(0) == std::vector<double>{0.25, 0.5 / 3});
  CHECK(design.point(1) == std::vector<double>{0.25, 1.5 / 3});
  CHECK(design.point(5) == std::vector<double>{0.75, 2.5 / 3});
}

TEST_CASE("Spread points estimate a mean better than independent ones", "[optimize][sampling]") {
  const long long n = 4096;
  // Monte Carlo: sqrt(Var/n), Var = (1 + 1/12)^6 - 1 = 0.62, so 0.0123 expected; four of them allowed.
  CHECK(mean_error({Sampler::MonteCarlo, n, 6, 1}) < 4 * 0.0123);
  // The same integrand without its additive part, (1 + 1/12)^6 - 1 - 6/12 = 0.12: 0.0054.
  CHECK(mean_error({Sampler::LatinHypercube, n, 6, 1}) < 4 * 0.0054);
  // Scrambled Sobol: of order n^-1.5 times logarithms; far below either.
  CHECK(mean_error({Sampler::Sobol, n, 6, 1}) < 4e-4);
}

TEST_CASE("Points depend on their number and the seed only", "[optimize][sampling]") {
  for (const Sampler sampler : {Sampler::Sobol, Sampler::LatinHypercube, Sampler::MonteCarlo}) {
    const SampleDesign design(sampler, 500, 3, 7), again(sampler, 500, 3, 7), other(sampler, 500, 3, 8);
    CHECK(design.point(499) == again.point(499));
    CHECK(design.point(499) != other.point(499));
    if (sampler != Sampler::LatinHypercube) CHECK(design.point(17) == SampleDesign(sampler, 1000, 3, 7).point(17));
  }
}

TEST_CASE("Designs that cannot be made are refused by name", "[optimize][sampling]") {
  CHECK_THROWS_AS(SampleDesign(Sampler::Sobol, 10, sobol_dimensions + 1, 1), InvalidInput);
  CHECK_THROWS_AS(SampleDesign(Sampler::MonteCarlo, 0, 2, 1), InvalidInput);
  CHECK_THROWS_AS(SampleDesign(std::vector<int>{}), InvalidInput);
  CHECK_THROWS_AS(SampleDesign(std::vector<int>(33, 2)), InvalidInput);
  for (const auto& name : sampler_names()) CHECK(name == to_string(static_cast<Sampler>(&name - sampler_names().data())));
}
