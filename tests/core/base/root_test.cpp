#include "core/base/root.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

using namespace flankwright;

namespace {

constexpr double kBracket = 1e-13;  // round-off: the tolerance asked for, a few hundred ulp of the abscissae below

struct Search {
  Root root;
  int calls{0};
};

Search search(const std::function<double(double)>& f, double a, double b, double tolerance = kBracket) {
  Search s;
  const auto counted = [&](double x) {
    ++s.calls;
    return f(x);
  };
  s.root = bracketed_root(counted, a, f(a), b, f(b), tolerance);
  return s;
}

}  // namespace

TEST_CASE("A smooth root is found within the bracket asked for, in either direction and slope", "[core][base]") {
  const double sign = GENERATE(1.0, -1.0);
  const bool reversed = GENERATE(false, true);
  const auto f = [sign](double x) { return sign * (x * x * x - 2.0); };
  const Search s = reversed ? search(f, 3.0, 0.0) : search(f, 0.0, 3.0);
  CHECK(std::abs(s.root.x - std::cbrt(2.0)) <= kBracket);
  CHECK(s.root.lower <= s.root.x);
  CHECK(s.root.x <= s.root.upper);
  CHECK(s.root.upper - s.root.lower <= kBracket);
  CHECK(f(s.root.lower) * f(s.root.upper) <= 0.0);
  CHECK(s.calls < 20);  // bisection needs log2(3e13) = 45
}

TEST_CASE("A root at an end of the interval is returned without a further evaluation", "[core][base]") {
  const auto f = [](double x) { return x * (x - 1.0) - 0.0; };
  const Search at_lower = search(f, 0.0, 0.5), at_upper = search(f, 0.5, 1.0);
  CHECK(at_lower.root.x == 0.0);
  CHECK(at_lower.root.lower == at_lower.root.upper);
  CHECK(at_upper.root.x == 1.0);
  CHECK(at_lower.calls + at_upper.calls == 0);
}

TEST_CASE("A kink at the root, of any ratio of the slopes, does not spoil the bracket", "[core][base]") {
  const double ratio = GENERATE(1.0, 1e2, 1e6, 1e12);
  const auto f = [ratio](double x) { return x < 0.3 ? ratio * (x - 0.3) : x - 0.3; };
  CAPTURE(ratio);
  const Search s = search(f, -1.0, 2.0);
  CHECK(std::abs(s.root.x - 0.3) <= kBracket);
}

TEST_CASE("A jump is bracketed though no argument gives zero", "[core][base]") {
  const double place = 1.0 / 3.0;
  const double before = GENERATE(1.0, 1e-9, 1e9);
  const auto f = [&](double x) { return x < place ? before : -1.0; };
  CAPTURE(before);
  const Root root = search(f, 0.0, 1.0).root;
  CHECK(root.lower <= place);
  CHECK(root.upper >= place);
  CHECK(root.upper - root.lower <= kBracket);
}

TEST_CASE("The worst functions need no more than three evaluations for each halving of the bracket", "[core][base]") {
  const double scale = GENERATE(1.0, 1e-200, 1e200);
  const auto flat = [scale](double x) { return scale * std::pow(x - 0.1, 21); };
  const auto steep = [scale](double x) { return scale * std::expm1(60.0 * (x - 0.95)); };
  const auto pole = [](double x) { return x == 0.2 ? 0.0 : 1.0 / (x - 0.2); };
  const double halvings = std::ceil(std::log2(2.0 / kBracket));
  for (const std::function<double(double)>& f : {std::function<double(double)>(flat), {steep}, {pole}}) {
    const Search s = search(f, -1.0, 1.0);
    CHECK(s.calls <= 3.0 * halvings);
    CHECK(s.root.upper - s.root.lower <= kBracket);
  }
  CHECK(std::abs(search(flat, -1.0, 1.0).root.x - 0.1) <= 2e-6);  // at scale 1e-200 it underflows to 0 within 1.2e-6
  CHECK(std::abs(search(steep, -1.0, 1.0).root.x - 0.95) <= kBracket);
}

TEST_CASE("A tolerance below the spacing of the numbers ends the search all the same", "[core][base]") {
  const Search s = search([](double x) { return x - 1e6 - 1.0 / 3.0; }, 0.0, 3e6, 1e-300);
  CHECK(std::abs(s.root.x - (1e6 + 1.0 / 3.0)) <= 2.4e-10);  // round-off: one spacing of the numbers at 1e6 is 1.2e-10
  CHECK(s.calls < 300);
}
