#include "studies/tasks/fit/fit_keys.hpp"

#include "studies/study_file/key_rows.hpp"
#include "studies/tasks/fit/fit_choice.hpp"

namespace flankwright::studies {

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> fit_keys() {
  using enum ValueKind;
  return {
      {.path = "fit.gear", .kind = Word, .words = {"both", "pinion", "wheel"}, .fallback = "\"both\"",
       .meaning = "whose compliance is fitted",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.table<FitChoice>().gears.pinion = v.text != "wheel";
         d.study.table<FitChoice>().gears.wheel = v.text != "pinion";
       }},
      {.path = "fit.form", .kind = Word, .words = {"one_tooth_accurate", "several_teeth"},
       .fallback = "\"one_tooth_accurate\"", .meaning = "sum of kernels that is fitted: one tooth, or several that are coupled",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<FitChoice>().several_teeth = v.text == "several_teeth"; }},
      {.path = "fit.test_grid", .kind = Word, .words = {"on", "off"}, .fallback = "\"on\"",
       .meaning = "on: compared with finite elements at stations that the fit has not seen as well",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<FitChoice>().test_grid = v.text == "on"; }},
      {.path = "fit.max_iterations", .kind = Integer, .range = {.low = 1, .high = 100'000}, .fallback = "300",
       .meaning = "steps of the least squares, then it ends unconverged with the best so far",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<FitChoice>().max_iterations = static_cast<int>(v.integer); }},
  };
}

// clang-format on

}  // namespace flankwright::studies
