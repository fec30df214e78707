#include "studies/exchange/rexs/rexs_import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/grouped_warnings.hpp"
#include "studies/exchange/rexs/modification_text.hpp"
#include "studies/exchange/rexs/rexs_defects.hpp"
#include "studies/exchange/rexs/rexs_load_cases.hpp"
#include "studies/exchange/rexs/rexs_lubricant.hpp"
#include "studies/exchange/rexs/rexs_origin.hpp"
#include "studies/exchange/rexs/rexs_shaft.hpp"
#include "studies/exchange/rexs/rexs_unit.hpp"
#include "studies/exchange/rexs/unit_text.hpp"
#include "studies/study_file/study_file.hpp"

namespace flankwright::studies::rexs {

namespace {

/// Types that are looked into for one stage: what of these is not taken is listed by name.
bool belongs_to_stage(const StageParts& parts, const Component& component) {
  for (const GearParts& gear : parts.gears) {
    for (const Component* part : {gear.gear, gear.data, gear.flank, gear.other_flank, gear.tool, gear.material}) {
      if (part == &component) return true;
    }
  }
  return &component == parts.stage;
}

/// "version 1.6", and whether it is one that was known when this was written.
void check_version(Reading& reading) {
  const std::string& version = reading.model().version;
  const bool known = version.size() >= 3 && (version.starts_with("1.") || version == "2.0" || version.starts_with("2.0.")) &&
                     std::ranges::all_of(version, [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
  if (!known) reading.warn(fmt::format("version \"{}\" of the format is not known here (known: 1.0 to 2.0), read as if it were", version));
}

class Import {
 public:
  Import(Reading& reading, const RexsImportOptions& options)
      : reading_(reading),
        options_(options),
        parts_(find_stage(reading, options.stage)),
        cases_(reading, parts_, read_torques(reading, parts_), options.hours) {
    check_unit();
    take_flank(reading, parts_, cases_.reference().flank, cases_.reference().flank_source);
  }

  ImportedStudy study() {
    check_version(reading_);
    const ImportedPair pair = read_pair(reading_, parts_);
    const GearPair geometry = build(pair);
    StudyText body;
    write_pair(pair, body);
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      add_modification(read_modification(reading_, parts_[m], geometry, m, options_.slope_end), m, body);
    }
    write_materials(body);
    std::string one_sided = grids_.empty() ? "" : "a measured grid";
    const auto unit = read_unit(reading_, parts_, geometry, cases_.torques());
    if (unit) {
      write_unit(*unit, body);
      if (!std::ranges::all_of(unit->shafts.unit.loads, &UnitLoad::keeps_direction)) one_sided = "a gear unit with forces that scale with the torque";
    } else {
      for (const Member m : {Member::Pinion, Member::Wheel}) {
        const auto shaft = read_shaft(reading_, parts_[m], geometry[m].data.face_width);
        if (!shaft) continue;
        write_shaft(*shaft, m, body);
      }
    }
    cases_.write(one_sided, unit ? unit->misalignment : std::map<const LoadCase*, double>(), body);
    write_lubricant(reading_, parts_, cases_.temperature(), body);
    std::string not_taken = write_rest(body);
    const std::string text = head() + body.text();
    check(text);
    return {text, std::move(grids_), grouped_by_component(reading_.warnings()), std::move(not_taken)};
  }

 private:
  /// Refuses defects of the part of the unit that turns with the stage; names those of others.
  void check_unit() {
    std::vector<StudyProblem> defects = find_defects(reading_, part_around(reading_, *parts_.stage));
    if (!defects.empty()) throw StudyErrors(std::move(defects));
    for (const StudyProblem& defect : find_defects(reading_)) {
      reading_.warn(fmt::format("in a part of the file that does not turn with the stage: {} = {}: {}", defect.key, defect.value, defect.allowed));
    }
  }

  GearPair build(const ImportedPair& pair) const {
    const std::vector<InvalidInput> problems = find_problems(pair.data);
    if (problems.empty()) return make_gear_pair(pair.data);
    std::vector<StudyProblem> all;
    for (const InvalidInput& problem : problems) {
      const auto source = pair.remarks.find(problem.field());
      const Origin origin = origin_of(reading_.model(), source == pair.remarks.end() ? "" : source->second);
      all.push_back(in_terms_of_file({"", 0, 0, problem.field(), problem.value(), "allowed is " + problem.allowed()}, origin));
    }
    throw StudyErrors(std::move(all));
  }

  /// A problem of a key of the study as one of the file, where its value came from.
  StudyProblem in_terms_of_file(StudyProblem problem, const Origin& origin) const {
    problem.file = reading_.file();
    problem.line = origin.component != nullptr ? origin.line : parts_.stage->line;
    problem.column = problem.line > 0 ? 1 : 0;
    problem.key = full_name(*parts_.stage) + ": " + problem.key + (origin.words.empty() ? "" : " (" + origin.words + ")");
    return problem;
  }

  /// What the comment behind a line of the study names. A line without one has that of the first line of its table, or the component by which that calls itself.
  Origin origin_of_line(const std::vector<std::string>& lines, std::size_t line) const {
    const auto after = [&](std::string_view mark) {
      const std::size_t at = lines[line].find(mark);
      return at == std::string::npos ? std::string() : lines[line].substr(at + mark.size());
    };
    if (const std::string remark = after(" # "); !remark.empty()) return origin_of(reading_.model(), remark);
    while (line > 0 && !lines[line].starts_with('[')) --line;
    line = std::min(line + 1, lines.size() - 1);
    std::string text = after(" # ").empty() ? after(" = ") : after(" # ");
    std::erase(text, '"');
    const Origin origin = origin_of(reading_.model(), text);
    return origin.component == nullptr ? Origin{} : origin;
  }

  /// The schema's own limits (a module of 2 m, a helix angle of 60 deg) are checked where they are kept; grids are in files yet to be written.
  void check(const std::string& study) const {
    std::vector<std::string> lines;
    std::istringstream text(study);
    for (std::string line; std::getline(text, line);) lines.push_back(line.starts_with("grid = ") ? "" : line);
    try {
      parse_study(fmt::format("{}\n", fmt::join(lines, "\n")), reading_.file());
    } catch (const StudyErrors& errors) {
      std::vector<StudyProblem> problems = errors.problems();
      for (StudyProblem& problem : problems) {
        const bool has_line = problem.line > 0;
        problem = in_terms_of_file(problem, has_line ? origin_of_line(lines, static_cast<std::size_t>(problem.line) - 1) : Origin{});
      }
      throw StudyErrors(std::move(problems));
    }
  }

  /// Written last: what is to be said is known only then.
  std::string head() const {
    const Model& model = reading_.model();
    const std::string file = std::filesystem::path(reading_.file()).filename().string();
    StudyText text;
    text.comment(fmt::format("Stage {} of {}, REXS {}{}.", parts_.stage->id, file, model.version,
                             model.application.empty() ? "" : ", written by " + model.application + " " + model.application_version));
    text.comment(
        "The comment behind each value names the attribute that it came from. Amounts of modifications count as removed along the transverse");
    text.comment("base tangent; z runs along the pinion's u axis, from mid face.");
    if (!reading_.warnings().empty()) {
      text.comment("");
      text.comment("Not as in the file:");
      for (const std::string& warning : grouped_by_component(reading_.warnings())) text.comment("  - " + warning);
    }
    text.key("title", quoted((parts_.stage->name.empty() ? Reading::name_of(*parts_.stage) : parts_.stage->name) + ", " + file));
    text.key("task", "\"analyse\"");
    return text.text();
  }

  void add_modification(const ImportedModification& modification, Member m, StudyText& text) {
    const std::string name = options_.grid_stem + (m == Member::Pinion ? "-pinion.csv" : "-wheel.csv");
    write_modification(modification, m, name, text);
    if (!modification.grid.empty()) grids_.push_back({name, modification.grid});
  }

  void write_materials(StudyText& text) {
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      const Component* material = parts_[m].material;
      const auto modulus = reading_.number(material, "elastic_modulus", Dimension::Stress);
      const auto poisson = reading_.number(material, "poisson_ratio", Dimension::None);
      if (!modulus && !poisson) continue;
      text.table(m == Member::Pinion ? "pinion.material" : "wheel.material");
      if (modulus) text.key("youngs_modulus", number_text(modulus->value), modulus->source);
      if (poisson) text.key("poissons_ratio", number_text(poisson->value), poisson->source);
    }
  }

  /// Attributes that were not read of components that belong to the stage or were looked at, and how many there are of the others: in numbers in the
  /// study, in full in a list.
  std::string write_rest(StudyText& text) {
    std::map<std::string, int> others, attributes;
    std::string all = "Not taken, as a study has no key for it or it follows from what was taken:\n";
    for (const Component& component : reading_.model().components) {
      const std::vector<std::string> unread = reading_.unread(component);
      if (unread.size() == component.attributes.size() && !belongs_to_stage(parts_, component)) {
        ++others[component.type];
      } else if (!unread.empty()) {
        attributes[component.type] += static_cast<int>(unread.size());
        all += fmt::format("  {}: {}\n", Reading::name_of(component), fmt::join(unread, ", "));
      }
    }
    for (const LoadCase& load_case : reading_.model().load_cases) {
      for (const Component& varied : load_case.components) {
        const std::vector<std::string> unread = reading_.unread(varied);
        const Component* component = reading_.model().find(varied.id);
        if (unread.empty()) continue;
        attributes["load case"] += static_cast<int>(unread.size());
        all += fmt::format("  load case {}, {}: {}\n", load_case.id, Reading::name_of(component != nullptr ? *component : varied),
                           fmt::join(unread, ", "));
      }
    }
    std::vector<std::string> words;
    for (const auto& [type, count] : attributes) words.push_back(fmt::format("{} of {}", count, type));
    text.blank();
    text.comment("Not taken, as a study has no key for it or it follows from what was taken (in full: " + not_taken_name(options_.grid_stem) + "):");
    if (!words.empty()) text.comment(fmt::format("  attributes: {}", fmt::join(words, ", ")));
    words.clear();
    for (const auto& [type, count] : others) {
      words.push_back(fmt::format("{} x {}", count, type));
      all += fmt::format("  {} x {}\n", count, type);
    }
    if (!words.empty()) text.comment(fmt::format("  components: {}", fmt::join(words, ", ")));
    return all;
  }

  Reading& reading_;
  const RexsImportOptions& options_;
  StageParts parts_;
  LoadCases cases_;
  std::vector<ImportedGrid> grids_;
};

}  // namespace

ImportedStudy import_stage(const std::string& text, const std::string& name, const RexsImportOptions& options) {
  const Model model = parse_model(text, name);
  Reading reading(model, name);
  return Import(reading, options).study();
}

std::string not_taken_name(const std::string& grid_stem) { return grid_stem + "-not-taken.txt"; }

std::string stem_of_stage(const std::string& stem, int number) { return fmt::format("{}-stage-{}", stem, number); }

UnitImport import_unit(const std::string& text, const std::string& name, const RexsImportOptions& options) {
  const Model model = parse_model(text, name);
  const Reading reading(model, name);
  UnitImport all;
  const std::vector<const Relation*> stages = stages_of(reading);
  if (options.stage || stages.size() < 2) {
    all.stages.push_back({options.stage.value_or(1), import_stage(text, name, options)});
    return all;
  }
  if (std::vector<StudyProblem> defects = find_defects(reading); !defects.empty()) throw StudyErrors(std::move(defects));
  std::vector<StudyProblem> reasons;  // of what is left out
  const auto leave_out = [&](const Component& stage, const std::string& value, const std::string& allowed) {
    all.left_out.push_back(Reading::name_of(stage) + ": " + value + ", allowed is " + allowed);
    reasons.push_back({name, stage.line, stage.line > 0 ? 1 : 0, Reading::name_of(stage), value, "allowed is " + allowed});
  };
  for (const Relation& relation : model.relations) {
    const auto id = relation.type == "stage" ? relation.role("stage") : std::nullopt;
    const Component* stage = id ? model.find(*id) : nullptr;
    if (stage != nullptr && stage->type != "cylindrical_stage") leave_out(*stage, "in the file", "a cylindrical stage: others are not modelled");
  }
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    const Component& stage = reading.in_role(*stages[i], "stage");
    RexsImportOptions of_stage = options;
    of_stage.stage = number;
    of_stage.grid_stem = stem_of_stage(options.grid_stem, number);
    try {
      all.stages.push_back({number, import_stage(text, name, of_stage)});
    } catch (const StudyErrors& errors) {
      std::vector<std::string> whys;  // without the file, which all have
      for (const StudyProblem& problem : errors.problems()) {
        whys.push_back(fmt::format("{} = {}: {}{}", problem.key, problem.value, problem.allowed,
                                   problem.line > 0 ? fmt::format(" (line {})", problem.line) : ""));
      }
      all.left_out.push_back(fmt::format("{}: {}", Reading::name_of(stage), fmt::join(whys, "; ")));
      for (const StudyProblem& problem : errors.problems()) {
        // Stages of one unit may share what is wrong.
        if (std::ranges::find(reasons, to_string(problem), to_string) == reasons.end()) reasons.push_back(problem);
      }
    }
  }
  if (all.stages.empty()) throw StudyErrors(std::move(reasons));
  all.left_out = grouped_by_component(all.left_out);
  return all;
}

}  // namespace flankwright::studies::rexs
