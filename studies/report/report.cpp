#include "studies/report/report.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "studies/report/page_template.hpp"
#include "studies/report/report_assets.hpp"
#include "studies/report/report_view.hpp"
#include "studies/results/report_section.hpp"
#include "studies/study/task.hpp"

namespace flankwright::studies {
namespace {

bool has_loaded(const Json& results) { return has(results, "loaded") && results.at("loaded").is_array(); }

bool has_gradients(const Json& results) {
  return has_loaded(results) && std::ranges::any_of(results.at("loaded"), [](const Json& entry) { return has(entry, "gradients"); });
}

/// Sections that no task owns. The flanks of an analysis are given, so they follow its contact.
constexpr ReportSection shared_sections[] = {
    {Chapter::Answer, "drawing", "What to write on the drawing", [](const Json& r) { return has(r, "drawing") && !has(r, "optimise"); }},
    {Chapter::Contact, "flank-load", "Load on the flank", has_loaded},
    {Chapter::Contact, "life", "Load spectrum and life", [](const Json& r) { return has_loaded(r) && has(r, "life", "cases"); }},
    {Chapter::Contact, "transmission-error", "Transmission error under load", has_loaded},
    {Chapter::Contact, "stiffness", "Load sharing and mesh stiffness", has_loaded},
    {Chapter::Contact, "modifications", "Flank modifications", [](const Json& r) { return has(r, "modifications") && !has(r, "optimise"); }},
    {Chapter::Numbers, "gradients", "Derivatives of the results", has_gradients},
    {Chapter::Numbers, "load-cases", "Load cases in numbers", has_loaded},
    {Chapter::Numbers, "unloaded", "Unloaded contact", [](const Json& r) { return has(r, "unloaded"); }},
    {Chapter::Numbers, "deflections", "Deflection of a tooth under load", [](const Json& r) { return has(r, "deflections") && !has(r, "fit"); }},
    {Chapter::Numbers, "gear-pair", "Gear pair", [](const Json& r) { return has(r, "geometry"); }},
    {Chapter::Numbers, "effects", "Effects and time", [](const Json& r) { return has(r, "effects"); }},
    {Chapter::Numbers, "notes", "Notes", [](const Json& r) { return has(r, "notes"); }},
    {Chapter::Numbers, "inputs", "Given and used", [](const Json& r) { return has(r, "given") || has(r, "used"); }},
};

/// Those that these results have, of the tasks before the shared ones in each chapter.
std::vector<PageSection> sections_of(const Json& results) {
  std::vector<ReportSection> present;
  const auto add = [&](std::span<const ReportSection> sections) {
    std::ranges::copy_if(sections, std::back_inserter(present), [&](const ReportSection& section) { return section.present(results); });
  };
  for (const Task* task : registered_tasks()) {
    if (task->report_sections != nullptr) add(task->report_sections());
  }
  add(shared_sections);
  std::ranges::stable_sort(present, {}, &ReportSection::chapter);
  std::vector<PageSection> sections;
  for (const ReportSection& section : present) sections.push_back({section.id, section.title});
  return sections;
}

std::string text_or(const Json& results, const char* key, const char* fallback) {
  const auto found = results.find(key);
  return found != results.end() && found->is_string() ? found->get<std::string>() : fallback;
}

}  // namespace

std::string render_report(const Json& results) {
  if (!results.is_object()) throw InvalidInput("results.json", results.type_name(), "a JSON object");

  return render_page(text_or(results, "title", "Untitled study"), sections_of(results), report_view(results),
                     std::string(assets::page_script) + std::string(assets::page_main));
}

}  // namespace flankwright::studies
