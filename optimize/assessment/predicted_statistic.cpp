#include "optimize/assessment/predicted_statistic.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "optimize/assessment/validation.hpp"
#include "optimize/design/scatter/draws.hpp"
#include "optimize/design/scatter/screening.hpp"
#include "optimize/design/two_level.hpp"

namespace flankwright {

namespace {

constexpr double normal_limit = 1.959963984540054;  // standard deviations either side that hold `confidence` of a normal distribution

/// Draws that could be analysed.
struct Known {
  std::vector<double> measures, weights;
};

Known known_of(const std::vector<double>& measures, const DesignTask& task, const std::vector<std::vector<int>>& draws) {
  Known known;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (std::isnan(measures[i])) continue;
    known.measures.push_back(measures[i]);
    known.weights.push_back(task.scenes[static_cast<std::size_t>(draws[i].front())].weight);
  }
  return known;
}

/// How much a statistic changes with the weight of each draw: its variance over the draws is n times that of the statistic
/// [Hampel, The influence curve and its role in robust estimation, J. Am. Stat. Assoc. 69 (1974)].
double influence_deviation(const Aggregation& over, const Known& known) {
  const double mean = aggregate(Aggregate::Mean, known.measures, known.weights);
  const double sigma = aggregate({Aggregate::MeanPlusSigmas, 1.0}, known.measures, known.weights) - mean;
  const double at_risk = over == Aggregate::Cvar ? aggregate({Aggregate::Quantile, 2.0, over.level}, known.measures, known.weights) : not_given;
  std::vector<double> influence;
  for (const double m : known.measures) {
    if (over == Aggregate::Cvar) {
      influence.push_back(std::max(0.0, m - at_risk) / (1.0 - over.level));
    } else {
      const double spread = over == Aggregate::MeanPlusSigmas && sigma > 0.0 ? over.sigmas * (std::pow(m - mean, 2) / sigma - sigma) / 2.0 : 0.0;
      influence.push_back(m - mean + spread);
    }
  }
  return aggregate({Aggregate::MeanPlusSigmas, 1.0}, influence, known.weights) - aggregate(Aggregate::Mean, influence, known.weights);
}

/// Measures of every draw; of a quantile or CVaR only the largest ones are those of the task's resolution.
std::vector<double> measures_of(const DesignTask& task, const std::vector<std::vector<int>>& draws, std::size_t deciding,
                                const PerGear<Modification>& modification, PredictedStatistic& books) {
  const std::vector<NamedDesign> design{{"predicted", "", modification}};
  const auto all_alike = [&](const std::vector<int>& draw) {
    return task.scenes[static_cast<std::size_t>(draw.front())].weight == task.scenes.front().weight;
  };
  const bool screens =
      is_of_tail(task.over) && can_be_coarser(task) && !task.combined_objective().over_spectrum() && std::ranges::all_of(draws, all_alike);
  const auto count = std::ssize(task.scenes);
  books.cycles += count;
  if (!screens) return validate_designs(task, task.scenes, design).front().measures;
  books.screening_cycles += count;
  std::vector<double> measures = validate_designs(screening_task(task), task.scenes, design).front().measures;
  // A draw that could not be screened is analysed with the first.
  for (double& m : measures) m = std::isnan(m) ? INFINITY : m;
  const auto deciding_of = [&](const std::vector<double>& of) {
    std::vector<double> sorted = of;
    std::ranges::sort(sorted, std::greater{});
    const double least = sorted[std::min(deciding, sorted.size()) - 1];
    std::vector<double> decides;
    for (const double m : of) decides.push_back(m >= least ? 1.0 : 0.0);
    return decides;
  };
  screen(measures, deciding, deciding_of, [&](const std::vector<int>& some) {
    std::vector<DesignScene> scenes;
    for (const int draw : some) {
      for (const int s : draws[static_cast<std::size_t>(draw)]) scenes.push_back(task.scenes[static_cast<std::size_t>(s)]);
    }
    books.cycles += std::ssize(scenes);
    std::vector<double> fine = validate_designs(task, scenes, design).front().measures;
    for (double& m : fine) m = std::isnan(m) ? -INFINITY : m;
    return fine;
  });
  for (double& m : measures) m = std::isfinite(m) ? m : not_given;
  return measures;
}

}  // namespace

std::pair<double, double> quantile_interval(double level, int draws, double confidence) {
  const double n = draws, outside = 0.5 * (1.0 - confidence);
  std::pair<double, double> levels{not_given, not_given};
  double below = 0.0;  // P(B < l)
  for (int l = 0; l <= draws; ++l) {
    if (below <= outside && l > 0) levels.first = l / n;
    if (below >= 1.0 - outside && l > 0) {
      levels.second = l / n;
      break;
    }
    below += std::exp(std::lgamma(n + 1.0) - std::lgamma(l + 1.0) - std::lgamma(n - l + 1.0) + l * std::log(level) + (n - l) * std::log1p(-level));
  }
  return levels;
}

PredictedStatistic predict_statistic(const DesignTask& task, const PerGear<Modification>& modification) {
  const Stopwatch clock;
  const auto drawn = draws_of(task.scenes, task.combined_objective().over_spectrum());
  const int draws = static_cast<int>(drawn.size());
  PredictedStatistic predicted;
  const bool is_quantile = task.over == Aggregate::Quantile;
  const auto levels = is_quantile ? quantile_interval(task.over.level, draws, PredictedStatistic::confidence) : std::pair{task.over.level, not_given};
  const double least_level = std::isnan(levels.first) ? 0.0 : levels.first;
  const auto deciding = static_cast<std::size_t>(std::ceil((1.0 - least_level) * static_cast<double>(drawn.size()))) + 1;
  const Known known = known_of(measures_of(task, drawn, deciding, modification, predicted), task, drawn);
  predicted.failed = static_cast<int>(drawn.size() - known.measures.size());
  if (!known.measures.empty()) {
    const auto value_of = [&](const Aggregation& over) { return aggregate(over, known.measures, known.weights); };
    predicted.value = value_of(task.over);
    if (is_quantile) {
      if (!std::isnan(levels.first)) predicted.low = value_of({Aggregate::Quantile, 2.0, levels.first});
      if (!std::isnan(levels.second)) predicted.high = value_of({Aggregate::Quantile, 2.0, levels.second});
    } else {
      const double error = normal_limit * influence_deviation(task.over, known) / std::sqrt(static_cast<double>(draws));
      predicted.low = predicted.value - error;
      predicted.high = predicted.value + error;
    }
  }
  predicted.seconds = clock.seconds();
  return predicted;
}

}  // namespace flankwright
