#include "core/flank/bicubic_spline.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/common/random.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

using Points = std::vector<double>;

// Values, spacings and derivatives here are of order 1 to 100.
constexpr double spline_round_off = 1e-12;

// Not equidistant, spacing 0.5 .. 2.
const Points uneven_u{-3.0, -2.2, -1.2, 0.0, 0.5, 1.7, 2.4, 4.0};
const Points uneven_v{0.0, 2.0, 2.5, 4.0, 4.8, 6.0, 7.7};

template <class Function>
GridSamples sample(const Points& u, const Points& v, const Function& f) {
  GridSamples samples{u, v, Eigen::MatrixXd(u.size(), v.size())};
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (std::size_t j = 0; j < v.size(); ++j) {
      samples.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = f(u[i], v[j]);
    }
  }
  return samples;
}

Points even(double from, double to, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(from + (to - from) * i / (count - 1));
  return points;
}

/// The spline through all samples.
SplineFit interpolating_spline(const GridSamples& samples) {
  return fit_spline(samples, {most_spline_pieces(static_cast<int>(samples.u.size())), most_spline_pieces(static_cast<int>(samples.v.size()))});
}

/// Random samples on the uneven grid: a surface with all derivatives in action.
GridSamples rough_samples() {
  tests::Random32 random(7);
  return sample(uneven_u, uneven_v, [&](double, double) { return random.coarse(-1.0, 1.0); });
}

double largest_difference(const Jet& a, const Jet& b) {
  const Jet d = a - b;
  return std::max({std::abs(d.value), std::abs(d.u), std::abs(d.v), std::abs(d.uu), std::abs(d.uv), std::abs(d.vv)});
}

Jet polynomial(const Jet& x, const std::array<double, 4>& c) { return c[0] + x * (c[1] + x * (c[2] + x * Jet(c[3]))); }
Jet variable_u(double u) { return Jet::variable_u(u); }
Jet variable_v(double v) { return Jet::variable_v(v); }

/// A polynomial of the given degrees along u and v.
Jet bicubic(double u, double v, int degree_u, int degree_v) {
  const std::array<double, 4> a{1.0, -0.7, 0.3, -0.11}, b{0.4, 0.5, -0.2, 0.06};
  std::array<double, 4> cut_a{}, cut_b{};
  std::copy_n(a.begin(), degree_u + 1, cut_a.begin());
  std::copy_n(b.begin(), degree_v + 1, cut_b.begin());
  return polynomial(variable_u(u), cut_a) * polynomial(variable_v(v), cut_b) + polynomial(variable_u(u), cut_a);
}

}  // namespace

TEST_CASE("A spline of any number of pieces reproduces bicubic polynomials with all derivatives", "[core][flank][spline][closed-form]") {
  const auto f = [](double u, double v) { return bicubic(u, v, 3, 3).value; };
  const GridSamples samples = sample(uneven_u, uneven_v, f);
  const int pieces_u = GENERATE(1, 2, 3, 4, 5), pieces_v = GENERATE(1, 2, 3, 4);
  const SplineFit fit = fit_spline(samples, {pieces_u, pieces_v});
  CAPTURE(pieces_u, pieces_v);
  for (double u = -3.0; u <= 4.0; u += 0.35) {
    for (double v = 0.0; v <= 7.7; v += 0.35) {
      CHECK(largest_difference(fit.spline.at(u, v), bicubic(u, v, 3, 3)) <= 10.0 * spline_round_off);
    }
  }
  CHECK(fit.largest <= spline_round_off);
  CHECK(fit.rms <= fit.largest);
}

TEST_CASE("Few points along a direction give the polynomial through them", "[core][flank][spline][closed-form]") {
  const int m = GENERATE(2, 3, 4, 5), n = GENERATE(2, 3, 4, 6);
  CHECK(spline_degree(m) == std::min(3, m - 1));
  CHECK(most_spline_pieces(m) == (m == 5 ? 2 : 1));
  const Points u = even(1.0, 3.0, m), v = even(-2.0, 2.0, n);
  const int degree_u = spline_degree(m), degree_v = spline_degree(n);
  const BicubicSpline spline = interpolating_spline(sample(u, v, [&](double a, double b) { return bicubic(a, b, degree_u, degree_v).value; })).spline;
  for (const double a : {1.0, 1.3, 2.9}) {
    for (const double b : {-2.0, 0.1, 1.6}) {
      CHECK(largest_difference(spline.at(a, b), bicubic(a, b, degree_u, degree_v)) <= 10.0 * spline_round_off);
    }
  }
}

