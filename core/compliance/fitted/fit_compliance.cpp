#include "core/compliance/fitted/fit_compliance.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>

#include "core/base/error.hpp"
#include "core/compliance/fitted/kernel_sum.hpp"

namespace flankwright {
namespace {

using Eigen::Index;

/// Relative residuals of all pairs, and the ridge.
class PairResiduals final : public ResidualFunction {
 public:
  PairResiduals(std::span<const InfluenceSample> samples, const KernelForm& form, const FitOptions& options, std::span<const double> start)
      : form_(form), start_(start.begin(), start.end()) {
    for (const InfluenceSample& sample : samples) {
      sums_.emplace_back(form, sample.gear, sample.points);
      // All teeth are alike: pairs of the same stations, as many teeth apart, are one pair that was computed
      // repeatedly.
      std::map<std::array<double, 5>, std::size_t> found;
      std::vector<int> count;
      const std::size_t first = pairs_.size();
      const auto n = static_cast<Index>(sample.points.size());
      for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j <= i; ++j) {
          const double known = sample.at(i, j);
          const auto [p, q] = ahead(sample, i, j) ? std::pair{i, j} : std::pair{j, i};
          const FlankStation &a = station(sample, p), &b = station(sample, q);
          const int apart = a.tooth - b.tooth;
          teeth_spanned_ = std::max(teeth_spanned_, apart);
          if (std::isnan(known) || (apart > 0 && !form.couples_teeth())) continue;
          const double own = std::sqrt(sample.compliance(p, p) * sample.compliance(q, q));
          const double floor = std::isnan(own) ? 0 : options.scale_floor * own;
          const auto [entry, is_new] = found.try_emplace({static_cast<double>(apart), a.u, a.zeta, b.u, b.zeta}, pairs_.size());
          if (is_new) {
            pairs_.push_back({sums_.size() - 1, p, q, 0, 0});
            count.push_back(0);
          }
          pairs_[entry->second].known += known - sample.given_at(i, j);
          pairs_[entry->second].scale += std::max(std::abs(known), floor);
          ++count[entry->second - first];
          teeth_apart_ = std::max(teeth_apart_, apart);
        }
      }
      for (std::size_t k = first; k < pairs_.size(); ++k) {
        pairs_[k].known /= count[k - first];
        pairs_[k].scale /= count[k - first];
      }
    }
    const auto tooth_count = static_cast<std::size_t>(form.tooth_count());
    for (std::size_t i = 0; i < start_.size(); ++i) {
      ridge_.push_back(i < tooth_count ? options.tooth_ridge : options.body_ridge);
    }
  }

  int pairs() const { return static_cast<int>(pairs_.size()); }
  int teeth_apart() const { return teeth_apart_; }
  int teeth_spanned() const { return teeth_spanned_; }
  int residual_count() const override { return pairs() + coefficient_count(); }
  int coefficient_count() const override { return form_.count(); }

  bool evaluate(std::span<const double> x, std::span<double> residuals, std::span<double> jacobian) const override {
    std::vector<Eigen::MatrixXd> values;
    for (KernelSum& sum : sums_) {
      sum.set_coefficients(x);
      if (jacobian.empty()) values.push_back(sum.tooth_matrix() + sum.body_matrix());
    }
    const std::size_t n = x.size();
    const double root = 1 / std::sqrt(static_cast<double>(pairs_.size()));
    bool finite = true;
    std::size_t i = 0;
    for (const Pair& pair : pairs_) {
      double value = 0;
      if (jacobian.empty()) {
        value = values[pair.sample](pair.p, pair.q);
      } else {
        const std::span<double> row = jacobian.subspan(i * n, n);
        value = sums_[pair.sample].with_gradient(pair.p, pair.q, row);
        for (double& entry : row) entry *= root / pair.scale;
      }
      residuals[i] = root / pair.scale * (value - pair.known);
      finite = finite && std::isfinite(residuals[i]);
      ++i;
    }
    if (!jacobian.empty()) std::fill(jacobian.begin() + static_cast<std::ptrdiff_t>(i * n), jacobian.end(), 0.0);
    for (std::size_t c = 0; c < n; ++c, ++i) {
      residuals[i] = ridge_[c] * (x[c] - start_[c]);
      if (!jacobian.empty()) jacobian[i * n + c] = ridge_[c];
    }
    return finite;
  }

