#include "core/compliance/local/strip_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/base/root.hpp"
#include "core/base/units.hpp"

namespace flankwright {
namespace {

using units::pi;

constexpr double stationary = 1e-14;  ///< width of a root's bracket for psi [rad]: f hardly changes there

double lambda(double psi, double phi) { return std::log(std::abs(std::sin(0.5 * (psi + phi)) / std::sin(0.5 * (psi - phi)))); }

/// Slope of the pressure over psi and its own slope, pi rho f' and pi rho f'', with q = pi rho/R + phi:
///
///     pi rho f' = q cos psi + sin phi - sin psi Lambda,     pi rho f'' = -q sin psi - cos psi Lambda + sin psi sin phi/(cos phi - cos psi).
struct Fall {
  double slope, curvature;
};

Fall fall_at(double psi, double phi, double q) {
  const double s = std::sin(psi), c = std::cos(psi), sum = std::sin(0.5 * (psi + phi)), difference = std::sin(0.5 * (psi - phi));
  const double steep = std::log(std::abs(sum / difference));
  // cos phi - cos psi as a product: at angles of 1e-8 both cosines are the same number.
  return {q * c + std::sin(phi) - s * steep, -q * s - c * steep + 0.5 * s * std::sin(phi) / (sum * difference)};
}

/// The strip of one angle in units of its half width: k, N = e/l, S = (L/l)^2 and B, by which d(e/L)/d(cos phi) = B/sqrt(S).
struct Strip {
  double cosine, sine, phi, k;

  Strip(double u, double ratio) : cosine(u), sine(std::sqrt((1.0 - u) * (1.0 + u))), phi(std::atan2(sine, u)), k(ratio) {}

  double moment() const { return sine - phi * cosine; }
  double middle() const { return -k * moment(); }
  double edge() const { return cosine + middle(); }
  double square() const { return 1.0 + k * (phi - sine * cosine); }
  double steepness() const { return 1.0 + k * phi + edge() * k * sine / square(); }
};

/// cos(phi) at which e/L is x, -sqrt(1 + k pi) < x < 1: Newton's steps inside a bracket. As a function of cos(phi) e/L rises with a slope
/// that has neither zero nor pole, and a curvature of about (1 + k)/sin(phi). The start is the angle of the sharp edge, see StripContact, with
/// k (phi^3/3 - phi^5/30) for its q; where that is no small angle, it is on the lines through the values at phi = 0, pi/2 and pi.
double cosine_of_kink(double x, double k) {
  double low = -1.0, high = 1.0, u = 0.0;
  const double t = std::sqrt(x * x + 3.0) - x, narrow = std::cbrt(1.5 * (t * t - 1.0) / k);
  if (narrow < 1.5) {
    u = std::cos(narrow * (1.0 + narrow * narrow / 30.0));
  } else {
    const double middle = -k / std::sqrt(1.0 + 0.5 * pi * k), last = -std::sqrt(1.0 + pi * k);
    u = 0.99 * (x > middle ? (x - middle) / (1.0 - middle) : (x - middle) / (middle - last));
  }
  // Each step at least halves the bracket or is Newton's; double precision needs no more.
  for (int step = 0; step < 100; ++step) {
    const Strip strip(u, k);
    const double root = std::sqrt(strip.square()), excess = strip.edge() / root - x, back = excess * root / strip.steepness();
    // What the step leaves is its square times the curvature.
    if (back * back * (1.0 + k) <= std::numeric_limits<double>::epsilon() * strip.sine) return std::clamp(u - back, -1.0, 1.0);
    (excess > 0.0 ? high : low) = u;
    double next = u - back;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == u) return u;
    u = next;
  }
  return u;
}

}  // namespace

