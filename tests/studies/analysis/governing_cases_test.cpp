#include "studies/analysis/governing_cases.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/report/report.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {
namespace {

const std::string three_torques = R"([pair]
normal_module = 4
helix_angle = 15
[pinion]
teeth = 21
face_width = 40
[wheel]
teeth = 40
face_width = 40
[load]
torque = [100, 300, 200]
[cycle]
positions = 4
[fidelity]
compliance = "thin_slice"
quadrature = { rule = "graded", intervals = 8 }
)";

StudyResults run_three_torques(const std::string& more = "") { return run_study(parse_study(three_torques + more, "three.toml")); }

std::size_t listed_points(const Json& loaded) {
  std::size_t count = 0;
  for (const Json& position : loaded.at("cycle")) {
    for (const Json& tooth : position.at("teeth")) count += tooth.at("points").size();
  }
  return count;
}

std::size_t lines_of(const std::string& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

std::string points_table(const StudyResults& results) {
  for (const NamedText& table : csv_tables(results)) {
    if (table.name == "points.csv") return table.text;
  }
  return {};
}

}  // namespace

TEST_CASE("All load cases have their points unless the study asks for those that govern", "[studies][results]") {
  const StudyResults all = run_three_torques(), governing = run_three_torques("[output]\npoints = \"governing\"\n");
  CHECK(cases_with_points(all) == std::vector<bool>{true, true, true});
  // The largest torque has the largest stress; transmission error may be the largest elsewhere, so that a case more may govern.
  const std::vector<bool> shown = cases_with_points(governing);
  REQUIRE(shown.size() == 3);
  CHECK(shown[1]);
  CHECK_FALSE(shown[0]);
  CHECK_FALSE(shown[2]);
  const Json whole = results_document(all), small = results_document(governing);
  std::size_t points = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Json &full = whole.at("loaded").at(i), &here = small.at("loaded").at(i);
    CHECK(here.at("summary") == full.at("summary"));
    CHECK(here.at("extremes") == full.at("extremes"));
    REQUIRE(here.at("cycle").size() == full.at("cycle").size());
    for (std::size_t k = 0; k < full.at("cycle").size(); ++k) {
      CHECK(here.at("cycle").at(k).at("te_um") == full.at("cycle").at(k).at("te_um"));
      const Json &teeth = here.at("cycle").at(k).at("teeth"), &full_teeth = full.at("cycle").at(k).at("teeth");
      REQUIRE(teeth.size() == full_teeth.size());
      for (std::size_t t = 0; t < teeth.size(); ++t) CHECK(teeth.at(t).at("share") == full_teeth.at(t).at("share"));
    }
    CHECK(listed_points(full) > 0);
    CHECK(listed_points(here) == (shown[i] ? listed_points(full) : 0));
    points += listed_points(here);
  }
  CHECK(small.at("used").at("output").at("points") == "governing");
  CHECK(small.at("used").at("output").at("points_by") == "study");
  CHECK(small.at("used").at("output").at("load_cases_with_points") == 1);
  CHECK(whole.at("used").at("output").at("points") == "all");
  CHECK(whole.at("used").at("output").at("load_cases_with_points") == 3);
  CHECK(lines_of(points_table(governing)) == points + 1);
  CHECK(render_report(small).size() < render_report(whole).size());
}

TEST_CASE("Beyond a number of load cases only the governing ones keep their points, unless the study says otherwise", "[studies][results]") {
  StudyResults many;
  const auto with_cases = [&](std::size_t count) {
    many.loaded.assign(count, {});
    for (std::size_t i = 0; i < count; ++i) {
      many.loaded[i].torque = 100.0 + static_cast<double>(i);
      many.loaded[i].summary.peak_contact_stress = 100.0 + static_cast<double>(i);
    }
  };
  with_cases(most_cases_with_points);
  CHECK(std::ranges::count(cases_with_points(many), true) == std::ssize(many.loaded));
  CHECK(points_note(many).empty());
  with_cases(most_cases_with_points + 1);
  const std::vector<bool> shown = cases_with_points(many);
  CHECK(shown.back());
  CHECK_FALSE(shown.front());
  CHECK_THAT(points_note(many), Catch::Contains("output.points") && Catch::Contains("1 to 3 MB"));
  // The study's own word wins, either way, and needs no note.
  many.study.points = CasesWithPoints::All;
  CHECK(std::ranges::count(cases_with_points(many), true) == std::ssize(many.loaded));
  CHECK(points_note(many).empty());
  many.study.points = CasesWithPoints::Governing;
  CHECK(cases_with_points(many) == shown);
  CHECK(points_note(many).empty());
  const std::string limit = std::to_string(most_cases_with_points);
  for (const SchemaKey& key : study_schema()) {
    if (key.path == "output.points") CHECK_THAT(key.fallback, Catch::Contains("up to " + limit + " load cases"));
  }
}

TEST_CASE("Of many load cases that are nearly the same only the largest keeps its points", "[studies][results]") {
  StudyResults alike;
  alike.loaded.assign(2 * most_cases_with_points, {});
  for (std::size_t i = 0; i < alike.loaded.size(); ++i) {
    alike.loaded[i].torque = static_cast<double>(i);
    alike.loaded[i].summary.peak_contact_stress = 1000.0 + 0.01 * static_cast<double>(i);
  }
  CHECK(std::ranges::count(governing_cases(alike), true) == std::ssize(alike.loaded));
  CHECK(std::ranges::count(cases_with_points(alike), true) == 1);
  CHECK(cases_with_points(alike).back());
}

TEST_CASE("Load cases govern on the flank that they load", "[studies][results]") {
  StudyResults both;
  both.loaded.assign(3, {});
  for (std::size_t i = 0; i < 3; ++i) {
    both.loaded[i].torque = static_cast<double>(i);
    both.loaded[i].summary.peak_contact_stress = std::array{900.0, 700.0, 500.0}[i];
    both.loaded[i].condition.other_flanks = i > 0;
  }
  CHECK(governing_cases(both) == std::vector<bool>{true, true, false});
}

TEST_CASE("A load case with the thinnest film, the hottest contact or the least safety governs", "[studies][results][life]") {
  StudyResults rated;
  rated.loaded.assign(5, {});
  rated.life = StudyLife{};
  for (std::size_t i = 0; i < 5; ++i) {
    rated.loaded[i].torque = static_cast<double>(i);
    CaseLife of;
    of.loaded = i;
    of.film = 1.0;
    of.contact_temperature = 100.0;
    of.contact_safety = {2.0, 2.0};
    if (i == 1) of.film = 0.5;
    if (i == 2) of.contact_temperature = 150.0;
    if (i == 3) of.contact_safety.wheel = 1.5;
    if (i == 4) continue;  // was not rated
    rated.life->cases.push_back(of);
  }
  // Case 0 is among the least safe of the pinion, whose safety is the same in all.
  const std::vector<bool> governs = governing_cases(rated);
  CHECK((governs[1] && governs[2] && governs[3]));
  CHECK_FALSE(governs[4]);
}

TEST_CASE("A choice of load cases that does not exist is refused", "[studies][results]") {
  using Catch::Contains;
  CHECK_THROWS_WITH(run_three_torques("[output]\npoints = \"some\"\n"), Contains("output.points") && Contains("governing"));
}

}  // namespace flankwright::studies
