#include "studies/comparison/comparison_page.hpp"

#include <cmath>

#include "studies/report/page_template.hpp"
#include "studies/report/report_assets.hpp"
#include "studies/report/report_view.hpp"

namespace flankwright::studies {

namespace {

/// What the page draws of a run: final designs alone, in the compact form of the report.
Json drawn_run(const ComparedRun& run) {
  Json kept{{"title", run.results.value("title", "")}, {"task", run.results.value("task", "")}, {"version", run.results.value("version", "")}};
  for (const char* list : {"loaded", "modifications"}) {
    kept[list] = Json::array();
    const auto found = run.results.find(list);
    if (found == run.results.end() || !found->is_array()) continue;
    for (const Json& entry : *found) {
      if (!entry.is_object() || entry.value("design", "") == "before") continue;
      kept[list].push_back(entry);
      for (const char* large : {"gradients", "shafts", "rims", "extremes"}) kept[list].back().erase(large);
      if (std::string_view(list) == "loaded") kept[list].back()["name"] = load_case_name(entry);
    }
  }
  kept["name"] = run.name;
  Json view = report_view(kept);
  view.erase("names");
  view.erase("quantities");
  return view;
}

Json or_null(double value) { return std::isnan(value) ? Json() : Json(value); }

}  // namespace

std::string comparison_page(const std::vector<ComparedRun>& runs, const ComparedRuns& compared) {
  const Json names = report_view(Json::object());  // the words of keys and quantities
  Json data{{"names", names.at("names")}, {"quantities", names.at("quantities")}};
  data["runs"] = list(runs, drawn_run);
  data["keys"] = list(compared.keys, [](const ComparedKey& key) -> Json { return {{"key", key.key}, {"values", key.values}}; });
  data["values"] = list(compared.values, [&](const ComparedValue& value) -> Json {
    Json changes = Json::array();
    for (std::size_t run = 1; run < runs.size(); ++run) {
      const bool neither = std::isnan(value.values.front()) && std::isnan(value.values[run]);
      changes.push_back(neither ? Json("") : or_null(value.differs(run, 0.0) ? percent * value.difference(run) : 0.0));
    }
    return {{"section", value.section},     {"name", value.name},
            {"words", value.words},         {"unit", value.unit == "-" ? "" : value.unit},
            {"headline", value.headline},   {"values", list(value.values, or_null)},
            {"changes", std::move(changes)}};
  });
  std::string title = "Comparison of";
  for (std::size_t run = 0; run < runs.size(); ++run) title += (run == 0 ? " " : run + 1 == runs.size() ? " and " : ", ") + runs[run].name;
  const std::vector<PageSection> sections{{"headlines", "Headline quantities"},        {"topographies", "Flank modifications"},
                                          {"curves", "Transmission error under load"}, {"stresses", "Contact stress on the flank"},
                                          {"keys", "What differs in the studies"},     {"all", "All quantities"}};
  return render_page(title, sections, data, std::string(assets::page_script) + std::string(assets::comparison_script));
}

}  // namespace flankwright::studies
