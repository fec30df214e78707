#include "studies/report/report.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "studies/report/report_view.hpp"
#include "tests/studies/sample_results.hpp"

namespace flankwright::studies {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

/// Ids of the page's sections in their order, without the summary that every page has.
std::vector<std::string> section_ids(const std::string& page) {
  static const std::regex section("<section id=\"([a-z-]+)\"><h2>");
  std::vector<std::string> ids;
  for (std::sregex_iterator at(page.begin(), page.end(), section), end; at != end; ++at) ids.push_back((*at)[1]);
  return ids;
}

/// The data block of the page, read back as a browser would: up to the first closing tag.
Json embedded(const std::string& page) {
  const std::string opening = "<script type=\"application/json\" id=\"results\">";
  const std::size_t from = page.find(opening) + opening.size();
  return Json::parse(page.substr(from, page.find("</script", from) - from));
}

Json stripped_of_numbers(Json value) {
  if (value.is_number()) return nullptr;
  if (value.is_structured()) {
    for (Json& child : value) child = stripped_of_numbers(child);
  }
  return value;
}

}  // namespace

TEST_CASE("The report of an unloaded analysis has the sections of unloaded contact", "[studies][report]") {
  const std::vector<std::string> expected{"unloaded", "gear-pair", "effects", "notes", "inputs"};
  CHECK(section_ids(render_report(sample::unloaded_results())) == expected);
}

TEST_CASE("The page of an unloaded analysis has its pictures' data in every scene and the scripts that draw them", "[studies][report]") {
  const Json results = sample::unloaded_results();
  const std::string page = render_report(results);
  for (const char* script :
       {"function draw_contact_paths(", "function draw_unloaded_te(", "function draw_pattern(", "function draw_words(", "function scene_table("}) {
    CAPTURE(script);
    CHECK(count(page, script) == 1);
  }
  const Json data = embedded(page);
  REQUIRE(data["unloaded_scenes"].size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const Json &shown = data["unloaded_scenes"][i], &stored = results["unloaded_scenes"][i];
    CHECK(shown["sequence"] == stored["sequence"]);
    CHECK(shown["parabolic_te"]["why"] == stored["parabolic_te"]["why"]);
    CHECK(shown["bearing_pattern"]["pinion"]["separation_um"].size() == stored["bearing_pattern"]["pinion"]["radius_mm"].size());
    CHECK(shown["bearing_pattern"]["pinion"]["separation_um"][0].back().is_null());
    CHECK(shown["pairs"][1]["positions"].size() == stored["pairs"][1]["positions"].size());
  }
}

TEST_CASE("The report of a loaded analysis shows pictures before tables", "[studies][report]") {
  const std::vector<std::string> expected{
      "flank-load", "transmission-error", "stiffness", "modifications", "load-cases", "gear-pair", "effects", "notes", "inputs"};
  CHECK(section_ids(render_report(sample::loaded_results(2))) == expected);
}

TEST_CASE("The report of an optimisation begins with the modifications to grind and their gain", "[studies][report]") {
  const std::vector<std::string> expected{"modifications", "scenes",      "flank-load", "transmission-error",
                                          "stiffness",     "convergence", "load-cases", "unloaded",
                                          "gear-pair",     "effects",     "notes",      "inputs"};
  const std::string page = render_report(sample::optimise_results(2, 4));
  CHECK(section_ids(page) == expected);
  for (const std::string& id : expected) {
    CAPTURE(id);
    CHECK(count(page, "href=\"#" + id + "\"") == 1);
    // The script has a builder for it, under a quoted or a plain key.
    CHECK((page.find("\"" + id + "\": build_") != std::string::npos || page.find(" " + id + ": build_") != std::string::npos));
  }
}

TEST_CASE("The page is given the names that a person writes", "[studies][report]") {
  const Json names = report_view(sample::optimise_results(1, 2)).at("names");
  const auto place_of = [&](const char* key) {
    return std::ranges::find_if(names, [&](const Json& row) { return row.at(0) == key; }) - names.begin();
  };
  const auto crowning = place_of("pinion.modification.lead_crowning"), relief = place_of("pinion.modification.tip_relief.amount");
  const auto wheel = place_of("wheel.modification.end_relief.amount");
  REQUIRE(wheel < static_cast<std::ptrdiff_t>(names.size()));
  CHECK((crowning < relief && relief < wheel));  // as tables list them
  CHECK(names.at(static_cast<std::size_t>(relief)).at(1) == "pinion tip relief");
  CHECK(names.at(static_cast<std::size_t>(place_of("pinion.modification.lead_slope"))) ==
        Json({"pinion.modification.lead_slope", "pinion lead slope", "C_Hβ", "+ removes at z = +b/2"}));
}

