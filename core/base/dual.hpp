#pragma once

#include <Eigen/Core>
#include <cmath>

namespace flankwright {

/// Forward-mode derivative number: a value and its gradient with respect to N independent variables. Exact to round-off.
template <int N>
struct Dual {
  using Gradient = Eigen::Matrix<double, N, 1>;

  double value{0.0};
  Gradient gradient{Gradient::Zero()};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT(google-explicit-constructor): constants mix freely with variables
  Dual(double v, const Gradient& g) : value(v), gradient(g) {}

  /// Independent variable number `index`.
  static Dual variable(double v, int index) { return {v, Gradient::Unit(index)}; }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }

  friend Dual operator-(const Dual& a) { return {-a.value, -a.gradient}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.gradient + b.gradient}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.gradient - b.gradient}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.value * b.value, a.gradient * b.value + b.gradient * a.value}; }
  // With plain numbers on one side the other gradient is not worth the arithmetic.
  friend Dual operator+(const Dual& a, double b) { return {a.value + b, a.gradient}; }
  friend Dual operator+(double a, const Dual& b) { return {a + b.value, b.gradient}; }
  friend Dual operator-(const Dual& a, double b) { return {a.value - b, a.gradient}; }
  friend Dual operator-(double a, const Dual& b) { return {a - b.value, -b.gradient}; }
  friend Dual operator*(const Dual& a, double b) { return {a.value * b, a.gradient * b}; }
  friend Dual operator*(double a, const Dual& b) { return {a * b.value, b.gradient * a}; }
  friend Dual operator/(const Dual& a, double b) { return {a.value / b, a.gradient / b}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.value / b.value;
    return {q, (a.gradient - q * b.gradient) / b.value};
  }
};

template <int N>
Dual<N> sqrt(const Dual<N>& a) {
  const double root = std::sqrt(a.value);
  return {root, a.gradient / (2.0 * root)};
}

template <int N>
Dual<N> sin(const Dual<N>& a) {
  return {std::sin(a.value), a.gradient * std::cos(a.value)};
}

template <int N>
Dual<N> cos(const Dual<N>& a) {
  return {std::cos(a.value), -a.gradient * std::sin(a.value)};
}

template <int N>
Dual<N> atan2(const Dual<N>& y, const Dual<N>& x) {
  const double square = x.value * x.value + y.value * y.value;
  return {std::atan2(y.value, x.value), (x.value * y.gradient - y.value * x.gradient) / square};
}

/// The plain value, for decisions such as on which side of a relief's start a point lies.
inline double value_of(double a) { return a; }
template <int N>
double value_of(const Dual<N>& a) {
  return a.value;
}

}  // namespace flankwright
