#include "optimize/design/scatter/statistic_model.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/design/scatter/draws.hpp"
#include "optimize/design/scatter/screening.hpp"

namespace flankwright {

namespace {

/// Analyses of one draw in the maximum r_sk: known_[draw].size() <= most_linear, >= 2. The first stays, which is that of the accepted design where
/// the draw was analysed there; of those that rejected steps add, the oldest goes. A rejected step halves the box, so that the newest lie nearest to
/// the next step. Each costs up to most_peaks rows a term in every seen(). No measurement chose 3 over its neighbours.
constexpr std::size_t most_linear = 3;

/// Candidates u_j of an output u in a draw that are continued along their gradients: u_j >= (1 - peak_margin) u, 0 < peak_margin < 1. What lies lower
/// is not foreseen until an analysis finds it as a peak, so that a step of the model is trusted as long as it raises nothing by more than 1/(1 -
/// peak_margin) = 2.5 times against the peak; a step that does gains less than promised, and is rejected where it gains nothing. A wide margin suits
/// the first steps, which are up to half of a variable's range. No measurement chose the value.
constexpr double peak_margin = 0.6;
/// At most so many of these candidates, the largest first, >= 1. The bound is that of memory and work: draws x most_linear x terms x most_peaks rows
/// of gradients and values, 3 MB for 512 draws of one term and five variables. No measurement chose the value.
constexpr std::size_t most_peaks = 40;

double model_growth(const Objective& objective) {
  const bool is_contact_stress = objective.terms.size() == 1 && objective.terms.front().output == Output::PeakContactStress;
  return is_contact_stress ? 0.5 : objective.growth();
}

std::vector<PeakCandidate> candidates_of(const ObjectiveTerm& term, const LoadedScene& scene) {
  if (design_output(term.output).is_least && !term.reciprocal) return leading_candidates(term, scene, 0.0, 1);
  std::vector<PeakCandidate> candidates = leading_candidates(term, scene, peak_margin, most_peaks);
  if (term.output == Output::TeHarmonic) candidates.push_back(whole_output);
  return candidates;
}

LinearDraw::Peak peak_of(const ObjectiveTerm& term, const DesignProblem& problem, const DesignAnalysis& analysis, int s, double growth) {
  const LoadedScene scene = problem.scene(analysis, s);
  const std::vector<PeakCandidate> candidates = candidates_of(term, scene);
  const auto rows = static_cast<Eigen::Index>(candidates.size());
  LinearDraw::Peak peak{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, problem.variables())};
  for (Eigen::Index j = 0; j < rows; ++j) {
    const SmoothValue value = candidate_value(term, candidates[static_cast<std::size_t>(j)], scene);
    const double root = value.value > 0.0 ? std::pow(value.value, 1.0 / growth) : 0.0;
    peak.values[j] = root;
    peak.slopes.row(j).setZero();
    if (value.value > 0.0 && value.gradient.size() > 0) {
      peak.slopes.row(j) = root / (growth * value.value) * problem.scaled(value.gradient, analysis, s).transpose();
    }
  }
  return peak;
}

}  // namespace

StatisticModel::StatisticModel(const DesignProblem& problem, Objective objective, Aggregation within)
    : objective_(std::move(objective)),
      within_(within),
      growth_(model_growth(objective_)),
      scenes_(draws_of(problem.task().scenes, objective_.over_spectrum())) {
  const std::vector<double> all = problem.scene_weights();
  for (const std::vector<int>& draw : scenes_) weights_.push_back(all[static_cast<std::size_t>(draw.front())]);
  known_.resize(scenes_.size());
}

LinearDraw StatisticModel::linear(const DesignProblem& problem, const DesignAnalysis& analysis, int draw, const Eigen::VectorXd& x) const {
  LinearDraw linear{x, {}};
  for (const int s : scenes(draw)) {
    LinearDraw::LoadCase load_case{problem.task().scenes[static_cast<std::size_t>(s)].weight, {}};
    for (const ObjectiveTerm& term : objective_.terms) load_case.terms.push_back(peak_of(term, problem, analysis, s, growth_));
    linear.load_cases.push_back(std::move(load_case));
  }
  return linear;
}

