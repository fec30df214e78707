#include "studies/tasks/sweep/sweep_json.hpp"

#include <fmt/format.h>

#include "studies/tasks/sweep/sweep_statistics.hpp"
#include "studies/tasks/sweep/sweep_tables.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

namespace {

Json index_json(const SobolIndex& index) {
  return {{"first", index.first}, {"first_error", index.first_error}, {"first_within_95_percent", index_confidence(index.first_error)},
          {"total", index.total}, {"total_error", index.total_error}, {"total_within_95_percent", index_confidence(index.total_error)}};
}

Json worst_json(const StudyResults& results, const OutputStatistics& of, const StoredSample& sample) {
  if (of.worst < 0) return nullptr;
  Json parameters = Json::object();
  for (std::size_t j = 0; j < sample.values.size(); ++j) parameters[results.study.table<SweepTable>().parameters[j].path] = sample.values[j];
  return {{"sample", of.worst},
          {"value", of.output.smaller_is_worse ? of.smallest : of.largest},
          {"parameters", parameters},
          {"study", worst_study_name(of.output)}};
}

Json output_json(const StudyResults& results, const OutputStatistics& of, const StoredSample& worst) {
  Json quantiles = Json::object();
  for (std::size_t k = 0; k < quantile_shares.size(); ++k) quantiles[fmt::format("{:.0f} %", 100.0 * quantile_shares[k])] = of.quantiles[k];
  Json json{{"unit", of.output.unit},
            {"samples", of.count},
            {"mean", of.mean},
            {"std", of.deviation},
            {"min", of.smallest},
            {"max", of.largest},
            {"quantiles", quantiles},
            {"worst", worst_json(results, of, worst)},
            {"histogram", {{"low", of.histogram.low}, {"high", of.histogram.high}, {"counts", of.histogram.counts}}}};
  if (!of.indices.empty()) {
    Json& indices = json["indices"] = Json::object();
    for (std::size_t j = 0; j < of.indices.size(); ++j) indices[results.study.table<SweepTable>().parameters[j].path] = index_json(of.indices[j]);
  }
  return json;
}

/// Five significant digits: a map is looked at, and there are many.
Json shown(double value) {
  if (std::isnan(value)) return nullptr;
  return std::stod(fmt::format("{:.5g}", value));
}

Json map_json(const SweepStatistics& statistics, const std::vector<SweepParameter>& parameters, const ResponseMap& map) {
  Json rows = Json::array();
  for (std::size_t iy = 0; iy < statistics.parameters[map.y].counts.size(); ++iy) {
    Json row = Json::array();
    for (std::size_t ix = 0; ix < map.columns; ++ix) row.push_back(shown(map.mean(ix, iy)));
    rows.push_back(std::move(row));
  }
  return {{"output", statistics.outputs[map.output].output.name},
          {"x", parameters[map.x].path},
          {"y", parameters[map.y].path},
          {"mean", std::move(rows)}};
}

}  // namespace

Json sweep_json(const StudyResults& results) {
  const SweepStatistics& statistics = *results.found<SweepStatistics>();
  const SweepTable& sweep = results.study.table<SweepTable>();
  Json parameters = Json::array(), outputs = Json::object();
  for (std::size_t j = 0; j < sweep.parameters.size(); ++j) {
    const SweepParameter& p = sweep.parameters[j];
    const Histogram& range = statistics.parameters[j];
    parameters.push_back({{"path", p.path},
                          {"unit", p.unit},
                          {"distribution", p.in_words},
                          {"range", {{"low", range.low}, {"high", range.high}, {"counts", range.counts}}}});
    if (!range.levels.empty()) parameters.back()["range"]["levels"] = range.levels;
  }
  for (std::size_t k = 0; k < statistics.outputs.size(); ++k) {
    outputs[statistics.outputs[k].output.name] = output_json(results, statistics.outputs[k], statistics.worst[k]);
  }
  return {{"samples", statistics.samples},
          {"failed", statistics.failed},
          {"failures", list(statistics.failures,
                            [](const FailureCount& f) -> Json {
                              return {{"reason", f.reason}, {"count", f.count}, {"first_sample", f.first}};
                            })},
          {"seconds", statistics.seconds},
          {"sampler", to_string(sweep.sampler)},
          {"seed", sweep.seed},
          {"index_blocks", statistics.blocks},
          {"index_warning", index_warning(statistics)},
          {"parameters", parameters},
          {"outputs", list(statistics.outputs, [](const OutputStatistics& of) { return of.output.name; })},
          {"statistics", outputs},
          {"response_maps", list(statistics.maps, [&](const ResponseMap& map) { return map_json(statistics, sweep.parameters, map); })}};
}

}  // namespace flankwright::studies
