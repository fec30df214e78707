#include "optimize/design/scatter/model_step.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/design/search/design_log.hpp"
#include "optimize/solvers/nonnegative_least_squares.hpp"

namespace flankwright {

namespace {

constexpr int most_levels = 60;           // of one level method
constexpr int most_choices = 6;           // of the draws that a quantile leaves out
constexpr double level_share = 0.02;      // the method ends where reached - unreachable <= this share of what was gained,
constexpr double level_round_off = 1e-6;  // or <= this share of the value

/// value + slope (x - at) of a tangent, as a row in x - centre.
struct Row {
  Eigen::VectorXd slope;
  double value;  ///< at the centre
};

class LevelMethod {
 public:
  LevelMethod(const ScatterModel& model, const Eigen::VectorXd& centre, double radius, int draws)
      : model_(model),
        centre_(centre),
        draws_(draws),
        low_((centre.array() - radius).matrix().cwiseMax(model.lower) - centre),
        high_((centre.array() + radius).matrix().cwiseMin(model.upper) - centre),
        reduces_excess_(model.excess(centre, draws) > DesignLog::tolerance) {}

  ModelStep run() {
    choose(centre_);
    const double first = at_centre();
    Eigen::VectorXd best = Eigen::VectorXd::Zero(centre_.size());
    double reached = first;
    for (int choice = 0; choice < most_choices; ++choice) {
      const double before = reached;
      if (choice > 0) choose(centre_ + best);
      descend(best, reached);
      if (model_.objective.objective().over == Aggregate::Quantile ? before - reached <= level_round_off * std::abs(before) : true) break;
    }
    // A step leaves the box by round-off. What is held at a value stays there exactly.
    const Eigen::VectorXd x = (centre_ + best).cwiseMax(model_.lower).cwiseMin(model_.upper);
    if (reduces_excess_) return {x, first - reached};
    return {x, first > 0.0 ? 1.0 - model_.objective.unseen(reached) / model_.objective.unseen(first) : 0.0};
  }

 private:
  /// Draws that quantiles leave out at a design.
  void choose(const Eigen::VectorXd& x) {
    left_out_ = model_.objective.beyond(model_.objective.measures(x, draws_));
    bounded_left_out_.clear();
    for (const StatisticModel& bounded : model_.bounded) bounded_left_out_.push_back(bounded.beyond(bounded.measures(x, draws_)));
    targets_.clear();
    kept_.clear();
  }

  double at_centre() {
    Judged judged = look(Eigen::VectorXd::Zero(centre_.size()), -INFINITY);
    return judged.target;
  }

  struct Judged {
    double target, excess;
  };

  /// Adds the tangents at a step.
  Judged look(const Eigen::VectorXd& step, double level) {
    const Eigen::VectorXd x = centre_ + step;
    const auto row = [&](const SmoothValue& touching, double scale, double shift) {
      return Row{scale * touching.gradient, scale * (touching.value - touching.gradient.dot(step)) + shift};
    };
    Judged judged{-INFINITY, -INFINITY};
    for (std::size_t b = 0; b < model_.bounded.size(); ++b) {
      const double limit = model_.bounded[b].seen(model_.limits[b]);
      const double from = reduces_excess_ ? (std::isfinite(level) ? (1.0 + level) * limit : -INFINITY) : limit;
      const auto found = model_.bounded[b].tangents(x, bounded_left_out_[b], draws_, from);
      judged.excess = std::max(judged.excess, found.value / limit - 1.0);
      for (const SmoothValue& touching : found.touching) (reduces_excess_ ? targets_ : kept_).push_back(row(touching, 1.0 / limit, -1.0));
    }
    if (reduces_excess_) return {judged.excess, -INFINITY};
    const auto found = model_.objective.tangents(x, left_out_, draws_, level);
    judged.target = found.value;
    for (const SmoothValue& touching : found.touching) targets_.push_back(row(touching, 1.0, 0.0));
    return judged;
  }

  /// No design in the box is below this by the tangents.
  double unreachable() const {
    double least = -INFINITY;
    for (const Row& row : targets_) {
      const double fall = row.slope.cwiseProduct(low_).cwiseMin(row.slope.cwiseProduct(high_)).sum();
      least = std::max(least, row.value + fall);
    }
    return least;
  }

