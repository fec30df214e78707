#include "core/compliance/fitted/thesis_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

using Eigen::Index;

/// The ten functions of u_F, in the order of their coefficients.
enum Own : std::size_t { f1, log_f2, f3, f4, f5, f6, g2, log_g3, g4, log_g5, own_functions };

struct Point {
  double u, zeta;
};

/// K at `where` under a load at `load`, and its derivatives with respect to the ten functions.
double one_way(ThesisBody body, double B, std::span<const double> c, Point where, Point load, std::array<double, own_functions>& d) {
  std::array<double, own_functions> v;
  for (std::size_t i = 0; i < own_functions; ++i) v[i] = c[3 * i] + load.u * (c[3 * i + 1] + load.u * c[3 * i + 2]);
  const double zbar = where.zeta - load.zeta, distance = std::abs(zbar);
  const double f2 = std::exp(v[log_f2]), g3 = std::exp(v[log_g3]), g5 = std::exp(v[log_g5]);
  const auto end_0 = [&](double z) { return std::exp(-g3 * z); };
  const auto end_1 = [&](double z) { return std::exp(-g5 * (B - z)); };
  const auto G = [&](double z) { return 1 + v[g2] * end_0(z) + v[g4] * end_1(z); };
  const double G_where = G(where.zeta), G_load = G(load.zeta), root = std::sqrt(G_where * G_load);
  const double decay = std::exp(-f2 * distance - v[f6] * zbar), dip = std::exp(-25 * distance);
  const double tooth = v[f1] * (decay - v[f3] * dip), gear = v[f4] + v[f5] * zbar;
  const bool inside = body == ThesisBody::InMasterFunction;
  const double F = inside ? tooth + gear : tooth;

  d[f1] = root * (decay - v[f3] * dip);
  d[log_f2] = -root * v[f1] * decay * f2 * distance;
  d[f3] = -root * v[f1] * dip;
  d[f4] = inside ? root : 1;
  d[f5] = d[f4] * zbar;
  d[f6] = -root * v[f1] * decay * zbar;
  // d root = (dG(where) G(load) + G(where) dG(load)) / (2 root)
  const double by_G = F / (2 * root), by_where = by_G * G_load, by_load = by_G * G_where;
  d[g2] = by_where * end_0(where.zeta) + by_load * end_0(load.zeta);
  d[log_g3] = -v[g2] * g3 * (by_where * end_0(where.zeta) * where.zeta + by_load * end_0(load.zeta) * load.zeta);
  d[g4] = by_where * end_1(where.zeta) + by_load * end_1(load.zeta);
  d[log_g5] = -v[g4] * g5 * (by_where * end_1(where.zeta) * (B - where.zeta) + by_load * end_1(load.zeta) * (B - load.zeta));
  return inside ? root * F : root * F + gear;
}

/// Mean of both directions; derivatives with respect to all 30 coefficients.
double own_tooth(ThesisBody body, double B, std::span<const double> c, Point p, Point q, std::span<double> gradient) {
  std::array<double, own_functions> to_p, to_q;
  const double value = 0.5 * (one_way(body, B, c, p, q, to_p) + one_way(body, B, c, q, p, to_q));
  for (std::size_t i = 0; i < own_functions; ++i) {
    gradient[3 * i] = 0.5 * (to_p[i] + to_q[i]);
    gradient[3 * i + 1] = 0.5 * (to_p[i] * q.u + to_q[i] * p.u);
    gradient[3 * i + 2] = 0.5 * (to_p[i] * q.u * q.u + to_q[i] * p.u * p.u);
  }
  return value;
}

/// Eq. 2.9; derivatives with respect to its five coefficients, decay rates as exponentials.
double adjacent_tooth(double B, std::span<const double> c, Point p, Point q, std::span<double> gradient) {
  const double sum = p.zeta + q.zeta, rest = 2 * B - sum;
  const double a3 = std::exp(c[2]), a5 = std::exp(c[4]);
  const double end_0 = std::exp(-a3 * sum), end_1 = std::exp(-a5 * rest);
  gradient[0] = 1;
  gradient[1] = end_0;
  gradient[2] = -c[1] * end_0 * a3 * sum;
  gradient[3] = end_1;
  gradient[4] = -c[3] * end_1 * a5 * rest;
  return c[0] + c[1] * end_0 + c[3] * end_1;
}

struct KnownPair {
  Point p, q;
  double value;
};

/// Relative residuals of the pairs that are `apart` teeth from each other.
class ThesisResiduals final : public ResidualFunction {
 public:
  ThesisResiduals(std::span<const InfluenceSample> samples, ThesisBody body, int apart)
      : body_(body), apart_(apart), B_(samples.front().gear.relative_face) {
    for (const InfluenceSample& sample : samples) {
      const auto n = static_cast<Index>(sample.points.size());
      for (Index p = 0; p < n; ++p) {
        for (Index q = 0; q <= p; ++q) {
          const FlankStation &a = sample.points[static_cast<std::size_t>(p)], &b = sample.points[static_cast<std::size_t>(q)];
          const double known = sample.at(p, q);
          if (std::abs(a.tooth - b.tooth) == apart && !std::isnan(known) && known != 0) {
            pairs_.push_back({{a.u, a.zeta}, {b.u, b.zeta}, known});
          }
        }
      }
    }
  }

