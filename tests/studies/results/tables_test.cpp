#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/results/tables.hpp"
#include "studies/results/used_json.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "studies/base/csv.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "studies/analysis/run_study.hpp"

namespace flankwright::studies {
namespace {

using Row = std::vector<std::string>;

/// Reads CSV as RFC 4180 defines it.
std::vector<Row> parse_csv(const std::string& text) {
  std::vector<Row> rows;
  Row row;
  std::string cell;
  bool inside_quotes = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inside_quotes) {
      if (c != '"') {
        cell += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else {
        inside_quotes = false;
      }
    } else if (c == '"') {
      inside_quotes = true;
    } else if (c == ',' || c == '\n') {
      row.push_back(cell);
      cell.clear();
      if (c == '\n') rows.push_back(std::exchange(row, {}));
    } else {
      cell += c;
    }
  }
  REQUIRE_FALSE(inside_quotes);
  return rows;
}

std::map<std::string, std::vector<Row>> tables_of(const StudyResults& results) {
  std::map<std::string, std::vector<Row>> tables;
  for (const NamedText& table : csv_tables(results)) tables[table.name] = parse_csv(table.text);
  return tables;
}

}  // namespace

TEST_CASE("CSV tables read back whole, whatever a scene is called", "[studies][tables]") {
  StudyResults results = run_study(parse_study(small::analysis(), "small.toml"));
  const std::string awkward = "hot, \"full\"\ntorque";
  results.loaded.front().scene = awkward;
  results.unloaded.front().scene = awkward;
  const auto tables = tables_of(results);
  CHECK(tables.size() == 7);
  for (const auto& [name, rows] : tables) {
    CAPTURE(name);
    REQUIRE(rows.size() > 1);
    for (const Row& row : rows) CHECK(row.size() == rows.front().size());
    CHECK(rows[1].front() == awkward);
  }
  // One line for each transfer point, and one for each grid point of both flanks in both scenes.
  std::size_t transfers = 0, grid_points = 0;
  for (const UnloadedResult& unloaded : results.unloaded) {
    transfers += unloaded.mesh.transfers.size();
    grid_points += static_cast<std::size_t>(unloaded.pinion_pattern.separation.size() + unloaded.wheel_pattern.separation.size());
  }
  CHECK(tables.at("transfers.csv").size() == 1 + transfers);
  CHECK(tables.at("bearing_pattern.csv").size() == 1 + grid_points);
  // One line for each position of both scenes, and for each contact point of them.
  CHECK(tables.at("cycle.csv").size() == 1 + 2 * 6);
  std::size_t points = 0;
  for (const LoadedPosition& position : results.loaded[0].cycle.positions) points += static_cast<std::size_t>(position.contact_stress.size());
  CHECK(tables.at("points.csv").size() == 1 + 2 * points);
  // Load distribution factors three ways.
  CHECK(tables.at("load_factors.csv").size() == 1 + 2 * 4);
  // Every tooth pair's share, 1 in all.
  std::map<std::string, double> sums;
  for (std::size_t i = 1; i < tables.at("load_sharing.csv").size(); ++i) {
    const Row& row = tables.at("load_sharing.csv")[i];
    sums[row[0] + row[4]] += std::stod(row[7]);
  }
  CHECK(sums.size() == 2 * 6);
  for (const auto& [position, sum] : sums) CHECK(sum == Approx(1).epsilon(1e-11));
}

TEST_CASE("A name that a spreadsheet would take for a formula stays a text, a number stays a number", "[studies][tables]") {
  for (const char* name : {"=1+1", "+16 um", "-16 um", "@sum"}) CHECK(csv_field(name) == "'" + std::string(name));
  CHECK(csv_field("=a,b") == "\"'=a,b\"");
  for (const char* name : {"", "aligned", "-16", "-1.5e-3", "a=b", "16 um"}) CHECK(csv_field(name) == name);
  StudyResults results = run_study(parse_study(small::analysis(), "small.toml"));
  for (LoadedResult& loaded : results.loaded) loaded.scene = "=2*3";
  CHECK(tables_of(results).at("cycle.csv")[1].front() == "'=2*3");
}

TEST_CASE("Load factors of several torques have the torque beside them", "[studies][tables]") {
  const std::string table = summary_table(run_study(parse_study(small::analysis(), "small.toml", {{"load.torque", "[500, 1000]"}})));
  std::istringstream lines(table.substr(table.find("load factors")));
  std::map<std::string, int> torques;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string scene, torque;
    if (line.find("without spikes") != std::string::npos && words >> scene >> torque) ++torques[torque];
  }
  CHECK(torques == std::map<std::string, int>{{"500", 2}, {"1000", 2}});
}

TEST_CASE("CSV numbers carry every digit", "[studies][tables]") {
  const StudyResults results = run_study(parse_study(small::analysis(), "small.toml"));
  const auto tables = tables_of(results);
  const Row& header = tables.at("points.csv").front();
  const auto column = static_cast<std::size_t>(std::find(header.begin(), header.end(), "contact_stress_MPa") - header.begin());
  REQUIRE(column < header.size());
  double peak = 0.0;
  for (std::size_t i = 1; i < tables.at("points.csv").size(); ++i) {
    const Row& row = tables.at("points.csv")[i];
    if (row.front() == results.loaded[0].scene) peak = std::max(peak, std::stod(row[column]));
  }
  for (const LoadedPosition& extreme : results.loaded[0].resolved.extreme_cycle.positions) peak = std::max(peak, extreme.contact_stress.maxCoeff());
  CHECK(peak == results.loaded[0].summary.peak_contact_stress);
}

TEST_CASE("An optimisation adds the tables of its scenes and its history", "[studies][tables]") {
  const StudyResults results = run_study(parse_study(small::optimisation(), "small.toml"));
  const auto tables = tables_of(results);
  REQUIRE(tables.count("scenes.csv") == 1);
  CHECK(tables.at("scenes.csv").size() == 1 + 3);
  CHECK(tables.at("history.csv").size() == 1 + optimised(results).design.history.size());
  CHECK(std::stod(tables.at("scenes.csv")[2][4]) == optimised(results).design.after.scene_measures[1]);
  const std::string summary = summary_table(results);
  for (const char* said : {"pinion lead crowning", "bent back", "over the scenes", "peak-to-peak TE <= 5 um", "nlopt:slsqp: converged", "known to"}) {
    CHECK_THAT(summary, Catch::Contains(said));
  }
}

TEST_CASE("What was used is shown as it was given, without the round-off of conversions", "[studies][output]") {
  REQUIRE(in_deg(30.0 * units::deg) != 30.0);
  const StudyResults results =
      run_study(parse_study(small::helical_pair(), "used.toml", {{"pair.helix_angle", "30"}, {"fidelity.compliance", "rigid"}}));
  CHECK(used_json(results).at("pair").at("helix_angle_deg").get<double>() == 30.0);
  CHECK(units::without_round_off(1.0 / 3.0) == 1.0 / 3.0);
  CHECK(units::without_round_off(-5.999999999999999) == -6.0);
  CHECK(units::without_round_off(1e-12) == 1e-12);
}

}  // namespace flankwright::studies