void StatisticModel::set(int draw, LinearDraw linear) {
  std::vector<LinearDraw>& known = known_[static_cast<std::size_t>(draw)];
  known.clear();
  known.push_back(std::move(linear));
}

void StatisticModel::add(int draw, LinearDraw linear) {
  std::vector<LinearDraw>& known = known_[static_cast<std::size_t>(draw)];
  if (known.size() == most_linear) known.erase(known.begin() + 1);
  known.push_back(std::move(linear));
}

LinearDraw StatisticModel::moved(int draw, const Eigen::VectorXd& x, double measure) const {
  LinearDraw linear = known_[static_cast<std::size_t>(draw)].front();
  const double expected = unseen(seen(linear, x).value);
  for (LinearDraw::LoadCase& load_case : linear.load_cases) {
    for (LinearDraw::Peak& peak : load_case.terms) {
      peak.values += peak.slopes * (x - linear.x);
      // All outputs are off by the same share.
      if (expected > 0.0) peak.values *= seen(measure) / seen(expected);
    }
  }
  linear.x = x;
  return linear;
}

SmoothValue StatisticModel::measure(const LinearDraw::LoadCase& load_case, const Eigen::VectorXd& step) const {
  SmoothValue measure{0.0, Eigen::VectorXd::Zero(step.size())};
  for (std::size_t k = 0; k < load_case.terms.size(); ++k) {
    const LinearDraw::Peak& peak = load_case.terms[k];
    Eigen::Index leader = 0;
    const double root = std::max(0.0, (peak.values + peak.slopes * step).maxCoeff(&leader));
    const double weight = objective_.terms[k].weight * objective_.terms[k].outside_factor();
    measure.value += weight * std::pow(root, growth_);
    if (root > 0.0) measure.gradient += weight * growth_ * std::pow(root, growth_ - 1.0) * peak.slopes.row(leader).transpose();
  }
  return measure;
}

SmoothValue StatisticModel::seen(const LinearDraw& linear, const Eigen::VectorXd& x) const {
  const Eigen::VectorXd step = x - linear.x;
  SmoothValue measure = this->measure(linear.load_cases.front(), step);
  if (linear.load_cases.size() > 1) {
    std::vector<double> values, weights;
    std::vector<Eigen::VectorXd> gradients;
    for (const LinearDraw::LoadCase& load_case : linear.load_cases) {
      SmoothValue of_case = this->measure(load_case, step);
      values.push_back(of_case.value);
      gradients.push_back(std::move(of_case.gradient));
      weights.push_back(load_case.weight);
    }
    const std::vector<double> by = aggregate_weights(within_, values, weights);
    measure = {aggregate(within_, values, weights), Eigen::VectorXd::Zero(x.size())};
    for (std::size_t i = 0; i < by.size(); ++i) measure.gradient += by[i] * gradients[i];
  }
  if (growth_ == 1.0) return measure;
  if (!(measure.value > 0.0)) return {0.0, Eigen::VectorXd::Zero(x.size())};
  const double value = seen(measure.value);
  return {value, value / (growth_ * measure.value) * measure.gradient};
}

SmoothValue StatisticModel::seen(int draw, const Eigen::VectorXd& x) const {
  SmoothValue largest;
  for (const LinearDraw& linear : known_[static_cast<std::size_t>(draw)]) {
    SmoothValue value = seen(linear, x);
    if (largest.gradient.size() == 0 || value.value > largest.value) largest = std::move(value);
  }
  return largest;
}

std::vector<double> StatisticModel::measures(const Eigen::VectorXd& x, int first) const {
  std::vector<double> measures;
  for (int i = 0; i < draws(first); ++i) measures.push_back(knows(i) ? unseen(seen(i, x).value) : INFINITY);
  return measures;
}