StripContact::StripContact(const RoundedEdge& edge, double relative_radius, double contact_modulus, double line_load)
    : edge_(edge), radius_(relative_radius), modulus_(contact_modulus), load_(line_load) {
  const double rho = edge.radius, e = edge.distance, R = relative_radius;
  assert(rho >= 0.0 && R > 0.0 && contact_modulus > 0.0 && line_load > 0.0 && std::isfinite(e));
  const double flank_width = std::sqrt(4.0 * line_load * R / (pi * contact_modulus));
  const double x = e / flank_width;
  if (rho == 0.0 && x < 1.0) {
    const double t = std::sqrt(x * x + 3.0) - x, q = punch_ = 0.5 * (t * t - 1.0), S = t * t, N = 1.0 - q;
    phi_ = 0.0;
    const double l = half_width_ = flank_width / t;
    middle_ = -l * q;
    growth_ = 0.5 * S / (S + N);
    half_width_by_edge_ = 1.0 / (S + N);
    rise_ = l * l * (q * q + 0.5 - (N >= 0.0 ? 0.0 : N * N)) / (2.0 * R);
    rise_by_edge_ = -l * q / R + 2.0 * line_load / (pi * contact_modulus * l) * half_width_by_edge_ + (e >= 0.0 ? 0.0 : -e / R);
    return;
  }
  const double k = rho > 0.0 ? R / (pi * rho) : std::numeric_limits<double>::infinity();
  if (x >= 1.0 || x <= -std::sqrt(1.0 + k * pi)) {
    const bool inside = x >= 1.0;
    const double relative = inside ? R : R * rho / (R + rho);
    phi_ = inside ? 0.0 : pi;
    half_width_ = std::sqrt(4.0 * line_load * relative / (pi * contact_modulus));
    middle_ = inside ? 0.0 : e * R / (R + rho);
    growth_ = 0.5;
    rise_ = line_load / (pi * contact_modulus);
    half_width_by_edge_ = rise_by_edge_ = 0.0;
    return;
  }
  const Strip strip(cosine_of_kink(x, k), k);
  const double S = strip.square(), N = strip.edge(), B = strip.steepness(), M = strip.middle();
  phi_ = strip.phi;
  steepness_ = B;
  offset_ = N;
  const double l = half_width_ = flank_width / std::sqrt(S);
  middle_ = l * M;
  growth_ = 0.5 * (1.0 - k * strip.sine * N / (B * S));
  half_width_by_edge_ = k * strip.sine / (B * S);
  const double c = strip.cosine, bend = phi_ * (0.5 + c * c) - 1.5 * strip.sine * c;
  const double least = N >= 0.0 ? 0.0 : N * N / (2.0 * (R + rho));
  rise_ = l * l * ((M * M + 0.5) / (2.0 * R) + bend / (2.0 * pi * rho) - least);
  // dh/de weighted likewise, and what the strip's own change adds: w u does not change with l, but for u's logarithm.
  rise_by_edge_ =
      -l * strip.moment() / (pi * rho) + 2.0 * line_load / (pi * contact_modulus * l) * half_width_by_edge_ + (e >= 0.0 ? 0.0 : -e / (R + rho));
}

/// p = E' l/2 f(psi) at s = m + l cos(psi), f in 1/mm [Johnson, 1985, eq. 2.41]:
///
///     f = sin psi/R + (phi sin psi + (cos psi - cos phi) Lambda)/(pi rho),   Lambda = log |sin((psi + phi)/2)/sin((psi - phi)/2)|.
double StripContact::shape(double psi) const {
  const double hertz = std::sin(psi) / radius_;
  if (punch_ > 0.0) return hertz + punch_ / (radius_ * std::tan(0.5 * psi));
  if (phi_ == 0.0) return hertz;
  if (phi_ == pi) return hertz + std::sin(psi) / edge_.radius;
  const double rise = 2.0 * std::sin(0.5 * (phi_ + psi)) * std::sin(0.5 * (phi_ - psi));  // cos psi - cos phi
  const double bend = rise == 0.0 ? 0.0 : rise * lambda(psi, phi_);
  return hertz + (phi_ * std::sin(psi) + bend) / (pi * edge_.radius);
}

double StripContact::shape_slope(double psi) const {
  return std::cos(psi) / radius_ + (phi_ * std::cos(psi) + std::sin(phi_) - std::sin(psi) * lambda(psi, phi_)) / (pi * edge_.radius);
}

