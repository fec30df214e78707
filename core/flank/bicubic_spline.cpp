#include "core/flank/bicubic_spline.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

namespace flankwright {

namespace {

/// A polynomial of degree <= 3 a column, row a the coefficient of t^a.
using Polynomials = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 4>;

Eigen::Vector4d powers(double t) { return {1.0, t, t * t, t * t * t}; }

/// The same polynomials as functions of the distance from t.
Polynomials seen_from(double t, Polynomials p) {
  for (int lowest = 0; lowest < 3; ++lowest) {
    for (int a = 2; a >= lowest; --a) p.row(a) += t * p.row(a + 1);
  }
  return p;
}

std::vector<double> breaks_of(const std::vector<double>& points, int pieces) {
  const int intervals = static_cast<int>(points.size()) - 3;
  std::vector<double> breaks{points.front()};
  for (int k = 1; k < pieces; ++k) {
    const auto below = static_cast<std::size_t>(1 + k * intervals / pieces);
    const double part = static_cast<double>(k * intervals % pieces) / pieces;
    breaks.push_back(points[below] + part * (points[below + 1] - points[below]));
  }
  breaks.push_back(points.back());
  return breaks;
}

/// The B-splines that are not zero between breaks[piece] and breaks[piece + 1], in the distance from the former, by the
/// recurrence of Cox and de Boor. The outermost breaks are knots of full multiplicity.
Polynomials b_splines(const std::vector<double>& breaks, int piece, int degree) {
  const int last = static_cast<int>(breaks.size()) - 1;
  const auto knot = [&](int i) { return breaks[static_cast<std::size_t>(std::clamp(i, 0, last))]; };
  Polynomials p = Polynomials::Zero(4, degree + 1);
  p(0, 0) = 1.0;
  for (int d = 1; d <= degree; ++d) {
    for (int r = d; r >= 0; --r) {
      // The weight of a B-spline of degree d - 1 grows from 0 to 1 between the knots `zero` and `one`.
      const auto weighted = [&](int lower, double zero, double one) -> Eigen::Vector4d {
        const Eigen::Vector4d q = p.col(lower);
        return ((knot(piece) - zero) * q + Eigen::Vector4d(0.0, q[0], q[1], q[2])) / (one - zero);
      };
      Eigen::Vector4d sum = Eigen::Vector4d::Zero();
      if (r > 0) sum += weighted(r - 1, knot(piece - d + r), knot(piece + r));
      if (r < d) sum += weighted(r, knot(piece + r + 1), knot(piece - d + r + 1));
      p.col(r) = sum;
    }
  }
  return p;
}

/// The polynomials with their second derivatives at the origin, the border, falling linearly to zero at `length` from
/// it, which is negative below the grid.
Polynomials fading(Polynomials border, double length) {
  border.row(3) = -border.row(2) / (3.0 * length);
  return border;
}

/// What follows there.
Polynomials line_after(const Polynomials& fade, double length) {
  Polynomials line = seen_from(length, fade);
  line.bottomRows(2).setZero();
  return line;
}

/// The B-splines of one direction on every piece, those of the extension included.
struct Basis {
  SplineNet net;
  std::vector<Eigen::Index> first;     ///< number of the first B-spline that acts on a piece; the others follow it
  std::vector<Polynomials> b_splines;  ///< these, in the distance from the piece's origin
  Eigen::Index size;                   ///< number of B-splines
};

Basis make_basis(const std::vector<double>& points, int pieces) {
  const int degree = spline_degree(static_cast<int>(points.size()));
  const std::vector<double> breaks = breaks_of(points, pieces);
  const double down = points[0] - points[1], up = points[points.size() - 1] - points[points.size() - 2];
  const Polynomials lowest = b_splines(breaks, 0, degree);
  const Polynomials highest = seen_from(breaks[breaks.size() - 1] - breaks[breaks.size() - 2], b_splines(breaks, pieces - 1, degree));
  Basis basis;
  basis.size = pieces + degree;
  const auto add = [&basis](double origin, Eigen::Index first, const Polynomials& polynomials) {
    basis.net.origins.push_back(origin);
    basis.first.push_back(first);
    basis.b_splines.push_back(polynomials);
  };
  basis.net.origins.clear();
  add(breaks.front() + down, 0, line_after(fading(lowest, down), down));
  add(breaks.front(), 0, fading(lowest, down));
  for (int k = 0; k < pieces; ++k) add(breaks[static_cast<std::size_t>(k)], k, b_splines(breaks, k, degree));
  add(breaks.back(), pieces - 1, fading(highest, up));
  add(breaks.back() + up, pieces - 1, line_after(fading(highest, up), up));
  // Every piece starts at its origin, but for the two below the grid, which end there.
  basis.net.joints = basis.net.origins;
  basis.net.joints.erase(basis.net.joints.begin() + 1);
  return basis;
}

/// Values of all B-splines at the points, a row a point.
Eigen::MatrixXd values_at(const Basis& basis, const std::vector<double>& points) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points.size()), basis.size);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const double x = points[static_cast<std::size_t>(i)];
    const std::size_t k = basis.net.piece_at(x);
    const Polynomials& active = basis.b_splines[k];
    values.row(i).segment(basis.first[k], active.cols()) = powers(x - basis.net.origins[k]).transpose() * active;
  }
  return values;
}

