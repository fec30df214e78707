#include "core/compliance/local/contact_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

constexpr double spread = 0.1;  // e/h
/// Parts of a line at least so many times the longer one apart are as far apart as their middles.
constexpr double far_apart = 4.0;
/// A part shorter than this share of H is a place: G changes over it by a thousand-millionth at most, and differences of integrals have no more digits.
constexpr double a_place = 1e-6;

/// G and its integrals.
struct HalfSpace {
  double plane_strain, by_depth, e, H;

  HalfSpace(double nu, double h)
      : plane_strain(0.5 * (1.0 - nu * nu)), by_depth(0.25 * (1.0 + nu) * h * h), e(spread * h), H(h * std::sqrt(1.0 + spread * spread)) {}

  /// x of a leaning end; places beyond the face count as on it.
  double blunted(double sum_of_distances) const { return std::max(0.0, sum_of_distances) + e; }
  double at(double r) const {
    const double near = 1.0 / std::sqrt(r * r + e * e), far = 1.0 / std::sqrt(r * r + H * H);
    return plane_strain * (near - far) - by_depth * far * far * far;
  }
  double integral(double r) const {
    return plane_strain * (std::asinh(r / e) - std::asinh(r / H)) - by_depth / (H * H) * r / std::sqrt(r * r + H * H);
  }
  /// Of integral(), but for a constant.
  double second_integral(double r) const {
    const double near = std::sqrt(r * r + e * e), far = std::sqrt(r * r + H * H);
    return plane_strain * (r * (std::asinh(r / e) - std::asinh(r / H)) - near + far) - by_depth / (H * H) * far;
  }
  /// The mean of G over two parts of a line, a and b long, whose middles are r apart.
  double mean(double r, double a, double b) const {
    const double longer = std::max(a, b), shorter = std::min(a, b), half = 0.5 * longer;
    if (std::abs(r) >= far_apart * longer || longer < a_place * H) return at(r);
    if (shorter < a_place * H) return (integral(r + half) - integral(r - half)) / longer;
    const double half_sum = 0.5 * (a + b), half_difference = 0.5 * (a - b);
    return (second_integral(r + half_sum) - second_integral(r + half_difference) - second_integral(r - half_difference) +
            second_integral(r - half_sum)) /
           (a * b);
  }
};

/// The kernel of a leaning end and its integral from x to infinity.
struct LeaningEnd {
  double strength, reach;

  LeaningEnd(const FreeEnd& end, std::size_t face, double h) : strength(end.leaning[face]), reach(end.leaning_reach * h) {}

  double at(double x) const { return strength * reach * reach / (x * (x * x + reach * reach)); }
  double beyond(double x) const { return 0.5 * strength * std::log1p(reach / x * (reach / x)); }
};

}  // namespace

ContactKernel::ContactKernel(double poissons_ratio, const Range& face, double lean, bool free_ends)
    : poissons_ratio_(poissons_ratio), face_(face), end_(free_ends ? FreeEnd(poissons_ratio, lean) : FreeEnd()) {}

double ContactKernel::between(double s, double t, double depth) const {
  const HalfSpace half_space(poissons_ratio_, depth);
  const double from_begin = s + t - 2.0 * face_.begin, from_end = 2.0 * face_.end - s - t;
  const double sum = half_space.at(s - t) + half_space.at(from_begin) + half_space.at(from_end);
  if (end_.leaning[0] == 0.0) return sum;
  return sum + LeaningEnd(end_, 0, depth).at(half_space.blunted(from_begin)) + LeaningEnd(end_, 1, depth).at(half_space.blunted(from_end));
}

double ContactKernel::between(const Range& one, const Range& other, double depth) const {
  const HalfSpace half_space(poissons_ratio_, depth);
  const double a = one.end - one.begin, b = other.end - other.begin, s = 0.5 * (one.begin + one.end), t = 0.5 * (other.begin + other.end);
  const double from_begin = s + t - 2.0 * face_.begin, from_end = 2.0 * face_.end - s - t;
  const double sum = half_space.mean(s - t, a, b) + half_space.mean(from_begin, a, b) + half_space.mean(from_end, a, b);
  if (end_.leaning[0] == 0.0) return sum;
  return sum + LeaningEnd(end_, 0, depth).at(half_space.blunted(from_begin)) + LeaningEnd(end_, 1, depth).at(half_space.blunted(from_end));
}

double ContactKernel::over(double s, const Range& load, double depth) const {
  const HalfSpace half_space(poissons_ratio_, depth);
  const double from_begin = s - 2.0 * face_.begin, from_end = 2.0 * face_.end - s;
  const auto part = [&](double near, double far) { return half_space.integral(far) - half_space.integral(near); };
  const double sum =
      part(load.begin - s, load.end - s) + part(from_begin + load.begin, from_begin + load.end) + part(from_end - load.end, from_end - load.begin);
  if (end_.leaning[0] == 0.0) return sum;
  const LeaningEnd first(end_, 0, depth), second(end_, 1, depth);
  const auto part_of_end = [&](const LeaningEnd& end, double near, double far) {
    return end.beyond(half_space.blunted(near)) - end.beyond(half_space.blunted(far));
  };
  return sum + part_of_end(first, from_begin + load.begin, from_begin + load.end) + part_of_end(second, from_end - load.end, from_end - load.begin);
}

}  // namespace flankwright
