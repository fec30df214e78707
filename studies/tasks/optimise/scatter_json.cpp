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

Json predicted_json(const PredictedStatistic& predicted) {
  return {{"value", predicted.value},
          {"confidence", PredictedStatistic::confidence},
          {"low", predicted.low},
          {"high", predicted.high},
          {"failed", predicted.failed},
          {"cycles", predicted.cycles},
          {"screening_cycles", predicted.screening_cycles},
          {"seconds", predicted.seconds}};
}

/// Each constraint on an output over the draws. For a lower limit the statistic is that of the reciprocal.
Json limits_json(const PredictedDesign& of, const DesignTask& task) {
  Json limits = Json::array();
  for (std::size_t c = 0; c < of.searched_limits.size() && !of.design.bounds.empty(); ++c) {
    const OutputConstraint& limit = task.constraints[c];
    const auto shown = [&](double statistic) { return of_output(limit, statistic); };
    Json row{{"name", limit.output.name},
             {"unit", limit.output.unit()},
             {"value", shown(of.design.bounds[task.objective_bounds.size() + c])},
             {limit.is_least() ? "min" : "max", limit.limit() * limit.output.outside_factor()},
             {"searched_limit", shown(of.searched_limits[c])}};
    if (!of.predicted_limits.empty()) {
      const PredictedStatistic& predicted = of.predicted_limits[c];
      row["predicted"] = {{"value", shown(predicted.value)},
                          {"low", shown(limit.is_least() ? predicted.high : predicted.low)},
                          {"high", shown(limit.is_least() ? predicted.low : predicted.high)}};
    }
    limits.push_back(std::move(row));
  }
  return limits;
}

/// ", between 580 and 600 with 95 % confidence"; empty where a limit is not known.
std::string interval_in_words(const PredictedStatistic& predicted) {
  if (std::isnan(predicted.low) || std::isnan(predicted.high)) return "";
  return fmt::format(", between {:.5g} and {:.5g} with {:g} % confidence", predicted.low, predicted.high, percent * PredictedStatistic::confidence);
}

}  // namespace

std::string statistic_in_words(const Aggregation& statistic) {
  if (statistic == Aggregate::Quantile) return fmt::format("{:g} % quantile", percent * statistic.level);
  if (statistic == Aggregate::Cvar) return fmt::format("mean of the worst {:g} %", percent * (1.0 - statistic.level));
  return fmt::format("mean + {:g} sigma", statistic.sigmas);
}

std::string statistic_in_words(const Aggregation& statistic, const OutputConstraint& of) {
  if (!of.is_least()) return "the " + statistic_in_words(statistic);
  if (statistic == Aggregate::Quantile) return fmt::format("the {:g} % quantile", percent * (1.0 - statistic.level));
  return fmt::format("the reciprocal of the {} of 1/value", statistic_in_words(statistic));
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
    json["predicted"] = predicted_json(result.predicted);
    json["predicted"].update({{"draws", asked.predicted_from}, {"seed", asked.predicted_seed}});
    json["without_scatter"]["predicted"] = result.without_predicted.value;
  }
  json["deciding"] = deciding_json(result);
  json["constraints"] = limits_json(result, task);
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
      Json row{{"iso_1328_class", c.tolerance_class}, {"peak_contact_stress_MPa", c.contact_stress},
               {"te_peak_to_peak_um", c.te},          {"without_scatter_value", c.without_scatter},
               {"statistic_value", c.statistic()},    {"constraint_violation", c.design.violation},
               {"constraints", limits_json(c, task)}};
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
    std::string csv = "iso_1328_class,status,objective,objective_without_scatter,peak_contact_stress_MPa,te_peak_to_peak_um";
    for (const DesignVariable& v : task.variables) csv += fmt::format(",{} [{}]", v.path, v.unit());
    csv += "\n";
    for (const ClassDesign& c : result.classes) {
      csv +=
          fmt::format("{},{},{},{},{},{}", c.tolerance_class, to_string(c.design.status), c.statistic(), c.without_scatter, c.contact_stress, c.te);
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
  const std::string took = fmt::format("{} in {:.1f} s", to_string(result.design.status), result.design.seconds);
  const auto beside = [&](double without, double with) {
    return fmt::format("{:.5g} {} without scatter in the search, {:.5g} {} with it ({:+.1f} %)", without, unit, with, unit,
                       percent * (with / without - 1.0));
  };
  const PredictedStatistic& predicted = result.predicted;
  std::string out;
  if (std::isnan(predicted.value)) {
    out = fmt::format("\n{} over {} draws of the search{}: {}; {}\n", statistic, asked.draws, load_cases_in_words(study),
                      beside(result.without_value, result.design.value), took);
  } else {
    out = fmt::format("\n{} predicted from {} draws that the search has not seen{}: {}{}\n{:.5g} {} over the {} draws of the search; {}\n", statistic,
                      asked.predicted_from, load_cases_in_words(study), beside(result.without_predicted.value, predicted.value),
                      interval_in_words(predicted), result.design.value, unit, asked.draws, took);
  }
  for (std::size_t c = 0; c < result.predicted_limits.size(); ++c) {
    const OutputConstraint& limit = task.constraints[c];
    out += fmt::format("{} {} {:.5g}{}: {:.5g} predicted, {:.5g} over the draws of the search\n", plain_name(limit.output.name),
                       limit.is_least() ? ">=" : "<=", limit.limit() * limit.output.outside_factor(), behind_number(limit.output.unit()),
                       of_output(limit, result.predicted_limits[c].value), of_output(limit, result.design.bounds[task.objective_bounds.size() + c]));
  }
  if (!result.fresh.empty()) {
    const double error = std::isnan(predicted.value) ? result.search_error() : result.prediction_error();
    out += fmt::format("over {} fresh draws: {:.5g} {} before, {:.5g} without scatter, {:.5g} after; {} {:+.1f} % beside them\n", asked.fresh,
                       result.fresh[0].statistic, unit, result.fresh[1].statistic, result.fresh[2].statistic,
                       std::isnan(predicted.value) ? "the draws of the search are" : "the prediction is", percent * error);
  }
  for (const ClassDesign& c : result.classes) {
    out += fmt::format("class {:>2}: {:.5g} {}", c.tolerance_class, c.statistic(), unit);
    if (!is_objective(task, Output::PeakContactStress)) out += fmt::format(", peak contact stress {:.5g} MPa", c.contact_stress);
    if (!is_objective(task, Output::TePeakToPeak)) out += fmt::format(", transmission error {:.3g} um", c.te);
    if (c.design.status == SolverStatus::Infeasible)
      out += fmt::format("; no design keeps the limits, this one exceeds them by {:.3g} %", percent * c.design.violation);
    out += "\n";
  }
  return out;
}

}  // namespace flankwright::studies
