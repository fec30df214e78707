#include "studies/tasks/optimise/scatter_json.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/base/plain_names.hpp"
#include "studies/tasks/optimise/assessment_json.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

Json search_json(const ScatterDesign& design, const DesignTask& task) {
  Json json{{"status", to_string(design.status)},
            {"message", design.message},
            {"variables", variables_json(unscaled(design.x, task), task)},
            {"value", design.value},
            {"steps", design.steps},
            {"draws_deciding", design.decided_by},
            {"cycles", design.cycles},
            {"screening_cycles", design.screening_cycles},
            {"seconds", design.seconds}};
  if (!std::isnan(design.exact_value)) json["exact_value"] = design.exact_value;
  return json;
}

Json fresh_json(const FreshDesign& fresh) {
  const Spread spread = spread_of(fresh.design.measures);
  return {{"name", fresh.design.name}, {"statistic", fresh.statistic}, {"mean", spread.mean},    {"deviation", spread.deviation},
          {"least", spread.least},     {"greatest", spread.greatest},  {"failed", spread.failed}};
}

/// Draws that the statistic hangs on, largest weight first.
Json deciding_json(const ScatterResult& result) {
  constexpr std::size_t most_shown = 40;
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < result.design.weights.size(); ++s) {
    if (result.design.weights[s] != 0.0) order.push_back(s);
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return result.design.weights[a] > result.design.weights[b]; });
  if (order.size() > most_shown) order.resize(most_shown);
  return list(order, [&](std::size_t s) -> Json {
    const std::vector<DesignScene>& load_cases = result.draws[s];
    return {{"draw", name_of_draw(load_cases.front().draw)},
            {"torque_Nm", load_cases.size() == 1 ? Json(in_Nm(load_cases.front().torque)) : Json()},
            {"weight", result.design.weights[s]},
            {"value", result.design.measures[s]}};
  });
}

}  // namespace

std::string statistic_in_words(const Aggregation& statistic) {
  if (statistic == Aggregate::Quantile) return fmt::format("{:g} % quantile", percent * statistic.level);
  if (statistic == Aggregate::Cvar) return fmt::format("mean of the worst {:g} %", percent * (1.0 - statistic.level));
  return fmt::format("mean + {:g} sigma", statistic.sigmas);
}

std::string statistic_of_choices(const StudyResults& results) {
  return optimised(results).scatter ? statistic_in_words(results.study.table<OptimiseTable>().scatter.statistic) : "";
}

Json scatter_json(const ScatterResult& result, const DesignTask& task, const Study& study) {
  const ScatterTable& asked = study.table<OptimiseTable>().scatter;
  Json json{{"statistic", to_string(asked.statistic)},
            {"statistic_in_words", statistic_in_words(asked.statistic)},
            {"objective_name", task.objective_name()},
            {"unit", task.objective_unit()},
            {"draws", asked.draws},
            {"seed", asked.seed},
            {"states", list(result.states, [](const OperatingState& state) -> Json { return state.scene.name; })},
            {"load_cases_of_a_draw", result.draws.front().size()},
            {"within_draw", to_string(task.within_draw)},
            {"tolerances", list(study.tolerances, tolerance_json)}};
  if (study.tolerance_class) json["iso_1328_class"] = *study.tolerance_class;
  json.update(search_json(result.design, task));
  json["without_scatter"] = {
      {"variables", variables_json(result.without, task)}, {"value", result.without_value}, {"seconds", result.search_seconds}};
  if (!std::isnan(result.predicted.value)) {
    const PredictedStatistic& predicted = result.predicted;
    json["predicted"] = {{"draws", asked.predicted_from},
                         {"seed", asked.predicted_seed},
                         {"value", predicted.value},
                         {"confidence", PredictedStatistic::confidence},
                         {"low", predicted.low},
                         {"high", predicted.high},
                         {"failed", predicted.failed},
                         {"cycles", predicted.cycles},
                         {"screening_cycles", predicted.screening_cycles},
                         {"seconds", predicted.seconds}};
  }
  json["deciding"] = deciding_json(result);
  json["constraints"] = Json::array();
  for (std::size_t c = 0; c < result.design.bounds.size(); ++c) {
    const OutputConstraint& bound = task.constraints[c];
    const double of_draws = result.design.bounds[c];  // of a lower limit it is the statistic of the reciprocal
    json["constraints"].push_back({{"name", bound.output.name},
                                   {"unit", bound.output.unit()},
                                   {"value", bound.is_least() ? 1.0 / of_draws : of_draws},
                                   {bound.is_least() ? "min" : "max", bound.limit() * bound.output.outside_factor()}});
  }
  if (!result.fresh.empty()) {
    json["fresh"] = {{"draws", asked.fresh},
                     {"seed", asked.fresh_seed},
                     {"search_error_percent", percent * result.search_error()},
                     {"seconds", result.fresh_seconds},
                     {"designs", list(result.fresh, fresh_json)}};
    if (!std::isnan(result.prediction_error())) json["fresh"]["prediction_error_percent"] = percent * result.prediction_error();
  }
  if (!result.classes.empty()) {
    json["classes"] = list(result.classes, [&](const ClassDesign& c) -> Json {
      Json row{{"iso_1328_class", c.tolerance_class},
               {"peak_contact_stress_MPa", c.contact_stress},
               {"te_peak_to_peak_um", c.te},
               {"without_scatter_value", c.without_scatter}};
      row.update(search_json(c.design, task));
      return row;
    });
    json["classes_seconds"] = result.classes_seconds;
  }
  return json;
}