  int residual_count() const override { return static_cast<int>(pairs_.size()); }
  int coefficient_count() const override { return apart_ == 0 ? ThesisCompliance::kOwnCoefficients : ThesisCompliance::kAdjacentCoefficients; }
  bool evaluate(std::span<const double> x, std::span<double> residuals, std::span<double> jacobian) const override {
    std::array<double, ThesisCompliance::kOwnCoefficients> gradient{};
    bool finite = true;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto& [p, q, known] = pairs_[i];
      const double value = apart_ == 0 ? own_tooth(body_, B_, x, p, q, gradient) : adjacent_tooth(B_, x, p, q, gradient);
      const double scale = 1 / (std::abs(known) * std::sqrt(static_cast<double>(pairs_.size())));
      residuals[i] = scale * (value - known);
      finite = finite && std::isfinite(residuals[i]);
      if (jacobian.empty()) continue;
      for (std::size_t c = 0; c < x.size(); ++c) jacobian[i * x.size() + c] = scale * gradient[c];
    }
    return finite;
  }

  /// Curves without end effects through the pairs' mean.
  std::vector<double> start() const {
    double mean = 0;
    for (const KnownPair& pair : pairs_) mean += pair.value / static_cast<double>(pairs_.size());
    std::vector<double> x(static_cast<std::size_t>(coefficient_count()), 0.0);
    if (apart_ > 0) {
      x[0] = 0.8 * mean;
      x[1] = x[3] = 0.2 * mean;
      x[2] = x[4] = std::log(0.2);
      return x;
    }
    x[3 * f1] = 2 * mean;
    x[3 * log_f2] = std::log(0.3);
    x[3 * f4] = 0.2 * mean;
    x[3 * g2] = x[3 * g4] = 0.5;
    x[3 * log_g3] = x[3 * log_g5] = 0;
    return x;
  }

 private:
  ThesisBody body_;
  int apart_;
  double B_;
  std::vector<KnownPair> pairs_;
};

}  // namespace

ThesisCompliance::ThesisCompliance(ThesisBody body, const GearProportions& gear, std::vector<double> coefficients)
    : body_(body), gear_(gear), coefficients_(std::move(coefficients)) {
  gear_.validate();
  const auto size = static_cast<int>(coefficients_.size());
  if (size < kOwnCoefficients || (size - kOwnCoefficients) % kAdjacentCoefficients != 0) {
    throw InvalidInput("thesis.coefficients", std::to_string(size), "30 plus a multiple of 5");
  }
}

int ThesisCompliance::teeth_apart() const { return (static_cast<int>(coefficients_.size()) - kOwnCoefficients) / kAdjacentCoefficients; }

Eigen::MatrixXd ThesisCompliance::evaluate(std::span<const FlankStation> points) const {
  const std::span<const double> c(coefficients_);
  const double B = gear_.relative_face;
  std::array<double, kOwnCoefficients> unused{};
  const auto n = static_cast<Index>(points.size());
  Eigen::MatrixXd K(n, n);
  for (Index p = 0; p < n; ++p) {
    const FlankStation& a = points[static_cast<std::size_t>(p)];
    if (!(a.zeta >= 0 && a.zeta <= B)) throw InvalidInput("point.zeta", std::to_string(a.zeta), "0 .. " + std::to_string(B));
    if (!(std::abs(a.u) <= 1.05)) throw InvalidInput("point.u", std::to_string(a.u), "-1.05 .. 1.05");
    for (Index q = 0; q <= p; ++q) {
      const FlankStation& b = points[static_cast<std::size_t>(q)];
      const int apart = std::abs(a.tooth - b.tooth);
      if (apart > teeth_apart()) {
        throw InvalidInput("point.tooth", std::to_string(apart) + " teeth apart", "at most " + std::to_string(teeth_apart()));
      }
      const Point at_p{a.u, a.zeta}, at_q{b.u, b.zeta};
      const auto first = static_cast<std::size_t>(kOwnCoefficients + (apart - 1) * kAdjacentCoefficients);
      K(p, q) = K(q, p) = apart == 0 ? own_tooth(body_, B, c.first(kOwnCoefficients), at_p, at_q, unused)
                                     : adjacent_tooth(B, c.subspan(first, kAdjacentCoefficients), at_p, at_q, unused);
    }
  }
  return K;
}

ThesisFitResult fit_thesis_form(std::span<const InfluenceSample> samples, ThesisBody body, const LeastSquaresOptions& options) {
  if (samples.empty()) throw InvalidInput("samples", "none", "at least one");
  for (const InfluenceSample& sample : samples) {
    sample.validate();
    if (sample.gear != samples.front().gear) throw InvalidInput("samples", "of different gears", "of one gear");
  }
  ThesisFitResult result;
  std::vector<double> coefficients;
  result.status = FitStatus::Converged;
  for (int apart = 0;; ++apart) {
    const ThesisResiduals residuals(samples, body, apart);
    if (residuals.residual_count() == 0 && apart > 0) break;
    if (residuals.residual_count() < residuals.coefficient_count()) {
      throw InvalidInput("samples", std::to_string(residuals.residual_count()) + " pairs",
                         "at least " + std::to_string(residuals.coefficient_count()));
    }
    const LeastSquaresResult solved = solve_least_squares(residuals, residuals.start(), options);
    coefficients.insert(coefficients.end(), solved.coefficients.begin(), solved.coefficients.end());
    result.message = solved.message;
    if (solved.status == FitStatus::Failed) {
      result.status = solved.status;
      return result;
    }
    if (solved.status == FitStatus::IterationLimit) result.status = solved.status;
  }
  result.fit.emplace(body, samples.front().gear, std::move(coefficients));
  return result;
}

}  // namespace flankwright