TEST_CASE("The interpolating spline passes through every sample", "[core][flank][spline]") {
  const GridSamples samples = rough_samples();
  const SplineFit fit = interpolating_spline(samples);
  for (std::size_t i = 0; i < samples.u.size(); ++i) {
    for (std::size_t j = 0; j < samples.v.size(); ++j) {
      const double sample = samples.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      CHECK(std::abs(fit.spline.at(samples.u[i], samples.v[j]).value - sample) <= spline_round_off);
    }
  }
  CHECK(fit.largest <= spline_round_off);
}

TEST_CASE("The breaks are the third to the third last point: truncated cubics that start there are reproduced",
          "[core][flank][spline][closed-form]") {
  // (u - u_k)^3 for u > u_k, else 0, is a cubic spline with one break, at u_k.
  const std::size_t k = GENERATE(1, 2, 3, 4, 5, 6);
  const auto truncated = [&](double u, double) {
    const double beyond = std::max(0.0, u - uneven_u[k]);
    return beyond * beyond * beyond;
  };
  const BicubicSpline spline = interpolating_spline(sample(uneven_u, uneven_v, truncated)).spline;
  double largest = 0.0;
  for (double u = -3.0; u <= 4.0; u += 0.1) largest = std::max(largest, std::abs(spline.at(u, 3.0).value - truncated(u, 0.0)));
  const bool is_break = k >= 2 && k <= 5;
  CAPTURE(k, largest);
  CHECK((largest <= 100.0 * spline_round_off) == is_break);
}

TEST_CASE("Value, slopes and curvatures are continuous across every joint, those of the extension included", "[core][flank][spline]") {
  const BicubicSpline spline = interpolating_spline(rough_samples()).spline;
  // Round-off on second derivatives of order 10, and a step of two representable numbers.
  constexpr double step_error = 1e-11;
  const auto before = [](double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); };
  Points joints_u = uneven_u, joints_v = uneven_v;
  joints_u.insert(joints_u.end(), {-3.0 - 0.8, 4.0 + 1.6});
  joints_v.insert(joints_v.end(), {0.0 - 2.0, 7.7 + 1.7});
  for (const double u : joints_u) {
    for (double v = -4.0; v < 12.0; v += 0.41) {
      CAPTURE(u, v);
      CHECK(largest_difference(spline.at(before(u), v), spline.at(u, v)) <= step_error);
    }
  }
  for (const double v : joints_v) {
    for (double u = -6.0; u < 8.0; u += 0.41) {
      CAPTURE(u, v);
      CHECK(largest_difference(spline.at(u, before(v)), spline.at(u, v)) <= step_error);
    }
  }
}

TEST_CASE("Spline derivatives agree with central differences, inside and beyond the grid", "[core][flank][spline]") {
  const BicubicSpline spline = interpolating_spline(rough_samples()).spline;
  constexpr double h = 1e-5;
  constexpr double difference_error = 1e-7;  // discretisation: h^2 or, across a joint, h times third derivatives of order 100; round-off/h
  for (double u = -5.03; u < 6.5; u += 0.53) {
    for (double v = -3.07; v < 11.0; v += 0.47) {
      const Jet f = spline.at(u, v);
      const Jet du = (spline.at(u + h, v) - spline.at(u - h, v)) / Jet(2.0 * h);
      const Jet dv = (spline.at(u, v + h) - spline.at(u, v - h)) / Jet(2.0 * h);
      CAPTURE(u, v);
      CHECK(std::abs(du.value - f.u) <= difference_error);
      CHECK(std::abs(dv.value - f.v) <= difference_error);
      CHECK(std::abs(du.u - f.uu) <= difference_error);
      CHECK(std::abs(du.v - f.uv) <= difference_error);
      CHECK(std::abs(dv.u - f.uv) <= difference_error);
      CHECK(std::abs(dv.v - f.vv) <= difference_error);
    }
  }
}