std::vector<NamedText> scatter_tables(const ScatterResult& result, const DesignTask& task) {
  std::vector<NamedText> tables;
  if (!result.classes.empty()) {
    std::string csv = "iso_1328_class,objective,objective_without_scatter,peak_contact_stress_MPa,te_peak_to_peak_um";
    for (const DesignVariable& v : task.variables) csv += fmt::format(",{} [{}]", v.path, v.unit());
    csv += "\n";
    for (const ClassDesign& c : result.classes) {
      csv += fmt::format("{},{},{},{},{}", c.tolerance_class, c.design.value, c.without_scatter, c.contact_stress, c.te);
      const std::vector<double> values = unscaled(c.design.x, task);
      for (std::size_t i = 0; i < values.size(); ++i) csv += fmt::format(",{}", task.variables[i].outside(values[i]));
      csv += "\n";
    }
    tables.push_back({"classes.csv", csv});
  }
  if (!result.fresh.empty()) {
    std::string csv = "draw";
    for (const FreshDesign& d : result.fresh) csv += "," + d.design.name;
    csv += "\n";
    for (std::size_t s = 0; s < result.fresh.front().design.measures.size(); ++s) {
      csv += std::to_string(s + 1);
      for (const FreshDesign& d : result.fresh) csv += fmt::format(",{}", d.design.measures[s]);
      csv += "\n";
    }
    tables.push_back({"scatter.csv", csv});
  }
  return tables;
}

std::string scatter_summary(const ScatterResult& result, const DesignTask& task, const Study& study) {
  const ScatterTable& asked = study.table<OptimiseTable>().scatter;
  const std::string statistic = statistic_in_words(asked.statistic), unit = task.objective_unit();
  std::string out = fmt::format("\n{} over {} draws{}: {:.5g} {} without scatter in the search, {:.5g} {} with it ({:+.1f} %); {} in {:.1f} s\n",
                                statistic, asked.draws, load_cases_in_words(study), result.without_value, unit, result.design.value, unit,
                                percent * (result.design.value / result.without_value - 1.0), to_string(result.design.status), result.design.seconds);
  const PredictedStatistic& predicted = result.predicted;
  if (!std::isnan(predicted.value)) {
    const bool has_both = !std::isnan(predicted.low) && !std::isnan(predicted.high);
    out += fmt::format("predicted from {} draws that the search has not seen: {:.5g} {}{}\n", asked.predicted_from, predicted.value, unit,
                       has_both ? fmt::format(", between {:.5g} and {:.5g} with {:g} % confidence", predicted.low, predicted.high,
                                              percent * PredictedStatistic::confidence)
                                : "");
  }
  if (!result.fresh.empty()) {
    const double error = std::isnan(predicted.value) ? result.search_error() : result.prediction_error();
    out += fmt::format("over {} fresh draws: {:.5g} {} before, {:.5g} without scatter, {:.5g} after; predicted within {:.1f} %\n", asked.fresh,
                       result.fresh[0].statistic, unit, result.fresh[1].statistic, result.fresh[2].statistic, percent * std::abs(error));
  }
  for (const ClassDesign& c : result.classes) {
    out += fmt::format("class {:>2}: {:.5g} {}", c.tolerance_class, c.design.value, unit);
    if (!is_objective(task, Output::PeakContactStress)) out += fmt::format(", peak contact stress {:.5g} MPa", c.contact_stress);
    if (!is_objective(task, Output::TePeakToPeak)) out += fmt::format(", transmission error {:.3g} um", c.te);
    out += "\n";
  }
  return out;
}

}  // namespace flankwright::studies