TEST_CASE("The first screen comes before the links to the sections", "[studies][report]") {
  const std::string page = render_report(sample::optimise_results(1, 2));
  const std::size_t headline = page.find("id=\"headline\""), first = page.find("id=\"first\""), links = page.find("<nav"),
                    sections = page.find("<section id=\"modifications\">");
  CHECK((headline < first && first < links && links < sections && sections != std::string::npos));
}

TEST_CASE("Errors beside the figures reach the page", "[studies][report]") {
  Json results = sample::optimise_results(1, 2);
  results["loaded"][0]["summary"]["te_harmonics_um_error"] = {0.0123456789, nullptr};
  results["optimise"]["after"]["objective_error"] = 1.5;
  const Json data = embedded(render_report(results));
  CHECK(data["loaded"][0]["summary"]["te_harmonics_um_error"] == Json({0.0123457, nullptr}));
  CHECK(data["optimise"]["after"]["objective_error"] == 1.5);
}

TEST_CASE("The report opens without a network", "[studies][report]") {
  const std::string page = render_report(sample::optimise_results(1, 2));
  const std::regex external(R"((src|href|action|srcset)\s*=\s*["']?\s*(https?:)?//)", std::regex::icase);
  // The regular expression sees only what precedes the plot library, a minified line too long for it, and what follows.
  const std::size_t library = page.find("/*!\n * Chart.js"), end = page.find("</script", library);
  REQUIRE(library != std::string::npos);
  CHECK_FALSE(std::regex_search(page.substr(0, library), external));
  CHECK_FALSE(std::regex_search(page.substr(end), external));
  for (const char* loader : {"<link", "@import", "url(", "<iframe", "<img", "fetch(", "XMLHttpRequest", "import("}) {
    CAPTURE(loader);
    CHECK(page.find(loader) == std::string::npos);
  }
  CHECK(page.find("default-src 'none'") != std::string::npos);
  CHECK(page.find("{{") == std::string::npos);
}

TEST_CASE("The report keeps the licence notice of its plot library", "[studies][report]") {
  const std::string page = render_report(Json::object());
  CHECK(page.find("Released under the MIT License") != std::string::npos);
  CHECK(page.find("The above copyright notice and this permission notice shall be included") != std::string::npos);
}

TEST_CASE("A hostile study cannot bring script into its report", "[studies][report]") {
  const std::string attack = "</title></script><script>alert(1)</script><!-- {{results}} \" ' & \u2028 \u2029";
  Json results = sample::optimise_results(1, 2);
  const std::size_t honest = count(render_report(results), "<script");
  results["title"] = results["file"] = results["task"] = attack;
  results["notes"] = {attack};
  results["given"] = {{{"key", attack}, {"value", attack}}};
  results["loaded"][0]["scene"] = results["optimise"]["message"] = attack;
  results[attack] = attack;
  const std::string page = render_report(results);

  CHECK(count(page, "<script") == honest);
  CHECK(count(page, "</script") == honest);
  CHECK(page.find("<script>alert") == std::string::npos);
  CHECK(page.find("&lt;script&gt;alert(1)&lt;/script&gt;") != std::string::npos);
  CHECK(page.find("<h1>&lt;/title&gt;") != std::string::npos);

  const Json data = embedded(page);
  CHECK(data["title"] == attack);
  CHECK(data["loaded"][0]["scene"] == attack);
  const std::string inlined = page.substr(page.find("id=\"results\">"), 200);
  CHECK(inlined.find("\u2028") == std::string::npos);
}

TEST_CASE("A report survives numbers that did not run", "[studies][report]") {
  for (const Json& results : {sample::unloaded_results(), sample::loaded_results(1), sample::optimise_results(2, 2)}) {
    const std::string whole = render_report(results);
    const std::string nulls = render_report(stripped_of_numbers(results));
    CHECK(section_ids(nulls) == section_ids(whole));
  }
}

TEST_CASE("A report survives sections that are missing, empty or of another shape", "[studies][report]") {
  const Json full = sample::optimise_results(1, 2);
  for (const auto& item : full.items()) {
    CAPTURE(item.key());
    Json less = full;
    less.erase(item.key());
    CHECK_NOTHROW(render_report(less));
    for (const Json& odd : {Json(), Json::array(), Json::object(), Json(3.5), Json("text"), Json({1, "a", nullptr}), Json({{"cycle", 1}})}) {
      less[item.key()] = odd;
      CHECK_NOTHROW(render_report(less));
    }
  }
  CHECK(section_ids(render_report(Json::object())).empty());
}

TEST_CASE("The page gets every contact point to six digits", "[studies][report]") {
  const Json results = sample::loaded_results(1);
  const Json view = report_view(results);
  constexpr double round_off = 5.1e-6;  // half a unit of the sixth significant digit, relative
  std::size_t seen = 0;
  const Json& cycle = results["loaded"][0]["cycle"];
  for (std::size_t p = 0; p < cycle.size(); ++p) {
    for (std::size_t t = 0; t < cycle[p]["teeth"].size(); ++t) {
      const Json& points = cycle[p]["teeth"][t]["points"];
      const Json& columns = view["loaded"][0]["cycle"][p]["teeth"][t]["points"];
      for (const char* key : {"z_mm", "pinion_radius_mm", "load_N_per_mm", "contact_stress_MPa"}) {
        REQUIRE(columns[key].size() == points.size());
        for (std::size_t i = 0; i < points.size(); ++i, ++seen) {
          CHECK(columns[key][i].get<double>() == Approx(points[i][key].get<double>()).epsilon(round_off).margin(0));
        }
      }
    }
  }
  CHECK(seen > 1000);
  CHECK(view["given"] == results["given"]);
  CHECK(view["used"] == results["used"]);
}

TEST_CASE("The page has derivatives where some were asked for, those of the summary alone", "[studies][report][gradient]") {
  Json results = sample::loaded_results(1);
  const auto sections_of = [&] { return section_ids(render_report(results)); };
  const auto has_gradients = [](const auto& ids) { return std::ranges::find(ids, "gradients") != ids.end(); };
  CHECK_FALSE(has_gradients(sections_of()));
  results["loaded"][0]["gradients"] = {
      {"parameters", {"load.torque"}}, {"units", {"N·m"}}, {"summary", {{"te_mean_um", {0.125}}}}, {"cycle", {1, 2, 3}}, {"shafts", {4}}};
  CHECK(has_gradients(sections_of()));
  const Json seen = report_view(results)["loaded"][0]["gradients"];
  CHECK(seen["summary"]["te_mean_um"] == Json::array({0.125}));
  CHECK_FALSE(seen.contains("cycle"));
  CHECK_FALSE(seen.contains("shafts"));
}

TEST_CASE("The page has the life of a study that asks for it, and the wheel's radii to draw it on", "[studies][report][life]") {
  Json results = sample::loaded_results(1);
  const auto sections_of = [&] { return section_ids(render_report(results)); };
  const auto first_tooth = [](const Json& of) -> const Json& { return of.at("loaded")[0].at("cycle")[0].at("teeth")[0]; };
  const auto without = sections_of();
  CHECK(std::ranges::find(without, "life") == without.end());
  CHECK_FALSE(first_tooth(report_view(results)).at("points").contains("wheel_radius_mm"));
  for (Json& point : results["loaded"][0]["cycle"][0]["teeth"][0]["points"]) point["wheel_radius_mm"] = 300.0;
  results["life"] = {{"cases", {{{"scene", "nominal"}, {"design", "given"}, {"torque_Nm", 320.0}}}}, {"spectra", Json::array()}};
  const auto ids = sections_of();
  const auto life = std::ranges::find(ids, "life");
  REQUIRE(life != ids.end());
  CHECK(*std::prev(life) == "flank-load");
  CHECK(*std::next(life) == "transmission-error");
  const Json view = report_view(results);
  CHECK(first_tooth(view).at("points").at("wheel_radius_mm") == Json(Json::array_t(first_tooth(results).at("points").size(), 300.0)));
  results["life"]["cases"] = Json::array();
  CHECK(sections_of() == without);
}

TEST_CASE("The page sees a small transmission error on top of a large backlash", "[studies][report]") {
  Json results = sample::unloaded_results();
  results["unloaded"]["mesh"]["te_arcsec"] = {-1167.23456, -1167.23321};
  const Json shown = report_view(results)["unloaded"]["mesh"]["te_arcsec"];
  CHECK(shown[1].get<double>() - shown[0].get<double>() == Approx(0.00135).epsilon(1e-3));  // of ten digits, 1e-6 arcsec
}

TEST_CASE("The report of nine scenes at 32 positions stays below three megabytes", "[studies][report]") {
  const std::string page = render_report(sample::optimise_results(9, 32));
  CHECK(page.size() < 3'000'000);
  CHECK(embedded(page)["loaded"].size() == 18);
}

}  // namespace flankwright::studies