TEST_CASE("Interpolation of a smooth function converges with the fourth power of the spacing, curvature with the second", "[core][flank][spline]") {
  const auto f = [](const Jet& u, const Jet& v) { return sin(u) * cos(0.7 * v) + 0.2 * u * v; };
  std::vector<double> value_errors, curvature_errors;
  for (const int intervals : {12, 24, 48}) {
    const BicubicSpline spline = interpolating_spline(sample(even(-2.0, 2.0, intervals + 1), even(-3.0, 3.0, intervals + 1), [&](double u, double v) {
                                   return f(u, v).value;
                                 })).spline;
    double value = 0.0, curvature = 0.0;
    for (double u = -2.0; u <= 2.0; u += 0.0137) {
      for (double v = -3.0; v <= 3.0; v += 0.0371) {
        const Jet error = spline.at(u, v) - f(variable_u(u), variable_v(v));
        value = std::max(value, std::abs(error.value));
        curvature = std::max({curvature, std::abs(error.uu), std::abs(error.uv), std::abs(error.vv)});
      }
    }
    value_errors.push_back(value);
    curvature_errors.push_back(curvature);
  }
  for (std::size_t i = 0; i + 1 < value_errors.size(); ++i) {
    CAPTURE(value_errors[i], value_errors[i + 1], curvature_errors[i], curvature_errors[i + 1]);
    CHECK(std::log2(value_errors[i] / value_errors[i + 1]) == tests::about(4.0, 0.35));
    CHECK(std::log2(curvature_errors[i] / curvature_errors[i + 1]) == tests::about(2.0, 0.35));
  }
}

TEST_CASE("Beyond the grid the curvature of the border fades and a straight line follows", "[core][flank][spline][closed-form]") {
  const BicubicSpline spline = interpolating_spline(rough_samples()).spline;
  // Border, direction outwards and outermost interval of u.
  const auto [border, outwards, interval] = GENERATE(table<double, double, double>({{-3.0, -1.0, 0.8}, {4.0, 1.0, 1.6}}));
  const double v = GENERATE(-1.0, 0.6, 3.3, 8.5);
  const Jet edge = spline.at(border, v);
  const double slope = outwards * edge.u;
  for (const double d : {0.3, 0.7, 1.5, 1.7, 20.0}) {
    const Jet f = spline.at(border + outwards * d, v);
    const double bent = d <= interval ? d * d * (3.0 * interval - d) / (6.0 * interval) : interval * (3.0 * d - interval) / 6.0;
    CAPTURE(border, v, d);
    CHECK(std::abs(f.value - (edge.value + slope * d + edge.uu * bent)) <= 10.0 * spline_round_off * (1.0 + d));
    CHECK(std::abs(f.uu - edge.uu * std::max(0.0, 1.0 - d / interval)) <= 10.0 * spline_round_off);
    // The slope stays between that of the border and that of the line.
    const double last = slope + 0.5 * edge.uu * interval;
    CHECK(outwards * f.u <= std::max(slope, last) + spline_round_off);
    CHECK(outwards * f.u >= std::min(slope, last) - spline_round_off);
  }
}

TEST_CASE("At a corner the extension is the same along u first or v first", "[core][flank][spline]") {
  // Of a product f(u) g(v) the spline is the product of splines, beyond the grid too.
  const auto f = [](double u) { return std::exp(0.4 * u); };
  const auto g = [](double v) { return 1.0 / (1.0 + v); };
  const auto spline_of = [](const auto& function) { return interpolating_spline(sample(uneven_u, uneven_v, function)).spline; };
  const BicubicSpline product = spline_of([&](double u, double v) { return f(u) * g(v); });
  const BicubicSpline along_u = spline_of([&](double u, double) { return f(u); });
  const BicubicSpline along_v = spline_of([&](double, double v) { return g(v); });
  for (const double u : {-6.0, -3.5, 1.1, 4.5, 9.0}) {
    for (const double v : {-5.0, -0.7, 2.2, 8.5, 12.0}) {
      CAPTURE(u, v);
      CHECK(largest_difference(product.at(u, v), along_u.at(u, v) * along_v.at(u, v)) <= 100.0 * spline_round_off);
    }
  }
}