[[maybe_unused]] bool is_grid(const std::vector<double>& points) {
  const auto in_order = [](double a, double b) { return std::isfinite(a) && std::isfinite(b) && a < b; };
  return points.size() >= 2 && std::ranges::adjacent_find(points, std::not_fn(in_order)) == points.end();
}

[[maybe_unused]] bool is_possible(int pieces, const std::vector<double>& points) {
  return pieces >= 1 && pieces <= most_spline_pieces(static_cast<int>(points.size()));
}

}  // namespace

int spline_degree(int points) { return std::min(3, points - 1); }

int most_spline_pieces(int points) { return std::max(1, points - 3); }

std::size_t SplineNet::piece_at(double x) const { return static_cast<std::size_t>(std::ranges::upper_bound(joints, x) - joints.begin()); }

Jet BicubicSpline::at(double u, double v) const {
  const std::size_t i = u_.piece_at(u), j = v_.piece_at(v);
  const Eigen::Matrix4d& patch = patches_[i * v_.origins.size() + j];
  const double s = u - u_.origins[i], t = v - v_.origins[j];
  const Eigen::Vector4d s_value = powers(s), s_slope(0.0, 1.0, 2.0 * s, 3.0 * s * s), s_curve(0.0, 0.0, 2.0, 6.0 * s);
  const Eigen::Vector4d value = patch * powers(t);
  const Eigen::Vector4d slope = patch * Eigen::Vector4d(0.0, 1.0, 2.0 * t, 3.0 * t * t);
  const Eigen::Vector4d curve = patch * Eigen::Vector4d(0.0, 0.0, 2.0, 6.0 * t);
  return {s_value.dot(value), s_slope.dot(value), s_value.dot(slope), s_curve.dot(value), s_slope.dot(slope), s_value.dot(curve)};
}

SplineFit fit_spline(const GridSamples& samples, SplinePieces pieces) {
  assert(is_grid(samples.u) && is_possible(pieces.u, samples.u));
  assert(is_grid(samples.v) && is_possible(pieces.v, samples.v));
  assert(samples.values.rows() == static_cast<Eigen::Index>(samples.u.size()));
  assert(samples.values.cols() == static_cast<Eigen::Index>(samples.v.size()));
  assert(samples.values.allFinite());
  const Basis along_u = make_basis(samples.u, pieces.u), along_v = make_basis(samples.v, pieces.v);

  // Least squares on a tensor product: along u for every column, then along v for every row of the result.
  const Eigen::MatrixXd rows = values_at(along_u, samples.u).householderQr().solve(samples.values);
  const Eigen::MatrixXd weights = values_at(along_v, samples.v).householderQr().solve(rows.transpose()).transpose();

  SplineFit fit;
  fit.spline.u_ = along_u.net;
  fit.spline.v_ = along_v.net;
  fit.spline.patches_.clear();
  for (std::size_t i = 0; i < along_u.first.size(); ++i) {
    for (std::size_t j = 0; j < along_v.first.size(); ++j) {
      const Polynomials &m_u = along_u.b_splines[i], &m_v = along_v.b_splines[j];
      fit.spline.patches_.push_back(m_u * weights.block(along_u.first[i], along_v.first[j], m_u.cols(), m_v.cols()) * m_v.transpose());
    }
  }

  Eigen::MatrixXd distance = samples.values;
  for (Eigen::Index i = 0; i < distance.rows(); ++i) {
    for (Eigen::Index j = 0; j < distance.cols(); ++j) {
      distance(i, j) -= fit.spline.at(samples.u[static_cast<std::size_t>(i)], samples.v[static_cast<std::size_t>(j)]).value;
    }
  }
  fit.rms = std::sqrt(distance.array().square().mean());
  fit.largest = distance.cwiseAbs().maxCoeff();
  return fit;
}

}  // namespace flankwright
