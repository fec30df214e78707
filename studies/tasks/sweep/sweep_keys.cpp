#include "studies/tasks/sweep/sweep_keys.hpp"

#include "studies/study_file/distribution_reading.hpp"
#include "studies/study_file/key_rows.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> sweep_keys() {
  using enum ValueKind;
  return {
      {.path = "sweep.samples", .kind = Integer, .range = {.low = 1, .high = 4294967295.0}, .fallback = "1000",
       .meaning = "how many; a grid has as many as its levels make and must not give it",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<SweepTable>().samples = v.integer; }},
      {.path = "sweep.sampler", .kind = Word, .words = sampler_names(), .fallback = "\"sobol\"",
       .meaning = "how samples are spread; grid: every combination of levels, all parameters with { grid } or { values }",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<SweepTable>().sampler = static_cast<Sampler>(v.integer); }},
      {.path = "sweep.seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "1",
       .meaning = "another seed, other samples",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<SweepTable>().seed = static_cast<unsigned long>(v.integer); }},
      {.path = "sweep.indices", .kind = Word, .words = {"on", "off"}, .fallback = "\"on\"",
       .meaning = "samples in blocks of parameters + 2, from which Sobol indices follow; off: all independent; without meaning in a grid",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<SweepTable>().indices = v.text == "on"; }},
      {.path = "sweep.parameters", .kind = Free, .allowed = distributions_in_words,
       .fallback = "(none)",
       .meaning = "\"misalignment.mesh_misalignment\" = { normal = [0, 6] }: what scatters, in the unit of its key"},
  };
}

// clang-format on

}  // namespace flankwright::studies