double StatisticModel::seen(double value) const { return value > 0.0 ? std::pow(value, 1.0 / growth_) : 0.0; }

double StatisticModel::unseen(double seen) const { return seen > 0.0 ? std::pow(seen, growth_) : 0.0; }

std::vector<double> StatisticModel::weights(std::size_t draws) const {
  return {weights_.begin(), weights_.begin() + static_cast<std::ptrdiff_t>(draws)};
}

double StatisticModel::statistic(const std::vector<double>& measures) const {
  if (!is_band()) return aggregate(objective_.over, measures, weights(measures.size()));
  const std::vector<double> by = statistic_weights(measures);
  double sum = 0.0;
  for (std::size_t i = 0; i < by.size(); ++i) sum += by[i] != 0.0 ? by[i] * measures[i] : 0.0;
  return sum;
}

std::vector<double> StatisticModel::statistic_weights(const std::vector<double>& measures) const {
  if (!is_band()) return aggregate_weights(objective_.over, measures, weights(measures.size()));
  const std::vector<bool> left_out = beyond(measures);
  std::vector<double> of_others, by(measures.size(), 0.0), others;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (left_out[i]) continue;
    others.push_back(measures[i]);
    of_others.push_back(weights_[i]);
  }
  const std::vector<double> rest = aggregate_weights(of_rest(), others, of_others);
  for (std::size_t i = 0, k = 0; i < measures.size(); ++i) {
    if (!left_out[i]) by[i] = rest[k++];
  }
  return by;
}

void StatisticModel::smooth(int draws) {
  const double level = objective_.over.level;
  constexpr double standard_errors = 2.0, most_of_tail = 0.8;
  const double apart = standard_errors * std::sqrt(level * (1.0 - level) / draws);
  band_ = objective_.over == Aggregate::Quantile ? std::min(apart, most_of_tail * (1.0 - level)) : 0.0;
}

std::size_t StatisticModel::first(std::size_t draws) const {
  if (objective_.over == Aggregate::Worst) return 1;
  if (!is_of_tail(objective_.over)) return draws;
  return static_cast<std::size_t>(std::ceil((1.0 - objective_.over.level + band_) * static_cast<double>(draws)));
}

std::vector<bool> StatisticModel::beyond(const std::vector<double>& measures) const {
  if (!(objective_.over == Aggregate::Quantile)) return std::vector<bool>(measures.size(), false);
  return beyond_quantile(objective_.over.level + band_, measures, weights(measures.size()));
}

StatisticModel::Tangents StatisticModel::tangents(const Eigen::VectorXd& x, const std::vector<bool>& left_out, int first, double level) const {
  Tangents found;
  const bool is_largest = !is_band() && (objective_.over == Aggregate::Worst || objective_.over == Aggregate::Quantile);
  std::vector<double> all, of_all;
  std::vector<SmoothValue> values;
  found.value = -INFINITY;
  for (int i = 0; i < draws(first); ++i) {
    if (left_out[static_cast<std::size_t>(i)]) continue;
    SmoothValue value = seen(i, x);
    if (!is_largest) {
      all.push_back(unseen(value.value));
      of_all.push_back(weights_[static_cast<std::size_t>(i)]);
    }
    found.value = std::max(found.value, value.value);
    if (!is_largest || value.value >= level) values.push_back(std::move(value));
  }
  if (is_largest) {
    found.touching = std::move(values);
    return found;
  }
  const Aggregation over = is_band() ? of_rest() : objective_.over;
  const std::vector<double> by = aggregate_weights(over, all, of_all);
  SmoothValue value{aggregate(over, all, of_all), Eigen::VectorXd::Zero(x.size())};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (by[i] != 0.0 && values[i].value > 0.0) value.gradient += by[i] * growth_ * all[i] / values[i].value * values[i].gradient;
  }
  found.value = seen(value.value);
  if (value.value > 0.0) value.gradient *= found.value / (growth_ * value.value);
  value.value = found.value;
  found.touching = {std::move(value)};
  return found;
}

}  // namespace flankwright
