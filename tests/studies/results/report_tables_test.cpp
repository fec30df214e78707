#include "studies/results/report_tables.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "studies/analysis/run_study.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

std::map<std::string, std::string> tables_of(const std::string& study, const std::vector<Override>& overrides = {}) {
  std::map<std::string, std::string> tables;
  for (const NamedText& table : report_tables(results_document(run_study(parse_study(study, "a", overrides))))) tables[table.name] = table.text;
  return tables;
}

/// Cells outside of quotes in every line: the same number in all.
void check_columns(const std::string& csv) {
  std::size_t columns = 0, cells = 1, lines = 0;
  bool quoted = false;
  for (const char c : csv) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    cells += c == ',' ? 1 : 0;
    if (c != '\n') continue;
    if (lines++ == 0) columns = cells;
    CHECK(cells == columns);
    cells = 1;
  }
  CHECK(lines > 1);
}

}  // namespace

TEST_CASE("Every table of the report is a CSV file with as many cells in every line", "[studies][tables]") {
  const auto tables = tables_of(small::analysis(), {{"scenes.0.name", "a, \"b\""}, {"cycle.peaks", "sampled"}});
  CHECK(tables.size() == 7);
  for (const auto& [name, csv] : tables) {
    CAPTURE(name);
    check_columns(csv);
  }
  CHECK_THAT(tables.at("gears.csv"), Catch::Contains("\nteeth,,18,54\n") && Catch::Contains("path_of_contact_mm.T1_A,"));
  CHECK_THAT(tables.at("given.csv"), Catch::Contains("\npinion.modification.tip_relief.height,3,mm\n"));
  CHECK_THAT(tables.at("used.csv"), Catch::Contains("\nfidelity.compliance,thin_slice\n"));
  CHECK_THAT(tables.at("summary.csv"), Catch::Contains("\"a, \"\"b\"\"\",1014.868,given,,te_peak_to_peak_um,"));
  CHECK_THAT(tables.at("effects.csv"), Catch::Contains("\nbending,true,"));
  CHECK_THAT(tables.at("steps.csv"), Catch::Contains("\nload_distribution,"));
}

TEST_CASE("The tables hold the numbers of results.json", "[studies][tables]") {
  const std::string text = results_json(run_study(parse_study(small::optimisation(), "a", {{"optimise.max_evaluations", "5"}})));
  const nlohmann::json json = nlohmann::json::parse(text);
  std::map<std::string, std::string> tables;
  for (const NamedText& table : report_tables(Json::parse(text))) tables[table.name] = table.text;
  check_columns(tables.at("design.csv"));
  for (const auto& [name, value] : json["optimise"]["after"]["variables"].items()) {
    const std::string line = "variable," + name + ",um,";
    if (name.ends_with("length")) continue;
    const std::size_t at = tables.at("design.csv").find(line);
    REQUIRE(at != std::string::npos);
    const std::string rest = tables.at("design.csv").substr(at + line.size());
    CHECK(std::stod(rest.substr(rest.find(',') + 1)) == value.get<double>());
  }
  CHECK_THAT(tables.at("design.csv"), Catch::Contains("constraint,te_peak_to_peak,um,"));
  // The last columns of the objective are its errors.
  const nlohmann::json& optimise = json["optimise"];
  const std::string errors =
      fmt::format(",{},{}\n", optimise["before"]["objective_error"].get<double>(), optimise["after"]["objective_error"].get<double>());
  CHECK_THAT(tables.at("design.csv"), Catch::Contains(errors));
  const std::string& harmonics = tables.at("harmonics.csv");
  std::size_t orders = 0;
  for (const nlohmann::json& loaded : json["loaded"]) orders += loaded["summary"]["te_harmonics_um"].size();
  CHECK(static_cast<std::size_t>(std::count(harmonics.begin(), harmonics.end(), '\n')) == 1 + orders);
}
