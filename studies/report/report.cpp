#include "studies/report/report.hpp"

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/report/page_template.hpp"
#include "studies/report/report_assets.hpp"
#include "studies/report/report_view.hpp"

namespace flankwright::studies {
namespace {

bool has(const Json& results, const char* key) {
  const auto found = results.find(key);
  return found != results.end() && found->is_structured() && !found->empty();
}

bool has_loaded(const Json& results) { return has(results, "loaded") && results.at("loaded").is_array(); }

bool has_gradients(const Json& results) {
  return has_loaded(results) &&
         std::ranges::any_of(results.at("loaded"), [](const Json& entry) { return entry.is_object() && has(entry, "gradients"); });
}

bool has_sweep(const Json& results) { return has(results, "sweep") && results.at("sweep").is_object(); }

/// A part of the assessment of an optimum; a comparison counts where there is something to compare with.
bool has_assessment(const Json& results, const char* part) {
  if (!has(results, "optimise") || !results.at("optimise").is_object() || !has(results.at("optimise"), part)) return false;
  const Json& found = results.at("optimise").at(part);
  return !found.contains("rules") || has(found, "rules") || has(found, "variants");
}

/// A section of the page: the script fills the element `id`; it exists only where `present` holds.
struct Section {
  const char* id;
  const char* title;
  bool (*present)(const Json& results);
};

/// True where an optimisation has several starts, a rounded optimum or a front.
bool searched(const Json& r) {
  if (!has(r, "optimise") || !r.at("optimise").is_object()) return false;
  const Json& optimise = r.at("optimise");
  return has(optimise, "starts") || has(optimise, "rounded") || has(optimise, "pareto");
}

bool optimised(const Json& r) { return has(r, "optimise"); }

bool says_what_to_draw(const Json& r) {
  if (has(r, "drawing")) return true;
  if (!optimised(r) || !r.at("optimise").is_object()) return false;
  const Json& optimise = r.at("optimise");
  return has(optimise, "grinding_limits") || has(optimise, "grinding_choices");
}

/// In the order of interest for a gear engineer: the modifications to grind and their gain, the contact, the assurance, the search,
/// and all numbers. The flanks of an analysis are given, so they follow its contact.
constexpr Section sections[] = {
    {"accuracy", "Cost of accuracy", [](const Json& r) { return has(r, "accuracy") || has(r, "accuracy_choice"); }},
    {"scatter", "Scatter over the samples", has_sweep},
    {"indices", "Causes of the scatter", [](const Json& r) { return has_sweep(r) && r.at("sweep").value("index_blocks", 0) > 1; }},
    {"response-maps", "Response maps", [](const Json& r) { return has_sweep(r) && has(r.at("sweep"), "response_maps"); }},
    {"modifications", "Flank modifications", optimised},
    {"drawing", "What to write on the drawing", says_what_to_draw},
    {"scenes", "Scenes", optimised},
    {"tolerances", "Scatter in the search",
     [](const Json& r) { return optimised(r) && r.at("optimise").is_object() && has(r.at("optimise"), "scatter"); }},
    {"flank-load", "Load on the flank", has_loaded},
    {"life", "Load spectrum and life",
     [](const Json& r) { return has_loaded(r) && has(r, "life") && r.at("life").is_object() && has(r.at("life"), "cases"); }},
    {"transmission-error", "Transmission error under load", has_loaded},
    {"stiffness", "Load sharing and mesh stiffness", has_loaded},
    {"modifications", "Flank modifications", [](const Json& r) { return has(r, "modifications") && !optimised(r); }},
    {"validation", "Draws not seen by the search", [](const Json& r) { return has_assessment(r, "validation"); }},
    {"comparison", "Optimum and other designs", [](const Json& r) { return has_assessment(r, "comparison"); }},
    {"governing", "What governs the optimum", [](const Json& r) { return has_assessment(r, "governing"); }},
    {"sensitivity", "Sensitivity of the optimum", [](const Json& r) { return has_assessment(r, "sensitivity"); }},
    {"search", "Search, rounding and compromises", searched},
    {"convergence", "Convergence",
     [](const Json& r) { return has(r, "optimise") && r.at("optimise").is_object() && has(r.at("optimise"), "history"); }},
    {"gradients", "Derivatives of the results", has_gradients},
    {"load-cases", "Load cases in numbers", has_loaded},
    {"unloaded", "Unloaded contact", [](const Json& r) { return has(r, "unloaded"); }},
    {"deflections", "Deflection of a tooth under load", [](const Json& r) { return has(r, "fit") || has(r, "deflections"); }},
    {"residuals", "Fits beside finite elements", [](const Json& r) { return has(r, "fit"); }},
    {"gear-pair", "Gear pair", [](const Json& r) { return has(r, "geometry"); }},
    {"effects", "Effects and time", [](const Json& r) { return has(r, "effects"); }},
    {"notes", "Notes", [](const Json& r) { return has(r, "notes"); }},
    {"inputs", "Given and used", [](const Json& r) { return has(r, "given") || has(r, "used"); }},
};

std::string text_or(const Json& results, const char* key, const char* fallback) {
  const auto found = results.find(key);
  return found != results.end() && found->is_string() ? found->get<std::string>() : fallback;
}

Json parse(const std::string& text) {
  Json results = Json::parse(text, nullptr, false);
  if (results.is_discarded()) throw InvalidInput("results.json", damaged_results, results_of_a_run);
  return results;
}

}  // namespace

std::string render_stored_report(const std::string& results_json) { return render_report(parse(results_json)); }

std::string render_report(const Json& results) {
  if (!results.is_object()) throw InvalidInput("results.json", results.type_name(), "a JSON object");

  std::vector<PageSection> present;
  for (const Section& section : sections) {
    if (section.present(results)) present.push_back({section.id, section.title});
  }
  return render_page(text_or(results, "title", "Untitled study"), present, report_view(results),
                     std::string(assets::page_script) + std::string(assets::page_main));
}

}  // namespace flankwright::studies
