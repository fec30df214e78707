#include <catch2/catch.hpp>
#include <cmath>

#include "core/fidelity/cycle_quantities.hpp"
#include "optimize/design/outputs/design_output.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/report/report.hpp"
#include "studies/results/expectations.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/tasks/sweep/sample_analysis.hpp"
#include "tests/studies/study_texts.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"

/// An output is one row of cycle_quantities(): every row of that table appears in all outputs.
namespace flankwright::studies {
namespace {

StudyResults analysed() {
  return run_study(study_texts::read(R"([load]
torque = 300
[misalignment]
mesh_misalignment = 4
[analyse]
gradients = ["misalignment.mesh_misalignment", "load.torque"]
[cycle]
positions = 24
[fidelity]
compliance = "thin_slice"
quadrature = { rule = "graded", intervals = 4 }
)"));
}

TEST_CASE("Every quantity has its value, error and derivatives in the results, by its own key", "[studies][results][quantities]") {
  const StudyResults results = analysed();
  const Json document = results_document(results);
  const Json &loaded = document.at("loaded").at(0), &summary = loaded.at("summary"), &slopes = loaded.at("gradients").at("summary");
  for (const CycleQuantity& quantity : cycle_quantities()) {
    const std::string key(quantity.key);
    INFO(key);
    REQUIRE(summary.contains(key));
    REQUIRE(slopes.contains(key));
    CHECK(summary.contains(key + "_error") == (quantity.errors != nullptr));
    CHECK(summary.at(key).is_array() == quantity.is_list);
    if (quantity.is_list) CHECK(slopes.at(key).size() == summary.at(key).size());
    // Every number is what the row reads, in the row's unit.
    const std::vector<double> values = quantity.values(results.loaded.front().summary);
    if (!quantity.is_list && !std::isnan(values.front())) CHECK(summary.at(key).get<double>() == values.front() / quantity.unit_size);
  }
}

TEST_CASE("Every quantity can be expected, is drawn in the report and has a name", "[studies][results][quantities]") {
  const StudyResults results = analysed();
  const Json document = results_document(results);
  const std::string report = render_report(document);
  for (const CycleQuantity& quantity : cycle_quantities()) {
    const std::string key(quantity.key);
    INFO(key);
    CHECK(report.find("\"key\":\"" + key + "\"") != std::string::npos);
    if (std::isnan(quantity.values(results.loaded.front().summary).front())) continue;  // root stress, without finite elements
    Expectation expectation;
    expectation.key = "loaded.summary." + key + (quantity.is_list ? ".0" : "");
    expectation.minimum = 0.0;
    CHECK(compare({expectation}, document).front().met);
  }
  for (const CycleEntry& entry : cycle_entries()) {
    CHECK(plain_name(entry.name()) == entry.words());
    CHECK(plain_name(entry.key()) == entry.words());
    CHECK(find_cycle_entry(entry.name()).key() == entry.key());
  }
  CHECK(find_cycle_entry("te_harmonic_11").quantity == nullptr);
}

TEST_CASE("A sweep has every entry that its nominal sample has a number for, and the table of a run every heading",
          "[studies][results][quantities]") {
  const StudyResults nominal = run_study(parse_study(small::sweep("samples = 24"), "sweep.toml"));
  const SampleAnalysis analysis(nominal);
  const auto has = [&](const std::string& name) {
    return std::ranges::any_of(analysis.outputs(), [&](const SweepOutput& output) { return output.name == name; });
  };
  const std::string table = summary_table(analysed());
  for (const CycleEntry& entry : cycle_entries()) {
    INFO(entry.key());
    const bool is_known = !std::isnan(entry.value(nominal.loaded.front().summary));
    CHECK(has(entry.key()) == is_known);
    if (is_known && entry.order <= 1) CHECK(table.find(entry.quantity->heading) != std::string::npos);
  }
}

TEST_CASE("Every output that can be minimised is a word of the study file, and where it is a quantity has its name and unit",
          "[studies][results][quantities]") {
  for (const std::string& name : term_names()) {
    INFO(name);
    const auto found = find_term(name);
    REQUIRE(found);
    CHECK(found->own_name() == name);
    CHECK(plain_name(name) != name);
    const CycleEntry entry = find_cycle_entry(name);
    if (entry.quantity == nullptr) continue;  // of the positions alone
    CHECK((std::string(found->unit()) == "1" ? "" : found->unit()) == std::string(entry.quantity->unit));
    CHECK(found->outside_factor() == Approx(1.0 / entry.quantity->unit_size).epsilon(1e-14));  // round-off
  }
  for (const DesignOutput& row : design_outputs()) {
    INFO(row.name);
    CHECK((row.at_points == nullptr) == (row.point_derivative == nullptr));
    CHECK_FALSE((row.at_points != nullptr && row.smooth != nullptr));
  }
}

}  // namespace
}  // namespace flankwright::studies
