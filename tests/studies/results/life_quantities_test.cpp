#include "studies/analysis/life_quantities.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/gear/both_gears.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/comparison/compared_values.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/optimise/life_error.hpp"
#include "studies/tasks/sweep/sample_analysis.hpp"
#include "tests/studies/study_file/life_texts.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"

/// A quantity of life is one row of life_quantities(): every row of that table appears in all outputs.
namespace flankwright::studies {
namespace {

const std::string rated_oil = R"(
[lubricant]
viscosity_40 = 100
viscosity_100 = 11
temperature = 80
roughness = 0.5
scuffing_temperature = 250
permissible_film = 0.2
)";

StudyResults rated() {
  return run_study(
      parse_study(life_pair + life_strength + rated_oil + "[load]\nspeed = 1500\nspectrum = [{ torque = 300, hours = 10 }]\n", "life.toml"));
}

/// Column names and the first line below them; cells of life.csv have no commas.
std::vector<std::pair<std::string, std::string>> first_line_of(const std::string& csv) {
  const auto cells_from = [&](std::size_t at) {
    std::vector<std::string> cells{""};
    for (; csv.at(at) != '\n'; ++at) {
      if (csv[at] == ',') {
        cells.emplace_back();
      } else {
        cells.back() += csv[at];
      }
    }
    return cells;
  };
  const std::vector<std::string> names = cells_from(0), values = cells_from(csv.find('\n') + 1);
  REQUIRE(names.size() == values.size());
  std::vector<std::pair<std::string, std::string>> cells;
  for (std::size_t i = 0; i < names.size(); ++i) cells.emplace_back(names[i], values[i]);
  return cells;
}

TEST_CASE("Every quantity of life has its value and error in the results, the tables and the errors of an optimisation, by its own key",
          "[studies][results][life][quantities]") {
  const StudyResults results = rated();
  const CaseLife& of = results.life.value().cases.at(0);
  const Json document = results_document(results);
  const Json& shown = document.at("life").at("cases").at(0);
  const std::vector<NamedText> tables = csv_tables(results);
  const auto cells = first_line_of(std::ranges::find(tables, "life.csv", &NamedText::name)->text);
  const auto has_column = [&](const std::string& name, double value) {
    return std::ranges::count_if(cells, [&](const auto& cell) {
             return cell.first == name && (std::isnan(value) ? cell.second.empty() : !cell.second.empty() && std::stod(cell.second) == value);
           }) == 1;
  };
  const std::string summary = summary_table(results);
  for (const LifeQuantity& quantity : life_quantities()) {
    const std::string key(quantity.key);
    INFO(key);
    CHECK((quantity.of_pair == nullptr) != (quantity.of_gears == nullptr));
    for (const Member m : both_gears) {
      const Json &where = quantity.of_pair != nullptr ? shown : shown.at(name_of(m)), &value = where.at(key);
      CHECK((value.is_number() && value.get<double>() == quantity.of(of, m)) != std::isnan(quantity.of(of, m)));
      CHECK(where.contains(key + "_error") == (quantity.error != nullptr));
    }
    if (quantity.is_in_csv) CHECK(has_column(key, quantity.of(of, Member::Pinion)));
    if (quantity.error != nullptr) {
      const double error = of.errors.*quantity.error;
      CHECK(error > 0.0);
      CHECK(shown.at(key + "_error").get<double>() == error);
      CHECK(has_column(key + "_error", error));
      if (quantity.output && !quantity.is_reciprocal) CHECK(life_error(*results.life, of.loaded, *quantity.output) == error);
    }
    if (!std::isnan(quantity.worst(of))) CHECK(summary.find(quantity.column.heading) != std::string::npos);
  }
}

TEST_CASE("An error of a safety is one of its reciprocal in an optimisation", "[studies][results][life][quantities]") {
  const StudyResults results = rated();
  const CaseLife& of = results.life.value().cases.at(0);
  const double safety = of.scuffing_safety, error = life_error(*results.life, of.loaded, Output::ScuffingUtilisation);
  CHECK(error == Approx(of.errors.scuffing_safety / (safety * safety)).epsilon(1e-14));  // round-off
}

TEST_CASE("A comparison puts the main quantities of life into its short table", "[studies][results][life][quantities]") {
  const Json document = results_document(rated());
  const ComparedRuns runs = compare_runs({{"a", document}, {"b", document}});
  for (const LifeQuantity& quantity : life_quantities()) {
    INFO(quantity.key);
    for (const ComparedValue& value : runs.values) {
      const bool is_this = value.section.starts_with("life, ") && std::string_view(value.name).substr(value.name.rfind('.') + 1) == quantity.key;
      const bool is_sum = value.section.starts_with("life, spectrum");
      if (is_this && !is_sum) CHECK(value.headline == quantity.is_compared);
    }
  }
}

TEST_CASE("A sweep has every quantity of life that its nominal sample has a number for, and the damage of each gear that its spectrum has",
          "[studies][results][life][quantities]") {
  const std::string spectrum = "{ spectrum = [{ torque = 600, cycles = 1e8, speed = 1000 }] }";
  const StudyResults nominal =
      run_study(parse_study(small::sweep("samples = 24") + life_strength + rated_oil, "sweep.toml",
                            {{"load", spectrum}, {"sweep.parameters", "{ \"misalignment.mesh_misalignment\" = { normal = [0, 6] } }"}}));
  const SampleAnalysis analysis(nominal);
  const auto count = [&](const std::string& name) { return std::ranges::count(analysis.outputs(), name, &SweepOutput::name); };
  const CaseLife& of = nominal.life.value().cases.at(0);
  for (const LifeQuantity& quantity : life_quantities()) {
    const std::string key(quantity.key);
    INFO(key);
    const bool is_known = quantity.is_sampled && !std::isnan(quantity.worst(of));
    CHECK(count(key) == (is_known ? 1 : 0));
    if (is_known) CHECK(std::ranges::find(analysis.outputs(), key, &SweepOutput::name)->unit == quantity.unit());
    for (const Member m : both_gears) {
      const bool is_damaged = quantity.of_spectrum != nullptr && (nominal.life->spectra.at(0).*quantity.of_spectrum)[m].has_value();
      CHECK(count(std::string(name_of(m)) + "_" + key) == (is_damaged ? 1 : 0));
    }
  }
}

}  // namespace
}  // namespace flankwright::studies
