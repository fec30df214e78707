#include "studies/tasks/accuracy/accuracy_keys.hpp"

#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> accuracy_keys() {
  using enum ValueKind;
  return {
      {.path = "accuracy.finest.compliance", .kind = Word, .words = {"thin_slice", "fitted", "fe"}, .fallback = "\"fitted\"",
       .meaning = "task \"accuracy\": of the finest fidelity level, which the others are compared with",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.accuracy.compliance = compliance_model(v.text); }},
      {.path = "accuracy.finest.gap", .kind = Word, .words = {"plane_of_action", "whole_surface"}, .fallback = "\"whole_surface\"",
       .meaning = "of the finest level",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.accuracy.gap = static_cast<GapModel>(v.integer); }},
      {.path = "accuracy.finest.intervals", .kind = Integer, .range = {.low = 8, .high = 128}, .fallback = "16",
       .meaning = "of the finest level, graded; halved down to 2 for the others",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.accuracy.intervals = static_cast<int>(v.integer); }},
      {.path = "accuracy.finest.positions", .kind = Integer, .range = {.low = 16, .high = 1024}, .fallback = "64",
       .meaning = "of the finest level; halved down to 12 for the others, the peaks refined between them all the same",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.accuracy.positions = static_cast<int>(v.integer); }},
  };
}

// clang-format on

}  // namespace flankwright::studies
