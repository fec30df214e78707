#include "studies/results/expectations.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace flankwright::studies {
namespace {

const Json expected_results = Json::parse(R"({
  "a": {"b": 2.0, "nothing": null, "text": "two", "truth": true, "list": [1, 2, 3]},
  "loaded": [{"summary": {"te": 1.0}}, {"summary": {"te": 2.0}}, {"summary": {}}],
  "empty": []})");

Expectation value(const std::string& key, double wanted, double relative = not_given, double absolute = not_given) {
  Expectation e;
  e.key = key;
  e.value = wanted;
  e.within_relative = relative;
  e.within_absolute = absolute;
  return e;
}

Expectation range(const std::string& key, double minimum, double maximum) {
  Expectation e;
  e.key = key;
  e.minimum = minimum;
  e.maximum = maximum;
  return e;
}

bool met(const Expectation& e) {
  const std::vector<Comparison> comparisons = compare({e}, expected_results);
  REQUIRE(comparisons.size() == 1);
  return comparisons.front().met;
}

}  // namespace

TEST_CASE("A value is met within its tolerance, ends included", "[studies][expect]") {
  CHECK(met(value("a.b", 2.0)));
  CHECK_FALSE(met(value("a.b", 2.0000001)));
  CHECK(met(value("a.b", 1.6, 0.25)));        // 0.4 of 1.6
  CHECK_FALSE(met(value("a.b", 2.5, 0.19)));  // 0.475 of 0.5
  CHECK(met(value("a.b", 2.5, not_given, 0.5)));
  CHECK_FALSE(met(value("a.b", 2.5, not_given, 0.4)));
  CHECK(met(value("a.b", -2.0, not_given, 4.0)));
}

TEST_CASE("A key that leads nowhere gets the name of one that does", "[studies][expect]") {
  const Json results = Json::parse(R"({
    "loaded": [{"summary": {"te_harmonics_um": [0.5, 0.2, 0.1], "te_mean_um": 1}}],
    "sweep": {"statistics": {"te_harmonic_1_um": {"mean": 0.5}}}})");
  const auto hint = [&](const std::string& key) { return compare({range(key, 0.0, 1.0)}, results).front().hint; };
  CHECK(hint("loaded.summary.te_harmonic_2_um") == "loaded.summary.te_harmonics_um.1");
  CHECK(hint("loaded.summary.te_harmonic_9_um") == "loaded.summary.te_harmonics_um");  // there are three: spelt almost alike
  CHECK(hint("loaded.sumary.te_mean_um") == "loaded.summary.te_mean_um");
  CHECK(hint("statistics.te_harmonic_1_um") == "sweep.statistics.te_harmonic_1_um");
  CHECK(hint("loaded.te_mean_um") == "loaded.summary.te_mean_um");
  CHECK(hint("loaded.summary.te_mean_um").empty());
  CHECK(hint("loaded.summary.quite_another").empty());
  CHECK(hint("unloaded.mesh.peak_to_peak_arcsec").empty());  // "loaded", which is spelt almost alike, has no mesh
  CHECK_THAT(differences(compare({range("loaded.summary.te_harmonic_2_um", 0.0, 1.0)}, results)),
             Catch::Contains("found nothing; did you mean loaded.summary.te_harmonics_um.1?"));
}

TEST_CASE("A range is met on its ends", "[studies][expect]") {
  CHECK(met(range("a.b", 2.0, 2.0)));
  CHECK(met(range("a.b", -INFINITY, 3.0)));
  CHECK_FALSE(met(range("a.b", -INFINITY, 1.9)));
  CHECK_FALSE(met(range("a.b", 2.1, INFINITY)));
}

TEST_CASE("Without an index every entry of a list must meet it, with one that entry", "[studies][expect]") {
  const std::vector<Comparison> all = compare({range("loaded.summary.te", 0.0, 1.5)}, expected_results);
  REQUIRE(all.size() == 3);
  CHECK(all[0].key == "loaded[0].summary.te");
  CHECK(all[0].met);
  CHECK_FALSE(all[1].met);
  CHECK(all[1].found == 2.0);
  CHECK_FALSE(all[2].met);  // the key is missing there
  CHECK(met(value("loaded.1.summary.te", 2.0)));
  CHECK(met(value("a.list.2", 3.0)));
  const std::vector<Comparison> entries = compare({range("a.list", 0.0, 2.5)}, expected_results);  // of a list of numbers likewise
  REQUIRE(entries.size() == 3);
  CHECK(entries[1].key == "a.list[1]");
  CHECK(entries[1].met);
  CHECK_FALSE(entries[2].met);
}

TEST_CASE("A value that is missing, null or no number does not meet an expectation", "[studies][expect]") {
  const std::string key =
      GENERATE("a.c", "nowhere", "a.nothing", "a.text", "a", "loaded.7.summary.te", "empty.x", "a.b.c", "a.list.99999999999999999999", "");
  CAPTURE(key);
  const std::vector<Comparison> comparisons = compare({range(key, -INFINITY, INFINITY)}, expected_results);
  CHECK_FALSE(comparisons.empty());
  for (const Comparison& c : comparisons) CHECK_FALSE(c.met);
}

TEST_CASE("A text or a truth value is met by itself only", "[studies][expect]") {
  const auto word = [](const std::string& key, const std::string& is) {
    Expectation e;
    e.key = key;
    e.is = is;
    return e;
  };
  CHECK(met(word("a.text", "two")));
  CHECK_FALSE(met(word("a.text", "tw")));
  CHECK(met(word("a.truth", "true")));
  CHECK_FALSE(met(word("a.truth", "false")));
  CHECK_FALSE(met(word("a.b", "2")));  // a number is no text
  CHECK_FALSE(met(word("a.nothing", "null")));
  CHECK(differences(compare({word("a.text", "three")}, expected_results)) == "  a.text: expected three, found two\n");
}

TEST_CASE("The table of differences names key, wanted and found, and only what differs", "[studies][expect]") {
  const std::string table = differences(compare({value("a.b", 2.0), value("a.b", 3.0, 0.02), range("a.c", 1.0, 2.0)}, expected_results));
  CHECK(table == "  a.b: expected 3 within 2 %, found 2\n  a.c: expected at least 1, at most 2, found nothing\n");
  CHECK(differences({}).empty());
}

}  // namespace flankwright::studies