TEST_CASE("Beyond a ragged edge the extension grows linearly where the cubic of the last piece runs away", "[core][flank][spline]") {
  // +-1 alternating: the worst that noise of that size can do.
  const auto alternating = [](double u, double) { return std::lround(u) % 2 == 0 ? 1.0 : -1.0; };
  const BicubicSpline spline = interpolating_spline(sample(even(0.0, 8.0, 9), {0.0, 1.0}, alternating)).spline;
  const Jet edge = spline.at(8.0, 0.5);
  const double third = edge.uu - spline.at(7.0, 0.5).uu;  // of the last cubic, over an interval of 1
  const auto cubic = [&](double d) { return edge.value + d * (edge.u + d * (0.5 * edge.uu + d * third / 6.0)); };
  REQUIRE(spline.at(7.2, 0.5).value == tests::about(cubic(-0.8), spline_round_off));
  CHECK(std::abs(spline.at(10.0, 0.5).value) <= 0.5 * std::abs(cubic(2.0)));
  CHECK(spline.at(16.0, 0.5).value - edge.value <= 8.0 * (edge.u + 0.5 * edge.uu));
}

TEST_CASE("A fit with fewer pieces is the orthogonal projection of the samples", "[core][flank][spline][least-squares]") {
  const GridSamples samples = rough_samples();
  const int pieces_u = GENERATE(1, 3), pieces_v = GENERATE(1, 2);
  const SplineFit fit = fit_spline(samples, {pieces_u, pieces_v});
  const GridSamples fitted = sample(uneven_u, uneven_v, [&](double u, double v) { return fit.spline.at(u, v).value; });
  const Eigen::MatrixXd residual = samples.values - fitted.values;
  CHECK(std::abs(residual.cwiseProduct(fitted.values).sum()) <= spline_round_off);
  CHECK(fit_spline(fitted, {pieces_u, pieces_v}).largest <= spline_round_off);
  const SplineFit nothing = fit_spline({uneven_u, uneven_v, residual}, {pieces_u, pieces_v});
  CHECK(std::abs(nothing.spline.at(0.3, 3.1).value) <= spline_round_off);
  CHECK(fit.rms == Approx(std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()))).epsilon(1e-12));
  CHECK(fit.largest == Approx(residual.cwiseAbs().maxCoeff()).epsilon(1e-12));
  CHECK(fit.rms > 0.1);
}

TEST_CASE("Every allowed number of pieces determines the fit", "[core][flank][spline][least-squares]") {
  const auto f = [](double u, double v) { return bicubic(u, v, 3, 1).value; };
  tests::Random32 random(3);
  for (int n = 4; n <= 40; ++n) {
    Points u{0.0};
    while (u.size() < static_cast<std::size_t>(n)) u.push_back(u.back() + 0.3 + 0.001 * static_cast<double>(random.below(1000)));
    for (double& x : u) x *= 4.0 / u.back();
    const GridSamples samples = sample(u, {0.0, 1.0}, f);
    for (int pieces = 1; pieces <= most_spline_pieces(n); ++pieces) {
      const SplineFit fit = fit_spline(samples, {pieces, 1});
      CAPTURE(n, pieces);
      CHECK(std::abs(fit.spline.at(2.3, 0.4).value - f(2.3, 0.4)) <= 10.0 * spline_round_off);
    }
  }
}

TEST_CASE("Symmetric samples give a symmetric spline and zero gives zero", "[core][flank][spline]") {
  const int pieces = GENERATE(2, 4, 6);
  const auto f = [](double u, double v) { return std::cos(u) * std::exp(-v * v) + v * v * v * v; };
  const BicubicSpline spline = fit_spline(sample(even(-2.0, 2.0, 9), even(-1.0, 1.0, 15), f), {pieces, 2 * pieces}).spline;
  for (const double u : {0.3, 1.1, 2.6}) {
    for (const double v : {0.2, 0.9, 1.4}) {
      const Jet a = spline.at(u, v), b = spline.at(-u, v), c = spline.at(u, -v);
      CHECK(largest_difference(a, {b.value, -b.u, b.v, b.uu, -b.uv, b.vv}) <= 10.0 * spline_round_off);
      CHECK(largest_difference(a, {c.value, c.u, -c.v, c.uu, -c.uv, c.vv}) <= 10.0 * spline_round_off);
    }
  }
  const SplineFit zero = fit_spline(sample(even(-2.0, 2.0, 9), even(-1.0, 1.0, 15), [](double, double) { return 0.0; }), {pieces, pieces});
  CHECK(largest_difference(zero.spline.at(0.7, 1.3), Jet()) == 0.0);
  CHECK(largest_difference(BicubicSpline().at(0.7, 1.3), Jet()) == 0.0);
}
