#include "studies/tasks/optimise/assessment_keys.hpp"

#include "studies/study_file/distribution_reading.hpp"
#include "studies/study_file/key_rows.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> assessment_keys() {
  using enum ValueKind;
  return {
      {.path = "optimise.comparison.rules", .kind = Word, .words = {"on", "off"}, .fallback = "\"on\"",
       .meaning = "on: the optimum is compared with rules of thumb over the same scenes",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().assessment.rules = v.text == "on"; }},
      {.path = "optimise.comparison.variants", .range = from_zero(1000.0), .fallback = "0",
       .meaning = "analyses of a full-factorial search of the variables for each analysis of the optimiser; 0: none",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().assessment.variants = v.number; }},
      {.path = "optimise.tolerances", .kind = Free, .allowed = distributions_in_words,
       .fallback = "(none)",
       .meaning = "\"misalignment.mesh_misalignment\" = { normal = [0, 6] }: what scatters in scenes drawn for the optimiser or for validation"},
      {.path = "optimise.scenes_drawn.samples", .kind = Integer, .range = {.low = 0, .high = 10'000}, .fallback = "0",
       .meaning = "draws from the tolerances, each in every operating state, whose scenes the optimiser sees beside those listed",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().assessment.scenes.samples = static_cast<int>(v.integer); }},
      {.path = "optimise.scenes_drawn.seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "1",
       .meaning = "another seed, other scenes",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().assessment.scenes.seed = static_cast<unsigned long>(v.integer); }},
      {.path = "optimise.validation.samples", .kind = Integer, .range = {.low = 0, .high = 1'000'000}, .fallback = "0",
       .meaning = "draws from the tolerances, each in every operating state, over which the design before, after and by the best rule of thumb are tried",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().assessment.validation.samples = static_cast<int>(v.integer); }},
      {.path = "optimise.validation.seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "2",
       .meaning = "of these scenes; that of the optimiser's own makes them the same",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().assessment.validation.seed = static_cast<unsigned long>(v.integer); }},
  };
}

// clang-format on

}  // namespace flankwright::studies
