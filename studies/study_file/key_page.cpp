#include "studies/study_file/key_page.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

namespace {

constexpr std::string_view pinion = "pinion.", wheel = "wheel.";

/// The keys of one table of a study file, tables inside it included unless they have a section of their own.
struct Section {
  std::string table;  ///< "pinion.rack"; "" for keys that lie in no table
  std::string heading;
  std::string introduction;  ///< may be empty
  std::vector<const SchemaKey*> keys{};
};

std::vector<Section> sections_in_order() {
  std::vector<Section> sections{
      {"", "The study", "These keys are written above the first table of the file."},
      {"pair", "`[pair]`", "Data common to both gears."},
      {"pinion", "`[pinion]` and `[wheel]`", "Data of a single gear. What `process` does: [grinding process](README.md#grinding-process)."},
      {"pinion.rack", "`[pinion.rack]`", "The basic rack profile of the tool."},
      {"pinion.edges", "`[pinion.edges]`", "The edges that bound a flank."},
      {"pinion.generation", "`[pinion.generation]`",
       "A tool that cuts another profile than an involute: [generated and measured flanks](README.md#generated-and-measured-flanks)."},
      {"pinion.modification", "`[pinion.modification]`",
       "Amounts are of material removed, normal to the flank in the transverse plane: positive amounts reach into the tooth."},
      {"pinion.error", "`[pinion.error]`",
       "Manufacturing errors. Here metal added is positive. Lists give one value a tooth: [errors of single teeth](README.md#errors-of-single-teeth)."},
      {"pinion.body", "`[pinion.body]`", "The gear below its teeth."},
      {"pinion.shaft", "`[pinion.shaft]`", "The shaft and its bearings: [shafts](README.md#shafts)."},
      {"unit", "`[unit]`", "The gear unit around the pair: [gear units](README.md#gear-units)."},
      {"material", "`[material]`", "For both gears."},
      {"pinion.material", "`[pinion.material]`", "For one gear, instead of `[material]`."},
      {"misalignment", "`[misalignment]`", "Deviation of the gears from their nominal position in the housing."},
      {"load", "`[load]`", ""},
      {"lubricant", "`[lubricant]`", "The oil: [load spectrum and life](README.md#load-spectrum-and-life)."},
      {"unloaded", "`[unloaded]`", "Contact without load."},
      {"cycle", "`[cycle]`", "The mesh positions at which the contact is solved."},
      {"fidelity", "`[fidelity]`", "Models and resolution. The defaults aim at accuracy: [models and accuracy](README.md#models-and-accuracy)."},
      {"output", "`[output]`", "What the results contain."},
      {"scenes", "`[[scenes]]`", "`scenes[].name` stands for the `name` of each `[[scenes]]` table: [scenes](README.md#scenes)."},
      {"expect", "`[expect]`", "A study as its own test: [expectations](README.md#expectations)."},
  };
  for (const Task* task : registered_tasks()) sections.push_back({task->name, std::string("`[") + task->name + "]`", task->meaning});
  return sections;
}

/// The path of the pinion's twin of a key of the wheel; any other path as it is.
std::string as_of_pinion(const std::string& path) { return path.starts_with(wheel) ? std::string(pinion) + path.substr(wheel.size()) : path; }

/// True where a key lies in a table, or in one inside it.
bool lies_in(const std::string& path, const std::string& table) {
  if (table.empty()) return path.find('.') == std::string::npos;
  return path.starts_with(table) && (path.size() == table.size() || path[table.size()] == '.' || path[table.size()] == '[');
}

/// The section of a key: of those it lies in, that of the innermost table. A table without a section gets one at the end.
Section& section_of(std::vector<Section>& sections, const std::string& path) {
  Section* found = nullptr;
  for (Section& section : sections) {
    if (lies_in(path, section.table) && (found == nullptr || section.table.size() > found->table.size())) found = &section;
  }
  const std::string table = path.substr(0, path.find_first_of(".["));
  if (found != nullptr && (!found->table.empty() || table == path)) return *found;
  sections.push_back({table, "`[" + table + "]`", ""});
  return sections.back();
}

/// Unit, default, allowed values and meaning as cells of a table.
std::string cells(const SchemaKey& key) {
  const std::string fallback = is_described_fallback(key) ? key.fallback.substr(1, key.fallback.size() - 2) : "`" + key.fallback + "`";
  return std::string(default_unit(key.quantity)) + " | " + fallback + " | " + allowed_values(key) + " | " + key.meaning;
}

/// True where the pinion has the same key and says the same of it.
bool is_told_by_pinion(const SchemaKey& key) {
  if (!key.path.starts_with(wheel)) return false;
  const auto twin = std::ranges::find(study_schema(), as_of_pinion(key.path), &SchemaKey::path);
  return twin != study_schema().end() && cells(*twin) == cells(key);
}

}  // namespace

std::string key_page() {
  std::vector<Section> sections = sections_in_order();
  for (const SchemaKey& key : study_schema()) {
    if (!is_told_by_pinion(key)) section_of(sections, as_of_pinion(key.path)).keys.push_back(&key);
  }
  std::string page =
      "# Keys of a study file\n\n"
      "This page is printed by `flankwright keys` from the table that the reader itself uses, and a test holds it to that. How a study is\n"
      "written is explained in the [guide](README.md); what a run leaves is explained in the [results reference](results.md).\n\n"
      "- A bare number has the unit of its row. A text may carry another unit: [values and units](README.md#values-and-units).\n"
      "- A key whose default says \"required\" must be given.\n"
      "- A row of the pinion holds for the wheel too, as `wheel.teeth` for `pinion.teeth`. The wheel has a row of its own where the two differ.\n";
  for (const Section& section : sections) {
    if (section.keys.empty()) continue;
    page += "\n## " + section.heading + "\n\n";
    if (!section.introduction.empty()) page += section.introduction + "\n\n";
    page += "| key | unit | default | allowed | meaning |\n|---|---|---|---|---|\n";
    for (const SchemaKey* key : section.keys) page += "| `" + key->path + "` | " + cells(*key) + " |\n";
  }
  return page;
}

}  // namespace flankwright::studies
