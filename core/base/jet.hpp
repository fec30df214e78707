#pragma once

#include <cmath>

#include "core/base/dual.hpp"

namespace flankwright {

/// A function of two parameters (u, v) at one point: value, gradient and second derivatives, all exact. As a number it
/// is second-order forward differentiation; as plain data it is a surface's value with its derivatives.
struct Jet {
  double value{0.0};
  double u{0.0}, v{0.0};             ///< first derivatives
  double uu{0.0}, uv{0.0}, vv{0.0};  ///< second derivatives

  Jet() = default;
  Jet(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): constants mix freely with variables
  Jet(double f, double fu, double fv, double fuu, double fuv, double fvv) : value(f), u(fu), v(fv), uu(fuu), uv(fuv), vv(fvv) {}

  static Jet variable_u(double at) { return {at, 1.0, 0.0, 0.0, 0.0, 0.0}; }
  static Jet variable_v(double at) { return {at, 0.0, 1.0, 0.0, 0.0, 0.0}; }

  Jet& operator+=(const Jet& b) { return *this = *this + b; }
  Jet& operator-=(const Jet& b) { return *this = *this - b; }

  friend Jet operator-(const Jet& a) { return {-a.value, -a.u, -a.v, -a.uu, -a.uv, -a.vv}; }
  friend Jet operator+(const Jet& a, const Jet& b) { return {a.value + b.value, a.u + b.u, a.v + b.v, a.uu + b.uu, a.uv + b.uv, a.vv + b.vv}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return a + (-b); }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value,
            a.u * b.value + a.value * b.u,
            a.v * b.value + a.value * b.v,
            a.uu * b.value + 2.0 * a.u * b.u + a.value * b.uu,
            a.uv * b.value + a.u * b.v + a.v * b.u + a.value * b.uv,
            a.vv * b.value + 2.0 * a.v * b.v + a.value * b.vv};
  }
  friend Jet operator/(const Jet& a, const Jet& b);
};

/// f(a) from f, f' and f'' at a.value.
inline Jet chain(const Jet& a, double f, double df, double ddf) {
  return {f, df * a.u, df * a.v, df * a.uu + ddf * a.u * a.u, df * a.uv + ddf * a.u * a.v, df * a.vv + ddf * a.v * a.v};
}

/// f(a, b), f a function of two variables with the derivatives in `f` (f.u with respect to a, f.v to b).
inline Jet chain(const Jet& f, const Jet& a, const Jet& b) {
  const auto second = [&](double a1, double b1, double a2, double b2, double a12, double b12) {
    return f.u * a12 + f.v * b12 + f.uu * a1 * a2 + f.uv * (a1 * b2 + a2 * b1) + f.vv * b1 * b2;
  };
  return {f.value,
          f.u * a.u + f.v * b.u,
          f.u * a.v + f.v * b.v,
          second(a.u, b.u, a.u, b.u, a.uu, b.uu),
          second(a.u, b.u, a.v, b.v, a.uv, b.uv),
          second(a.v, b.v, a.v, b.v, a.vv, b.vv)};
}
template <int N>
Dual<N> chain(const Jet& f, const Dual<N>& a, const Dual<N>& b) {
  return {f.value, f.u * a.gradient + f.v * b.gradient};
}
inline double chain(const Jet& f, double, double) { return f.value; }

inline Jet operator/(const Jet& a, const Jet& b) {
  const double r = 1.0 / b.value;
  return a * chain(b, r, -r * r, 2.0 * r * r * r);
}
inline Jet sqrt(const Jet& a) {
  const double root = std::sqrt(a.value);
  return chain(a, root, 0.5 / root, -0.25 / (root * a.value));
}
inline Jet sin(const Jet& a) {
  const double s = std::sin(a.value), c = std::cos(a.value);
  return chain(a, s, c, -s);
}
inline Jet cos(const Jet& a) {
  const double s = std::sin(a.value), c = std::cos(a.value);
  return chain(a, c, -s, -c);
}
inline Jet atan2(const Jet& y, const Jet& x) {
  const double square = x.value * x.value + y.value * y.value;
  const double fy = x.value / square, fx = -y.value / square;
  return chain(Jet{std::atan2(y.value, x.value), fy, fx, 2.0 * fy * fx, fx * fx - fy * fy, -2.0 * fy * fx}, y, x);
}

inline double value_of(const Jet& a) { return a.value; }

}  // namespace flankwright