 private:
  struct Pair {
    std::size_t sample;
    Index p, q;
    double known, scale;
  };
  static const FlankStation& station(const InfluenceSample& sample, Index p) { return sample.points[static_cast<std::size_t>(p)]; }
  /// Whether p comes first: on the tooth further ahead or, on the same tooth, higher up or further along.
  static bool ahead(const InfluenceSample& sample, Index p, Index q) {
    const FlankStation &a = station(sample, p), &b = station(sample, q);
    return std::tie(a.tooth, a.u, a.zeta) >= std::tie(b.tooth, b.u, b.zeta);
  }

  const KernelForm& form_;
  std::vector<double> start_, ridge_;
  mutable std::vector<KernelSum> sums_;  ///< hold the coefficients of the evaluation under way
  std::vector<Pair> pairs_;
  int teeth_apart_{0};    ///< of known pairs
  int teeth_spanned_{0};  ///< of all points
};

/// s^2 (J'J)^-1 with the ridge among the rows of J.
Eigen::MatrixXd covariance_at(const PairResiduals& function, std::span<const double> x) {
  const int m = function.residual_count(), n = function.coefficient_count();
  std::vector<double> residuals(static_cast<std::size_t>(m)), jacobian(static_cast<std::size_t>(m) * x.size());
  function.evaluate(x, residuals, jacobian);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(jacobian.data(), m, n);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
  // Residuals carry 1/sqrt(N) each, as J does: it cancels in (J'J)^-1 times the sum of squares.
  const double squares = Eigen::Map<const Eigen::VectorXd>(residuals.data(), function.pairs()).squaredNorm();
  const double freedom = std::max(1, function.pairs() - n);
  return squares / freedom * normal.selfadjointView<Eigen::Lower>().ldlt().solve(Eigen::MatrixXd::Identity(n, n));
}

FitRange range_of(std::span<const InfluenceSample> samples, int teeth_apart) {
  const FlankStation& first = samples.front().points.front();
  FitRange range{first.u, first.u, first.zeta, first.zeta, teeth_apart};
  for (const InfluenceSample& sample : samples) {
    for (const FlankStation& point : sample.points) {
      range.u_min = std::min(range.u_min, point.u);
      range.u_max = std::max(range.u_max, point.u);
      range.zeta_min = std::min(range.zeta_min, point.zeta);
      range.zeta_max = std::max(range.zeta_max, point.zeta);
    }
  }
  return range;
}

/// The samples without the pairs that a form for one tooth does not cover.
std::vector<InfluenceSample> known_to(const KernelForm& form, std::span<const InfluenceSample> samples) {
  std::vector<InfluenceSample> kept(samples.begin(), samples.end());
  if (form.couples_teeth()) return kept;
  std::vector<InfluenceSample> by_tooth;
  for (const InfluenceSample& sample : kept) {
    std::vector<int> teeth;
    for (const FlankStation& point : sample.points) teeth.push_back(point.tooth);
    std::sort(teeth.begin(), teeth.end());
    teeth.erase(std::unique(teeth.begin(), teeth.end()), teeth.end());
    for (const int tooth : teeth) {
      std::vector<Index> chosen;
      InfluenceSample own{sample.gear, {}, {}};
      for (std::size_t i = 0; i < sample.points.size(); ++i) {
        if (sample.points[i].tooth != tooth) continue;
        chosen.push_back(static_cast<Index>(i));
        own.points.push_back(sample.points[i]);
      }
      own.compliance = sample.compliance(chosen, chosen);
      if (sample.given.size() != 0) own.given = sample.given(chosen, chosen);
      by_tooth.push_back(std::move(own));
    }
  }
  return by_tooth;
}

}  // namespace

void FitOptions::validate(const KernelForm& form) const {
  const auto size = static_cast<std::size_t>(form.count());
  if (!start.empty() && start.size() != size) {
    throw InvalidInput("fit.start", std::to_string(start.size()) + " coefficients", "none or " + std::to_string(size));
  }
  if (!(tooth_ridge >= 0)) throw InvalidInput("fit.tooth_ridge", std::to_string(tooth_ridge), "0 or more");
  if (!(body_ridge >= 0)) throw InvalidInput("fit.body_ridge", std::to_string(body_ridge), "0 or more");
  if (!(scale_floor > 0)) throw InvalidInput("fit.scale_floor", std::to_string(scale_floor), "positive");
  solver.validate();
}

