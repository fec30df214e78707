#include <catch2/catch.hpp>
#include <sstream>

#include "studies/results/expectations.hpp"
#include "studies/tasks/fit/fit_tables.hpp"
#include "studies/base/json_format.hpp"
#include "studies/report/report.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/study_template.hpp"
#include "tests/core/compliance/comparison/distance_compliance.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;
using json = Json;

/// A study whose pinion has been fitted with a coarse mesh, a narrow face and hardly any steps.
StudyResults fitted_results() {
  StudyResults results;
  results.study =
      parse_study(study_template("fit"), "fit.toml", {{"pinion.face_width", "12"}, {"wheel.face_width", "12"}, {"fit.form", "several_teeth"}});
  results.pair = make_gear_pair(results.study.pair);
  GearFitTask task = gear_fit_task(results.study, results.pair, Member::Pinion);
  task.mesh = test::coarse();
  task.teeth_apart = 1;
  task.radii = task.adjacent_radii = 4;
  task.fit.solver.max_iterations = 3;
  results.set_found(std::make_shared<const GearFits>(GearFits{{Member::Pinion, fit_gear(task), true, 1.0}}));
  return results;
}

/// Lines of a CSV without quotes, cell by cell.
std::vector<std::vector<std::string>> lines_of(const std::string& csv) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    lines.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) lines.back().push_back(cell);
  }
  return lines;
}

}  // namespace

TEST_CASE("A fit is stored whole: results, tables, summary and report", "[studies][fit][results]") {
  static const StudyResults results = fitted_results();  // two seconds, once for all sections
  const GearFits& fits = *results.found<GearFits>();
  const GearFitResult& fit = fits.front().result;
  REQUIRE(fit.fit.fit);

  SECTION("results.json") {
    const std::string text = results_json(results);
    const json stored = json::parse(text);
    CHECK(stored["task"] == "fit");
    REQUIRE(stored["fit"].size() == 1);
    const json& gear = stored["fit"][0];
    CHECK(gear["gear"] == "pinion");
    CHECK(gear["teeth"] == 20);
    CHECK(gear["status"] == "iteration limit");
    CHECK(gear["iterations"] == fit.fit.iterations);
    CHECK(gear["coefficients"] == fit.fit.fit->coefficients().size());
    CHECK(gear["range"]["teeth_apart"] == 1);
    CHECK(gear["eigenvalue_teeth"] == 5);
    CHECK(gear["lowest_eigenvalue"] == fit.lowest_eigenvalue);
    CHECK(gear["finite_elements"]["unknowns"] == fit.finite_elements.unknowns);
    CHECK(gear["finite_elements"]["removed_shaft_motion"] == "transverse translation, torsion and tilt");
    CHECK(gear["uncertainty"]["least_certain"].size() == 5);
    for (const char* form : {"kernels", "thesis_in_master", "thesis_separate"}) {
      for (const char* points : {"fitted", "unseen"}) {
        CAPTURE(form, points);
        REQUIRE(gear["residuals"][form][points].size() == 2);
        const json& own = gear["residuals"][form][points][0];
        CHECK(own["median_percent"] <= own["share_95_percent"]);
        CHECK(own["share_95_percent"] <= own["worst_percent"]);
        CHECK(own["residual_percent"].size() == gear["residuals"]["share_percent"].size());
      }
    }
    CHECK(gear["curves"].size() == fit.curves.size());
    CHECK(gear["curves"][0]["zeta"].size() == gear["curves"][0]["value"].size());
    // What a study may expect of a fit.
    const Study expecting =
        parse_study(study_template("fit") + "\n[expect]\n\"fit.residuals.kernels.unseen.0.median_percent\" = { max = 0 }\n", "fit.toml");
    CHECK_THAT(differences(compare(expecting.expect, Json::parse(text))), Contains("median_percent"));
  }

  SECTION("the table of coefficients is that of the fit, to the last digit") {
    const std::vector<NamedText> tables = fit_tables(fits);
    REQUIRE(tables.size() == 3);
    CHECK(tables[0].name == "fit_pinion.csv");
    const FitTable table = fit.fit.fit->to_table();
    const auto lines = lines_of(tables[0].text);
    REQUIRE(lines.size() == 1 + table.names.size());
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      REQUIRE(lines[i + 1].size() == 2);
      CHECK(lines[i + 1][0] == table.names[i]);
      CHECK(std::stod(lines[i + 1][1]) == table.values[i]);
    }
    for (std::size_t t : {1U, 2U}) {
      const auto rows = lines_of(tables[t].text);
      REQUIRE(rows.size() > 1);
      for (const auto& row : rows) CHECK(row.size() == rows.front().size());
    }
    std::size_t places = 0;
    for (const DeflectionCurve& curve : fit.curves) places += curve.zeta.size();
    CHECK(lines_of(tables[2].text).size() == 1 + places);
  }

  SECTION("summary and report") {
    CHECK_THAT(fit_summary(fits),
               Contains("pinion: iteration limit") && Contains("kernels") && Contains("thesis_separate") && Contains("over 5 teeth"));
    const std::string page = render_report(results_document(results));
    for (const char* part : {"<section id=\"deflections\">", "<section id=\"residuals\">", "function draw_deflections("}) {
      CAPTURE(part);
      CHECK_THAT(page, Contains(part));
    }
  }
}

TEST_CASE("An analysis with the compliance of single gears stores and shows their deflection curves", "[studies][results]") {
  StudyResults results;
  results.study = parse_study(study_template("analyse"), "analyse.toml", {{"fidelity.compliance", "fe"}});
  results.pair = make_gear_pair(results.study.pair);
  const auto compliance = std::make_shared<const flankwright::testing::DistanceCompliance>();
  const StructuralPair structure(results.pair, GearStructure{compliance, 1.0}, GearStructure{compliance, 1.0});
  CHECK(gear_deflections(results.pair, {}, {}, nullptr, "").empty());
  results.deflections = gear_deflections(results.pair, {}, {}, &structure, "finite elements");
  REQUIRE(results.deflections.size() == 2);
  CHECK(results.deflections[1].member == Member::Wheel);
  const json document = results_document(results), stored = document["deflections"];
  REQUIRE(stored.size() == 2);
  CHECK(stored[0]["gear"] == "pinion");
  CHECK(stored[0]["teeth"] == 20);
  // Nine loads: three teeth by the model, one each by plate and slices.
  CHECK(stored[0]["curves"].size() == 9 * (3 + 1 + 1));
  CHECK(stored[0]["curves"][0]["model"] == "finite elements");
  CHECK_THAT(render_report(document), Contains("<section id=\"deflections\">") && !Contains("<section id=\"residuals\">"));
}

TEST_CASE("Gears that could not be solved leave results without a fit", "[studies][fit][results]") {
  StudyResults results;
  results.study = parse_study(study_template("fit"), "fit.toml");
  results.pair = make_gear_pair(results.study.pair);
  const GearFits fits{{Member::Wheel, {}, true, 1.0}};
  results.set_found(std::make_shared<const GearFits>(fits));
  const json gear = json::parse(results_json(results))["fit"][0];
  CHECK(gear["status"] == "not run");
  CHECK(gear["finite_elements"]["solved"] == false);
  CHECK_FALSE(gear.contains("residuals"));
  for (const NamedText& table : fit_tables(fits)) CHECK(table.name != "fit_wheel.csv");
  CHECK_NOTHROW(render_report(results_document(results)));
}

}  // namespace flankwright::studies
