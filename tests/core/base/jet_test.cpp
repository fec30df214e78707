#include "core/base/jet.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace flankwright;

namespace {

constexpr double kJetRoundOff = 1e-12;  // relative to numbers of order 1..10

void check_equal(const Jet& a, const Jet& b) {
  CHECK(a.value == Approx(b.value).margin(kJetRoundOff).epsilon(kJetRoundOff));
  CHECK(a.u == Approx(b.u).margin(kJetRoundOff).epsilon(kJetRoundOff));
  CHECK(a.v == Approx(b.v).margin(kJetRoundOff).epsilon(kJetRoundOff));
  CHECK(a.uu == Approx(b.uu).margin(kJetRoundOff).epsilon(kJetRoundOff));
  CHECK(a.uv == Approx(b.uv).margin(kJetRoundOff).epsilon(kJetRoundOff));
  CHECK(a.vv == Approx(b.vv).margin(kJetRoundOff).epsilon(kJetRoundOff));
}

/// Two numbers with all derivatives different from zero.
Jet first() { return {1.3, 0.7, -0.4, 0.25, 0.6, -1.1}; }
Jet second() { return {0.8, -0.3, 0.9, 1.4, -0.2, 0.5}; }

}  // namespace

TEST_CASE("Jets differentiate a polynomial exactly", "[core][base][closed-form]") {
  const double x = 1.7, y = -0.6;
  const Jet u = Jet::variable_u(x), v = Jet::variable_v(y);
  const Jet f = 3.0 * u * u * v - v * v * v + 2.0 * u - 5.0;
  check_equal(f, {3 * x * x * y - y * y * y + 2 * x - 5, 6 * x * y + 2, 3 * x * x - 3 * y * y, 6 * y, 6 * x, -6 * y});
  Jet g = u;
  g += v * u;
  g -= 4.0;
  check_equal(g, {x + x * y - 4, 1 + y, x, 0, 1, 0});
}

TEST_CASE("Jets differentiate quotient, root, sine, cosine and arc tangent as their closed forms", "[core][base][closed-form]") {
  const double x = 0.9, y = 1.6;
  const Jet u = Jet::variable_u(x), v = Jet::variable_v(y);
  check_equal(u / v, {x / y, 1 / y, -x / (y * y), 0, -1 / (y * y), 2 * x / (y * y * y)});
  const double root = std::sqrt(x * y);
  check_equal(sqrt(u * v), {root, 0.5 * y / root, 0.5 * x / root, -0.25 * y * y / (root * x * y), 0.25 / root, -0.25 * x * x / (root * x * y)});
  const double s = std::sin(x * y), c = std::cos(x * y);
  check_equal(sin(u * v), {s, y * c, x * c, -y * y * s, c - x * y * s, -x * x * s});
  check_equal(cos(u * v), {c, -y * s, -x * s, -y * y * c, -s - x * y * c, -x * x * c});
  const double q = x * x + y * y;
  check_equal(atan2(u, v), {std::atan2(x, y), y / q, -x / q, -2 * x * y / (q * q), (x * x - y * y) / (q * q), 2 * x * y / (q * q)});
}

TEST_CASE("Identities hold for jets in value and both orders of derivatives", "[core][base]") {
  const Jet a = first(), b = second();
  check_equal(a / b * b, a);
  check_equal(sqrt(a) * sqrt(a), a);
  check_equal(sin(a) * sin(a) + cos(a) * cos(a), 1.0);
  check_equal(atan2(b * sin(a), b * cos(a)), a);
  check_equal(-(b - a), a - b);
}

TEST_CASE("The chain rule gives what differentiating the composition gives", "[core][base]") {
  const auto f = [](const Jet& x, const Jet& y) { return sin(x * y) / (1.0 + x * x); };
  const Jet a = first(), b = second();
  const Jet at = f(Jet::variable_u(a.value), Jet::variable_v(b.value));
  check_equal(chain(at, a, b), f(a, b));
  CHECK(chain(at, a.value, b.value) == at.value);
  using Number = Dual<2>;
  const Number dual = chain(at, Number(a.value, {a.u, a.v}), Number(b.value, {b.u, b.v}));
  CHECK(dual.value == at.value);
  CHECK((dual.gradient - Eigen::Vector2d(f(a, b).u, f(a, b).v)).norm() <= kJetRoundOff);
}