  std::optional<Eigen::VectorXd> nearest(double level) const {
    const Eigen::Index n = centre_.size();
    const auto rows = static_cast<Eigen::Index>(targets_.size() + kept_.size()) + model_.slopes.rows() + 2 * n;
    Eigen::MatrixXd slopes(rows, n);
    Eigen::VectorXd limits(rows);
    Eigen::Index at = 0;
    const auto put = [&](const auto& slope, double limit) {
      slopes.row(at) = slope;
      limits[at++] = limit;
    };
    for (const Row& row : targets_) put(row.slope.transpose(), level - row.value);
    for (const Row& row : kept_) put(row.slope.transpose(), -row.value);
    // A constraint on modifications that is violated at the centre, by rounding say, may not be violated more.
    for (Eigen::Index r = 0; r < model_.slopes.rows(); ++r)
      put(model_.slopes.row(r), std::max(0.0, model_.most[r] - model_.slopes.row(r).dot(centre_)));
    for (Eigen::Index i = 0; i < n; ++i) {
      put(Eigen::RowVectorXd::Unit(n, i), high_[i]);
      put(-Eigen::RowVectorXd::Unit(n, i), -low_[i]);
    }
    return shortest_within(slopes, limits, std::sqrt(static_cast<double>(n)));
  }

  void descend(Eigen::VectorXd& best, double& reached) {
    const double first = look(best, -INFINITY).target;
    reached = first;
    double below = unreachable();
    for (int k = 0; k < most_levels; ++k) {
      if (reached - below <= std::max(level_share * (first - reached), level_round_off * std::abs(reached))) break;
      const double level = 0.5 * (reached + below);
      const std::optional<Eigen::VectorXd> step = nearest(level);
      if (!step) {
        below = level;
        continue;
      }
      const Judged judged = look(*step, level);
      if (judged.target < reached && judged.excess <= DesignLog::tolerance) {
        reached = judged.target;
        best = *step;
      }
      below = std::max(below, unreachable());
    }
  }

  const ScatterModel& model_;
  const Eigen::VectorXd& centre_;
  const int draws_;
  const Eigen::VectorXd low_, high_;  ///< of steps
  const bool reduces_excess_;
  std::vector<bool> left_out_;
  std::vector<std::vector<bool>> bounded_left_out_;
  std::vector<Row> targets_;  ///< <= level
  std::vector<Row> kept_;     ///< <= 0
};

}  // namespace

std::optional<Eigen::VectorXd> shortest_within(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& limits, double longest) {
  const Eigen::Index n = slopes.cols();
  // The residual r of [-slopes -limits]^T u = (0 ... 0 1), u >= 0, is |r|^2 = 1 / (1 + |d|^2), and 0 where no d satisfies all rows.
  Eigen::MatrixXd columns(n + 1, slopes.rows());
  for (Eigen::Index i = 0; i < slopes.rows(); ++i) {
    const double size = std::hypot(slopes.row(i).norm(), limits[i]);
    columns.col(i).head(n) = -slopes.row(i).transpose() / (size > 0.0 ? size : 1.0);
    columns(n, i) = -limits[i] / (size > 0.0 ? size : 1.0);
  }
  const Eigen::VectorXd wanted = Eigen::VectorXd::Unit(n + 1, n);
  const Eigen::VectorXd residual = columns * nonnegative_least_squares(columns, wanted) - wanted;
  if (!(-residual[n] > 0.5 / (1.0 + longest * longest))) return std::nullopt;
  return -residual.head(n) / residual[n];
}

ScatterModel::ScatterModel(const DesignProblem& problem)
    : objective(problem, problem.task().combined_objective(), problem.task().within_draw), lower(problem.lower()), upper(problem.upper()) {
  const DesignTask& task = problem.task();
  for (const ObjectiveBound& bound : task.objective_bounds) {
    bounded.emplace_back(problem, bound.objective);
    limits.push_back(bound.limit);
  }
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> values;
  const PerGear<Modification> zero = problem.modification(Eigen::VectorXd::Zero(problem.variables()));
  for (const ModificationConstraint& c : task.modification_constraints) {
    const double scale = problem.modification_scale(c), at_zero = c.value(zero);
    const Eigen::VectorXd slope = problem.modification_slope(c) / scale;
    if (std::isfinite(c.maximum)) {
      rows.push_back(slope);
      values.push_back((c.maximum - at_zero) / scale);
    }
    if (std::isfinite(c.minimum)) {
      rows.push_back(-slope);
      values.push_back((at_zero - c.minimum) / scale);
    }
  }
  slopes.resize(static_cast<Eigen::Index>(rows.size()), problem.variables());
  most.resize(slopes.rows());
  for (Eigen::Index r = 0; r < slopes.rows(); ++r) {
    slopes.row(r) = rows[static_cast<std::size_t>(r)];
    most[r] = values[static_cast<std::size_t>(r)];
  }
}

double ScatterModel::excess(const Eigen::VectorXd& x, int draws) const {
  double largest = -INFINITY;
  for (std::size_t b = 0; b < bounded.size(); ++b) {
    largest = std::max(largest, bounded[b].seen(bounded[b].statistic(bounded[b].measures(x, draws))) / bounded[b].seen(limits[b]) - 1.0);
  }
  return largest;
}

ModelStep least_of_model(const ScatterModel& model, const Eigen::VectorXd& centre, double radius, int draws) {
  return LevelMethod(model, centre, radius, draws).run();
}

}  // namespace flankwright
