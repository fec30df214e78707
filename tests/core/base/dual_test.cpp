#include "core/base/dual.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

using namespace flankwright;

namespace {

using Number = Dual<3>;
using Complex = std::complex<double>;

constexpr double kRoundOff = 1e-14;  // relative: a dozen operations

/// Derivatives by the complex step, exact to round-off: Im f(x + i h)/h with h far below the spacing of the numbers.
template <class Function>
Eigen::Vector3d complex_step(const Function& f, const Eigen::Vector3d& at) {
  constexpr double h = 1e-40;
  Eigen::Vector3d gradient;
  for (int i = 0; i < 3; ++i) {
    Complex x[3] = {at[0], at[1], at[2]};
    x[i] += Complex(0.0, h);
    gradient[i] = f(x[0], x[1], x[2]).imag() / h;
  }
  return gradient;
}

/// Checks value and gradient of f at a point; f is written once for all number types.
template <class Function>
void check(const Function& f, const Eigen::Vector3d& at) {
  const Number dual = f(Number::variable(at[0], 0), Number::variable(at[1], 1), Number::variable(at[2], 2));
  const Complex plain = f(Complex(at[0]), Complex(at[1]), Complex(at[2]));
  const Eigen::Vector3d expected = complex_step(f, at);
  CAPTURE(at.transpose(), dual.gradient.transpose(), expected.transpose());
  CHECK(std::abs(dual.value - plain.real()) <= kRoundOff * (1.0 + std::abs(plain.real())));
  CHECK((dual.gradient - expected).norm() <= kRoundOff * (1.0 + expected.norm()));
}

}  // namespace

TEST_CASE("Arithmetic of dual numbers differentiates as the complex step does", "[core][base]") {
  const Eigen::Vector3d at = GENERATE(Eigen::Vector3d(0.7, -1.3, 2.9), Eigen::Vector3d(-5.0, 0.01, 0.3));
  check([](auto x, auto y, auto z) { return x + y * 2.0 - 3.0 * z; }, at);
  check([](auto x, auto y, auto z) { return -x * y / z; }, at);
  check([](auto x, auto y, auto z) { return 1.0 / x - y / 3.0 + 2.0 / (z * z * y); }, at);
  check(
      [](auto x, auto y, auto z) {
        auto sum = x * x;
        sum += y * z;
        sum -= x / y;
        return sum * sum;
      },
      at);
}

TEST_CASE("Functions of dual numbers differentiate as the complex step does", "[core][base]") {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Eigen::Vector3d at = GENERATE(Eigen::Vector3d(0.7, 1.3, 2.9), Eigen::Vector3d(40.0, 0.02, 1.0));
  check([](auto x, auto y, auto z) { return sqrt(x * x + y) * z; }, at);
  check([](auto x, auto y, auto z) { return sin(x * y) - cos(z / x) * sin(y); }, at);
  check([](auto x, auto y, auto z) { return sqrt(x) * cos(sqrt(y * z)) + sin(1.0 / x); }, at);
}

TEST_CASE("The dual arc tangent has the exact gradient in every quadrant and on the axes", "[core][base]") {
  const double angle = GENERATE(0.0, 0.4, 1.5707963267948966, 2.0, 3.1, -0.4, -1.5, -2.8);
  const double radius = GENERATE(0.01, 300.0);
  const Dual<2> x = Dual<2>::variable(radius * std::cos(angle), 0), y = Dual<2>::variable(radius * std::sin(angle), 1);
  const Dual<2> found = atan2(y, x);
  // d(angle) is the displacement across the radius over the radius.
  const Eigen::Vector2d expected(-std::sin(angle) / radius, std::cos(angle) / radius);
  CHECK(std::abs(found.value - angle) <= kRoundOff);
  CHECK((found.gradient - expected).norm() <= kRoundOff * expected.norm());
}

TEST_CASE("A constant has no gradient and decisions see the plain value", "[core][base]") {
  const Dual<2> constant = 4.0;
  CHECK(constant.gradient.norm() == 0.0);
  CHECK(value_of(constant) == 4.0);
  CHECK(value_of(3.0) == 3.0);
  CHECK(value_of(Dual<2>::variable(-2.0, 1)) == -2.0);
}
