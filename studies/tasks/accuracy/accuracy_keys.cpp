#include "studies/tasks/accuracy/accuracy_keys.hpp"

#include <algorithm>
#include <string>

#include "studies/study_file/key_rows.hpp"
#include "studies/tasks/accuracy/accuracy_table.hpp"

namespace flankwright::studies {

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> accuracy_keys() {
  using enum ValueKind;
  return {
      {.path = "accuracy.finest.compliance", .kind = Word, .words = {"thin_slice", "fitted", "fe"}, .fallback = "\"fitted\"",
       .meaning = "task \"accuracy\": of the finest fidelity level, which the others are compared with",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<AccuracyTable>().compliance = compliance_model(v.text); }},
      {.path = "accuracy.finest.gap", .kind = Word, .words = {"plane_of_action", "whole_surface"}, .fallback = "\"whole_surface\"",
       .meaning = "of the finest level",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<AccuracyTable>().gap = static_cast<GapModel>(v.integer); }},
      {.path = "accuracy.finest.intervals", .kind = Integer, .range = {.low = 8, .high = 128}, .fallback = "16",
       .meaning = "of the finest level, graded; halved down to 2 for the others",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<AccuracyTable>().intervals = static_cast<int>(v.integer); }},
      {.path = "accuracy.finest.positions", .kind = Integer, .range = {.low = 16, .high = 1024}, .fallback = "64",
       .meaning = "of the finest level; halved down to 12 for the others, the peaks refined between them all the same",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<AccuracyTable>().positions = static_cast<int>(v.integer); }},
      {.path = "accuracy.outside.name", .kind = Text, .fallback = "\"outside\"",
       .meaning = "where the curve comes from: a test rig, another program",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<AccuracyTable>().outside.name = v.text; }},
      {.path = "accuracy.outside.transmission_error", .kind = NumberList, .quantity = Quantity::Deviation, .range = within(1e5), .fallback = "(none)",
       .meaning = "of the same pair from elsewhere, at evenly spaced positions over one pitch, the first at phase 0: 3 to 1024 values, with the sign of the results; every level is compared with it too; the study has one load case",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<AccuracyTable>().outside.transmission_error = v.numbers; }},
  };
}

// clang-format on

void check_accuracy(StudyReading& reading) {
  const Study& study = reading.builder.study;
  if (reading.problems.empty() && !has_torque(study)) reading.refuse_key("load.torque", "task \"accuracy\" needs a torque above 0");
  const std::vector<double>& curve = study.table<AccuracyTable>().outside.transmission_error;
  const std::string key = "accuracy.outside.transmission_error";
  if (curve.empty()) {
    if (reading.find("accuracy.outside.name") != nullptr) reading.refuse_key("accuracy.outside.name", "needs " + key);
    return;
  }
  if (curve.size() < 3 || curve.size() > 1024) return reading.refuse_key(key, "3 to 1024 values");
  std::size_t load_cases = 0;
  for (const Scene& scene : study.scenes)
    load_cases += static_cast<std::size_t>(std::ranges::count_if(scene.torques, [](double t) { return t > 0.0; }));
  if (reading.problems.empty() && load_cases != 1)
    reading.refuse_key(key, "a study with one load case, which the curve belongs to; this one has " + std::to_string(load_cases));
}

}  // namespace flankwright::studies
