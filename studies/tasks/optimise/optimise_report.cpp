#include "studies/tasks/optimise/optimise_report.hpp"

namespace flankwright::studies {

namespace {

bool optimised(const Json& results) { return has(results, "optimise"); }

bool says_what_to_draw(const Json& r) {
  return optimised(r) && (has(r, "drawing") || has(r, "optimise", "grinding_limits") || has(r, "optimise", "grinding_choices"));
}

/// Other designs count where there is something to compare with.
bool compared(const Json& r) {
  return has(r, "optimise", "comparison") && (has(r.at("optimise"), "comparison", "rules") || has(r.at("optimise"), "comparison", "variants"));
}

/// True where an optimisation has several starts, a rounded optimum or a front.
bool searched(const Json& r) { return has(r, "optimise", "starts") || has(r, "optimise", "rounded") || has(r, "optimise", "pareto"); }

}  // namespace

std::vector<ReportSection> optimise_sections() {
  return {
      {Chapter::Answer, "modifications", "Flank modifications", optimised},
      {Chapter::Answer, "drawing", "What to write on the drawing", says_what_to_draw},
      {Chapter::Answer, "scenes", "Scenes", optimised},
      {Chapter::Answer, "tolerances", "Scatter in the search", [](const Json& r) { return has(r, "optimise", "scatter"); }},
      {Chapter::Assurance, "validation", "Draws not seen by the search", [](const Json& r) { return has(r, "optimise", "validation"); }},
      {Chapter::Assurance, "comparison", "Optimum and other designs", compared},
      {Chapter::Assurance, "governing", "What governs the optimum", [](const Json& r) { return has(r, "optimise", "governing"); }},
      {Chapter::Assurance, "sensitivity", "Sensitivity of the optimum", [](const Json& r) { return has(r, "optimise", "sensitivity"); }},
      {Chapter::Search, "search", "Search, rounding and compromises", searched},
      {Chapter::Search, "convergence", "Convergence", [](const Json& r) { return has(r, "optimise", "history"); }},
  };
}

}  // namespace flankwright::studies