/// At phi f falls infinitely steeply, so that one maximum lies on the rounding, psi < phi. By log(phi - psi) the slope is nearly straight there:
/// Newton's steps inside a bracket. The start is where the maximum lies for small roundings.
double StripContact::highest_on_edge() const {
  const double q = pi * edge_.radius / radius_ + phi_, relative = phi_ / pi;
  constexpr double last = 1.0 - 4.0 * std::numeric_limits<double>::epsilon();  // psi/phi: beyond it psi has no digits left
  double low = 0.0, high = phi_, psi = phi_ * (0.84 - 0.34 * relative * relative);
  for (int step = 0; step < 100; ++step) {
    const auto [slope, curvature] = fall_at(psi, phi_, q);
    const double rest = phi_ - psi;
    (slope > 0.0 ? low : high) = psi;
    double next = phi_ - rest * std::exp(slope / (curvature * rest));
    if (next >= last * phi_ && slope > 0.0) return last * phi_;
    // The error that is left is the square of the step's. Before the bracket has its say: round-off may be on the wrong side of the root.
    if (std::abs(next - psi) <= 1e-7 * rest) return next;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    psi = next;
  }
  return psi;
}

/// Another one lies on the flank, phi < psi <= pi/2, where f' rises above 0 there. Its own maximum is where f'' falls through 0.
std::optional<double> StripContact::highest_on_flank() const {
  const double end = 0.5 * pi;
  if (phi_ >= end) return std::nullopt;
  const auto slope = [this](double psi) { return shape_slope(psi); };
  const auto curvature = [this](double psi) { return fall_at(psi, phi_, pi * edge_.radius / radius_ + phi_).curvature; };
  const double at_end = curvature(end);
  if (at_end >= 0.0) return std::nullopt;
  const double steepest = bracketed_root(curvature, phi_, std::numeric_limits<double>::infinity(), end, at_end, stationary).x;
  const double most = slope(steepest), least = slope(end);
  if (most <= 0.0 || least > 0.0) return std::nullopt;
  return bracketed_root(slope, steepest, most, end, least, stationary).x;
}

/// At a maximum over psi the derivatives are those at held psi: df/dphi = sin(phi) Lambda/(pi rho), and sin(phi) cancels against that of N.
StripContact::Peak StripContact::maximum(double psi) const {
  const double l = half_width_, f = shape(psi), by_phi = lambda(psi, phi_) / (pi * edge_.radius * steepness_);
  return {0.5 * modulus_ * l * f, 0.5 * modulus_ * l / load_ * (f * growth_ + 0.5 * offset_ * by_phi),
          0.5 * modulus_ * (f * half_width_by_edge_ - by_phi)};
}

/// The integral of p over s from the edge on, in parts of w, with M = sin phi - phi cos phi,
///
///     q = [(phi - sin phi cos phi) (1 + k phi) + k sin phi M]/(pi S),     dq/dphi = 2 sin^2 phi (1 + k (2 phi - pi q))/(pi S).
///
/// It is a function of e/L alone, which falls as sqrt(w) grows.
StripContact::EdgeLoad StripContact::edge_load() const {
  const double k = radius_ / (pi * edge_.radius), s = std::sin(phi_), c = std::cos(phi_);
  const double S = 1.0 + k * (phi_ - s * c);
  const double q = ((phi_ - s * c) * (1.0 + k * phi_) + k * s * (s - phi_ * c)) / (pi * S);
  const double by_edge = -2.0 * s * (1.0 + k * (2.0 * phi_ - pi * q)) / (pi * S * steepness_ * half_width_);
  return {load_ * q, q - 0.5 * edge_.distance * by_edge, load_ * by_edge};
}

StripContact::Peak StripContact::crest() const { return phi_ == 0.0 || phi_ == pi ? peaks().on_edge : maximum(highest_on_edge()); }

StripContact::Peaks StripContact::peaks() const {
  if (phi_ == 0.0 || phi_ == pi) {
    const double pressure = punch_ > 0.0 ? std::sqrt(load_ * modulus_ / (pi * radius_)) : 2.0 * load_ / (pi * half_width_);
    const Peak hertz{pressure, 0.5 * pressure / load_, 0.0};
    if (phi_ == 0.0) return {hertz, {}, {}};
    return {hertz, hertz, {load_, 1.0, 0.0}};
  }
  const Peak on_edge = maximum(highest_on_edge());
  const std::optional<double> on_flank = highest_on_flank();
  const Peak highest = on_flank && shape(*on_flank) * 0.5 * modulus_ * half_width_ > on_edge.pressure ? maximum(*on_flank) : on_edge;
  return {highest, on_edge, edge_load()};
}

double StripContact::pressure(double s) const {
  const double cosine = (s - middle_) / half_width_;
  if (std::abs(cosine) >= 1.0) return 0.0;
  return 0.5 * modulus_ * half_width_ * shape(std::acos(cosine));
}

}  // namespace flankwright