std::vector<double> flat_start(const KernelForm& form, std::span<const InfluenceSample> samples) {
  double own = 0, least = std::numeric_limits<double>::infinity();
  int count = 0;
  for (const InfluenceSample& sample : samples) {
    for (Index p = 0; p < sample.compliance.rows(); ++p) {
      for (Index q = 0; q <= p; ++q) {
        const double known = sample.at(p, q) - sample.given_at(p, q);
        if (std::isnan(known)) continue;
        least = std::min(least, known);
        if (p == q) {
          own += known;
          ++count;
        }
      }
    }
  }
  if (count == 0) throw InvalidInput("samples", "no known diagonal", "at least one point's own compliance");
  own /= count;
  const double body = std::max(0.01 * own, least);
  const double tooth = (own > body ? own - body : 0.1 * own) / static_cast<double>(form.kernels.size());

  std::vector<double> x(static_cast<std::size_t>(form.count()), 0.0);
  auto offset = static_cast<std::size_t>(KernelForm::kWarpCoefficients);
  int near = 0, far = 0;
  for (const Kernel& kernel : form.kernels) {
    const bool is_far = kernel.couples_teeth();
    // Kernels that started alike would stay alike.
    static constexpr std::array<double, 4> kSpread{1.0, 2.0, 0.5, 1.4};
    const double spread = kSpread[static_cast<std::size_t>(is_far ? far++ : near++) % kSpread.size()];
    x[offset] = 0.5 * std::log(is_far ? body : tooth);
    x[offset + static_cast<std::size_t>(kernel.amplitude.count())] = std::log((is_far ? 2.0 : 1.0) * spread);
    x[offset + static_cast<std::size_t>(kernel.amplitude.count() + kernel.axial.count())] = std::log((is_far ? 4.0 : 1.0) * spread);
    offset += static_cast<std::size_t>(kernel.count());
    if (is_far) x[offset - 2] = std::log(1.5);
  }
  if (form.torsion) {
    // As large again as that of the body, over ten modules.
    x[offset] = std::log(body / 10);
    x[offset + 1] = std::log(3.0);
    offset += 2;
  }
  for (const BodyPart& part : form.bodies) {
    x[offset] = std::sqrt(body / static_cast<double>(form.bodies.size()));
    // A function that starts without any share has no derivative with respect to itself.
    std::size_t diagonal = offset;
    for (int i = 1; i < part.functions; ++i) {
      diagonal += static_cast<std::size_t>(i) + 1;
      x[diagonal] = 0.1 * x[offset];
    }
    offset += static_cast<std::size_t>(part.count());
    if (part.coupling == Coupling::Decaying) x[offset - 1] = std::log(2.0);
  }
  return x;
}

FitResult fit_compliance(std::span<const InfluenceSample> all_samples, const KernelForm& form, const FitOptions& options) {
  form.validate();
  options.validate(form);
  if (all_samples.empty()) throw InvalidInput("samples", "none", "at least one");
  FitResult result;
  for (const InfluenceSample& sample : all_samples) {
    sample.validate();
    if (sample.gear != all_samples.front().gear) throw InvalidInput("samples", "of different gears", "of one gear");
  }
  const std::vector<InfluenceSample> samples = known_to(form, all_samples);
  const std::vector<double> start = options.start.empty() ? flat_start(form, samples) : options.start;
  const PairResiduals residuals(samples, form, options, start);
  result.pairs = residuals.pairs();

  const LeastSquaresResult solved = solve_least_squares(residuals, start, options.solver);
  result.status = solved.status;
  result.message = solved.message;
  result.initial_cost = solved.initial_cost;
  result.cost = solved.cost;
  result.iterations = solved.iterations;
  if (solved.status == FitStatus::Failed) return result;

  FitRecord record;
  record.range = range_of(samples, residuals.teeth_apart());
  result.covariance = covariance_at(residuals, solved.coefficients);
  for (Index i = 0; i < result.covariance.rows(); ++i) {
    record.standard_errors.push_back(std::sqrt(std::max(0.0, result.covariance(i, i))));
  }
  const GearProportions& gear = samples.front().gear;
  // Pairs without a value are visited but not counted.
  FitRecord everywhere;
  everywhere.range.teeth_apart = residuals.teeth_spanned();
  record.residuals = residual_statistics(FittedCompliance(form, gear, solved.coefficients, everywhere), samples);
  result.fit.emplace(form, gear, solved.coefficients, record);
  return result;
}

}  // namespace flankwright
