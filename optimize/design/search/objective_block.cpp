#include "optimize/design/search/objective_block.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

constexpr double epsilon = 1e-5;  // see ObjectiveBlock

struct Spread {
  double mean, sigma;
};

Spread spread_of(const Eigen::VectorXd& measures, const Eigen::VectorXd& shares) {
  const double mean = shares.dot(measures);
  return {mean, std::sqrt(shares.dot((measures.array() - mean).square().matrix()) + epsilon * epsilon)};
}

/// x^(1/g). What grows with a power is never below 0, and is constant where it is 0.
Slope root(double x, double growth) {
  if (growth == 1.0) return {x, 1.0};
  if (!(x > 0.0)) return {0.0, 0.0};
  const double value = std::pow(x, 1.0 / growth);
  return {value, value / (growth * x)};
}

}  // namespace

ObjectiveBlock::ObjectiveBlock(Objective objective, const std::vector<double>& weights, std::vector<double> peaks, int first, std::vector<int> scenes)
    : objective_(std::move(objective)), peaks_(std::move(peaks)), growth_(objective_.growth()), first_(first), numbers_(std::move(scenes)) {
  shares_ = Eigen::Map<const Eigen::VectorXd>(weights.data(), objective_.over == Aggregate::Nominal ? 1 : static_cast<Eigen::Index>(weights.size()));
  shares_ /= shares_.sum();
  for (std::size_t k = 0; k < objective_.terms.size(); ++k) {
    term_weights_.push_back(objective_.terms[k].weight * objective_.terms[k].outside_factor() * peaks_[k]);
    scale_ += term_weights_.back();
  }
  for (double& w : term_weights_) w /= scale_;
}

int ObjectiveBlock::variables() const {
  if (shares_one_bound()) return 1;
  const int bounds = scenes() * static_cast<int>(objective_.terms.size());
  return bounds + (has_rows() ? 1 : 0) + (objective_.over == Aggregate::Cvar ? scenes() : 0);
}

int ObjectiveBlock::rows() const { return has_rows() ? scenes() : 0; }

int ObjectiveBlock::scene_of(int number) const {
  return numbers_.empty() ? number : static_cast<int>(std::ranges::find(numbers_, number) - numbers_.begin());
}

int ObjectiveBlock::bound(int scene, int term) const {
  return shares_one_bound() ? first_ : first_ + scene * static_cast<int>(objective_.terms.size()) + term;
}

double ObjectiveBlock::measure(const Eigen::VectorXd& y, int scene) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < term_weights_.size(); ++k) sum += term_weights_[k] * std::pow(y[bound(scene, static_cast<int>(k))], growth_);
  return sum;
}

double ObjectiveBlock::measure_slope(const Eigen::VectorXd& y, int scene, std::size_t term) const {
  return term_weights_[term] * growth_ * std::pow(y[bound(scene, static_cast<int>(term))], growth_ - 1.0);
}

Slope ObjectiveBlock::bound_for(double output, int term) const {
  const Slope found = root(output / peak(term), growth_);
  return {found.value, found.by / peak(term)};
}

Slope ObjectiveBlock::objective_of(double seen) const { return {scale_ * std::pow(seen, growth_), scale_ * growth_ * std::pow(seen, growth_ - 1.0)}; }

Eigen::VectorXd ObjectiveBlock::measures(const Eigen::VectorXd& y) const {
  Eigen::VectorXd m(scenes());
  for (int s = 0; s < scenes(); ++s) m[s] = measure(y, s);
  return m;
}

SmoothValue ObjectiveBlock::value(const Eigen::VectorXd& y) const {
  SmoothValue result{0.0, Eigen::VectorXd::Zero(y.size())};
  if (is_largest()) {
    const int largest = shares_one_bound() ? first_ : level();
    result.value = y[largest];
    result.gradient[largest] = 1.0;
    return result;
  }
  const auto root_of = [this](SmoothValue all) {
    const Slope seen = root(all.value, growth_);
    return SmoothValue{seen.value, seen.by * all.gradient};
  };
  if (objective_.over == Aggregate::Cvar) {
    result.value = y[level()];
    result.gradient[level()] = 1.0;
    for (int s = 0; s < scenes(); ++s) {
      const double slope = shares_[s] / (1.0 - objective_.over.level);
      result.value += slope * y[level() + 1 + s];
      result.gradient[level() + 1 + s] = slope;
    }
    return root_of(std::move(result));
  }
  const Eigen::VectorXd m = measures(y);
  Eigen::VectorXd slope = shares_;
  result.value = shares_.dot(m);
  if (objective_.over == Aggregate::MeanPlusSigmas) {
    const auto [mean, sigma] = spread_of(m, shares_);
    result.value += objective_.over.sigmas * sigma;
    slope.array() *= 1.0 + objective_.over.sigmas * (m.array() - mean) / sigma;
  }
  for (int s = 0; s < scenes(); ++s) {
    for (std::size_t k = 0; k < term_weights_.size(); ++k) result.gradient[bound(s, static_cast<int>(k))] = slope[s] * measure_slope(y, s, k);
  }
  return root_of(std::move(result));
}

bool ObjectiveBlock::falls_with(const Eigen::VectorXd& y, int scene) const {
  return objective_.over == Aggregate::MeanPlusSigmas && value(y).gradient[bound(scene, 0)] < 0.0;
}

void ObjectiveBlock::leave_out(const std::vector<double>& measures) {
  if (!(objective_.over == Aggregate::Quantile)) return;
  left_out_ = beyond_quantile(objective_.over.level, measures, {shares_.begin(), shares_.end()});
}

void ObjectiveBlock::complete(Eigen::VectorXd& y) const {
  if (!has_rows()) return;
  const Eigen::VectorXd m = measures(y);
  if (is_largest()) {
    double largest = 0.0;
    for (int s = 0; s < scenes(); ++s) {
      if (!leaves_out(s)) largest = std::max(largest, m[s]);
    }
    y[level()] = root(largest, growth_).value;
    return;
  }
  // The level of the tail: of the sorted measures the first beyond which no more than 1 - level of the weight lies.
  std::vector<int> order(static_cast<std::size_t>(scenes()));
  for (int s = 0; s < scenes(); ++s) order[static_cast<std::size_t>(s)] = s;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return m[a] > m[b]; });
  double beyond = 0.0;
  for (int s : order) {
    y[level()] = m[s];
    beyond += shares_[s];
    if (beyond >= 1.0 - objective_.over.level) break;
  }
  for (int s = 0; s < scenes(); ++s) y[level() + 1 + s] = std::max(0.0, m[s] - y[level()]);
}

void ObjectiveBlock::write_rows(const Eigen::VectorXd& y, int row, ProgramValues& values) const {
  for (int s = 0; s < rows(); ++s, ++row) {
    auto jacobian = values.constraint_jacobian.row(row);
    if (leaves_out(s)) {
      values.constraints[row] = -1.0;  // nothing is asked of it
      continue;
    }
    const bool is_tail = objective_.over == Aggregate::Cvar;
    const double m = measure(y, s);
    const Slope asked = is_tail ? Slope{m, 1.0} : root(m, growth_);
    values.constraints[row] = asked.value - y[level()];
    for (std::size_t k = 0; k < term_weights_.size(); ++k) jacobian[bound(s, static_cast<int>(k))] = asked.by * measure_slope(y, s, k);
    jacobian[level()] = -1.0;
    if (!is_tail) continue;
    values.constraints[row] -= y[level() + 1 + s];
    jacobian[level() + 1 + s] = -1.0;
  }
}

}  // namespace flankwright
