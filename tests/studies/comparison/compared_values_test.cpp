#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/base/error.hpp"
#include "studies/comparison/comparison_page.hpp"
#include "studies/comparison/comparison_tables.hpp"
#include "tests/studies/sample_results.hpp"

namespace flankwright::studies {

using Catch::Contains;

namespace {

/// A load case with two harmonics of very different size.
Json one_case(double mean, double first, double second, const char* design = "given") {
  return {
      {"loaded",
       {{{"scene", "hot"},
         {"torque_Nm", 250.0},
         {"design", design},
         {"summary", {{"te_mean_um", mean}, {"te_harmonics_um", {first, second}}, {"te_mean_um_error", 0.1}, {"worst_condition", 1e6 * mean}}}}}}};
}

const ComparedValue* find(const ComparedRuns& runs, const std::string& section, const std::string& name) {
  const auto found = std::ranges::find_if(runs.values, [&](const ComparedValue& v) { return v.section == section && v.name == name; });
  return found == runs.values.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("Changes are relative to the first run, those of harmonics to the largest harmonic", "[studies][compare]") {
  const ComparedRuns runs = compare_runs({{"a", one_case(10.0, 1.0, 0.01)}, {"b", one_case(12.5, 1.0, 0.02)}});
  const std::string section = "hot, 250 N·m";
  const ComparedValue* mean = find(runs, section, "te_mean_um");
  REQUIRE(mean != nullptr);
  CHECK(mean->difference(1) == (12.5 - 10.0) / 10.0);
  CHECK(mean->unit == "um");
  CHECK_FALSE(mean->headline);  // the table of a run does not show it
  const ComparedValue* first = find(runs, section, "te_harmonics_um.0");
  REQUIRE(first != nullptr);
  CHECK(first->headline);
  CHECK(first->words == "first harmonic of TE");
  const ComparedValue* small = find(runs, section, "te_harmonics_um.1");
  REQUIRE(small != nullptr);
  CHECK(small->difference(1) == 0.02 - 0.01);  // of the first harmonic, 1 um: the second has doubled, and it matters to 1 %
  CHECK_FALSE(small->differs(1, 0.02));
  CHECK(small->differs(1, 0.005));
  CHECK_FALSE(first->differs(1, 0.0));
}

TEST_CASE("Estimated errors, diagnostics and places are no results to compare", "[studies][compare]") {
  const ComparedRuns runs = compare_runs({{"a", one_case(10.0, 1.0, 0.1)}, {"b", one_case(10.0, 1.0, 0.1)}});
  for (const ComparedValue& value : runs.values) {
    CHECK_THAT(value.name, !Contains("_error") && !Contains("condition") && !Contains("phase") && !Contains("seconds"));
  }
}

TEST_CASE("Final designs meet each other whatever they are called; a design before is another load case", "[studies][compare]") {
  const ComparedRuns runs =
      compare_runs({{"a", one_case(10.0, 1.0, 0.1)}, {"b", one_case(9.0, 1.0, 0.1, "after")}, {"c", one_case(8.0, 1.0, 0.1, "before")}});
  const ComparedValue* mean = find(runs, "hot, 250 N·m", "te_mean_um");
  REQUIRE(mean != nullptr);
  CHECK(mean->values[0] == 10.0);
  CHECK(mean->values[1] == 9.0);
  CHECK(std::isnan(mean->values[2]));
  CHECK(mean->differs(2, 0.5));  // only one of them has it
  CHECK(find(runs, "hot, 250 N·m, before", "te_mean_um")->values[2] == 8.0);
}

TEST_CASE("Of several load cases the worst stands in the short table; of many it stands for all", "[studies][compare]") {
  const auto several = [](int cases, double largest) {
    Json results{{"loaded", Json::array()}};
    for (int i = 0; i < cases; ++i) {
      Json loaded = one_case(10.0, i == 1 ? largest : 0.5 * largest, 0.1).at("loaded").front();
      loaded["scene"] = "case " + std::to_string(i);
      results["loaded"].push_back(loaded);
    }
    return results;
  };
  for (const int cases : {2, 5}) {
    const ComparedRuns runs = compare_runs({{"a", several(cases, 1.0)}, {"b", several(cases, 3.0)}});
    const ComparedValue* worst = find(runs, "worst of the load cases", "te_harmonics_um.0");
    REQUIRE(worst != nullptr);
    CHECK(worst->headline);
    CHECK(worst->values == std::vector<double>{1.0, 3.0});
    const ComparedValue* of_one = find(runs, "case 1, 250 N·m", "te_harmonics_um.0");
    REQUIRE(of_one != nullptr);
    CHECK(of_one->headline == (cases == 2));
  }
  CHECK(find(compare_runs({{"a", several(1, 1.0)}, {"b", several(1, 3.0)}}), "worst of the load cases", "te_harmonics_um.0") == nullptr);
}

TEST_CASE("Life is compared for each load of a spectrum, of which two may have one torque, and for their sum", "[studies][compare]") {
  const auto rated = [](double safety, double damage) {
    Json results{{"loaded", Json::array()}, {"life", {{"cases", Json::array()}, {"spectra", Json::array()}}}};
    for (int bin = 0; bin < 2; ++bin) {
      const Json load_case{{"scene", "hot"}, {"torque_Nm", 250.0}, {"design", "given"}, {"bin", bin}};
      results["loaded"].push_back(load_case);
      results["loaded"].back()["summary"] = {{"te_mean_um", 10.0 + bin}};
      results["life"]["cases"].push_back(load_case);
      results["life"]["cases"].back()["wheel"] = {{"S_F", safety - 0.1 * bin}};
    }
    results["life"]["spectra"].push_back({{"scene", "hot"}, {"design", "given"}, {"wheel", {{"root", {{"damage", damage}, {"z_mm", damage}}}}}});
    return results;
  };
  const ComparedRuns runs = compare_runs({{"a", rated(2.0, 0.5)}, {"b", rated(1.0, 0.75)}});
  CHECK(find(runs, "hot, 250 N·m, load 1", "te_mean_um")->values == std::vector{10.0, 10.0});
  CHECK(find(runs, "hot, 250 N·m, load 2", "te_mean_um")->values == std::vector{11.0, 11.0});
  const ComparedValue* safety = find(runs, "life, hot, 250 N·m, load 2", "wheel.S_F");
  REQUIRE(safety != nullptr);
  CHECK(safety->values == std::vector{2.0 - 0.1, 1.0 - 0.1});
  CHECK(safety->headline);
  const ComparedValue* damage = find(runs, "life, spectrum of hot", "wheel.root_damage");
  REQUIRE(damage != nullptr);
  CHECK(damage->difference(1) == 0.5);
  CHECK(damage->differs(1, 0.4));
}

TEST_CASE("Round-off is no difference, the next digit is one", "[studies][compare]") {
  const ComparedRuns same = compare_runs({{"a", one_case(10.0, 1.0, 0.1)}, {"b", one_case(10.0 * (1.0 + 1e-15), 1.0, 0.1)}});
  CHECK(differing_lines({{"a", {}}, {"b", {}}}, same, 0.0).empty());
  const std::vector<ComparedRun> runs{{"a", one_case(10.0, 1.0, 0.1)}, {"b", one_case(10.0 * (1.0 + 1e-9), 1.0, 0.1)}};
  const std::vector<std::string> lines = differing_lines(runs, compare_runs(runs), 0.0);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines.front(), Contains("hot, 250 N·m: te_mean_um"));
}

TEST_CASE("Keys that differ between the studies are listed, others are not", "[studies][compare]") {
  Json a = one_case(10.0, 1.0, 0.1), b = a;
  a["given"] = {{{"key", "load.torque"}, {"value", "250"}}, {{"key", "pinion.teeth"}, {"value", "20"}}};
  b["given"] = {{{"key", "load.torque"}, {"value", "300"}}, {{"key", "pinion.teeth"}, {"value", "20"}}, {{"key", "title"}, {"value", "\"b\""}}};
  const ComparedRuns runs = compare_runs({{"a", a}, {"b", b}});
  REQUIRE(runs.keys.size() == 2);
  CHECK(runs.keys[0].key == "load.torque");
  CHECK(runs.keys[0].values == std::vector<std::string>{"250", "300"});
  CHECK(runs.keys[1].values == std::vector<std::string>{"", "\"b\""});
}

TEST_CASE("A tolerance is a percentage", "[studies][compare]") {
  CHECK(parse_tolerance("1%") == 0.01);
  CHECK(parse_tolerance("0.5 %") == 0.005);
  CHECK(parse_tolerance("0%") == 0.0);
  for (const char* wrong : {"1", "", "%", "-1%", "nan%", "inf%", "1 %%", "one"}) CHECK_THROWS_AS(parse_tolerance(wrong), InvalidInput);
}

TEST_CASE("One run alone is nothing to compare, nor is what is no object", "[studies][compare]") {
  CHECK_THROWS_AS(compare_runs({{"a", one_case(1.0, 1.0, 0.1)}}), InvalidInput);
  CHECK_THROWS_AS(compare_runs({{"a", one_case(1.0, 1.0, 0.1)}, {"b", Json::array()}}), InvalidInput);
}

TEST_CASE("The page of a comparison holds its data as text and loads nothing", "[studies][compare]") {
  Json a = sample::optimise_results(2, 8);
  a["title"] = "</script><script>alert(1)</script>";
  const std::vector<ComparedRun> runs{{"a <b>", a}, {"b", sample::loaded_results(2)}};
  const ComparedRuns compared = compare_runs(runs);
  const std::string page = comparison_page(runs, compared);
  CHECK_THAT(page, Contains("Comparison of a &lt;b&gt; and b") && Contains("compare_main();") && !Contains("alert(1)</script>"));
  CHECK(page.find("{{") == std::string::npos);
  CHECK(page.find("src=\"http") == std::string::npos);
  const std::string csv = comparison_csv(runs, compared);
  CHECK(std::ranges::count(csv, '\n') == std::ssize(compared.values) + 1);
}

}  // namespace flankwright::studies
