#include "studies/tasks/optimise/scatter_keys.hpp"

#include "studies/study_file/key_rows.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

ScatterTable& scatter(StudyBuilder& builder) { return builder.study.table<OptimiseTable>().scatter; }

void store_statistic(StudyBuilder& builder, Aggregate kind, double value) {
  Aggregation& statistic = scatter(builder).statistic;
  statistic.kind = kind;
  (kind == Aggregate::MeanPlusSigmas ? statistic.sigmas : statistic.level) = value;
}

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> scatter_keys() {
  using enum ValueKind;
  return {
      {.path = "optimise.scatter.draws", .kind = Integer, .range = {.low = 0, .high = 10'000}, .fallback = "0",
       .meaning = "gears and assemblies drawn from the tolerances, over which the design that the listed scenes give is improved; 0: none",
       .store = [](StudyBuilder& d, Member, const Value& v) { scatter(d).draws = static_cast<int>(v.integer); }},
      {.path = "optimise.scatter.seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "1",
       .meaning = "of the draws, which are the same for every design; another seed, other draws",
       .store = [](StudyBuilder& d, Member, const Value& v) { scatter(d).seed = static_cast<unsigned long>(v.integer); }},
      {.path = "optimise.scatter.statistic.quantile", .range = {.low = 0.0, .high = 1.0, .low_open = true, .high_open = true}, .fallback = "(0.95, where no other statistic is given)",
       .meaning = "what is minimised, and bounded by constraints: the value that this share of the draws does not exceed",
       .store = [](StudyBuilder& d, Member, const Value& v) { store_statistic(d, Aggregate::Quantile, v.number); }},
      {.path = "optimise.scatter.statistic.cvar", .range = {.low = 0.0, .high = 1.0, .high_open = true}, .fallback = "(none)",
       .meaning = "instead: the mean over the worst 1 - this share of the draws (conditional value at risk); 0 is the mean",
       .store = [](StudyBuilder& d, Member, const Value& v) { store_statistic(d, Aggregate::Cvar, v.number); }},
      {.path = "optimise.scatter.statistic.mean_plus_sigma", .range = from_zero(100.0), .fallback = "(none)",
       .meaning = "instead: the mean and so many standard deviations; 0 is the expectation",
       .store = [](StudyBuilder& d, Member, const Value& v) { store_statistic(d, Aggregate::MeanPlusSigmas, v.number); }},
      {.path = "optimise.scatter.iso_1328_class", .kind = Integer, .range = {.low = 1, .high = 11}, .fallback = "(none)",
       .meaning = "tolerance class of both gears: slopes, pitch, and form as crowning; what optimise.tolerances has of it stays as it is there",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.tolerance_class = static_cast<int>(v.integer); }},
      {.path = "optimise.scatter.classes", .kind = NumberList, .range = {.low = 1, .high = 11}, .fallback = "(none)",
       .meaning = "classes for each of which the right design is sought, to show what a class costs",
       .store = [](StudyBuilder& d, Member, const Value& v) { for (const double c : v.numbers) scatter(d).classes.push_back(static_cast<int>(c)); }},
      {.path = "optimise.scatter.predicted_from", .kind = Integer, .range = {.low = 0, .high = 1'000'000}, .fallback = "2000",
       .meaning = "draws that the search has not seen, from which the statistic of its design is predicted with a confidence interval; that over the draws searched is too low, as the least of many",
       .store = [](StudyBuilder& d, Member, const Value& v) { scatter(d).predicted_from = static_cast<int>(v.integer); }},
      {.path = "optimise.scatter.predicted_seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "(3, or the next that no other seed is)",
       .meaning = "of these draws; neither that of the search nor that of the fresh draws",
       .store = [](StudyBuilder& d, Member, const Value& v) { scatter(d).predicted_seed = static_cast<unsigned long>(v.integer); }},
      {.path = "optimise.scatter.fresh", .kind = Integer, .range = {.low = 0, .high = 1'000'000}, .fallback = "0",
       .meaning = "further draws, on which the statistic of the designs with and without scatter is tried, and the prediction",
       .store = [](StudyBuilder& d, Member, const Value& v) { scatter(d).fresh = static_cast<int>(v.integer); }},
      {.path = "optimise.scatter.fresh_seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "(2, or the next that no other seed is)",
       .meaning = "of these draws; not that of the search",
       .store = [](StudyBuilder& d, Member, const Value& v) { scatter(d).fresh_seed = static_cast<unsigned long>(v.integer); }},
  };
}

// clang-format on

}  // namespace flankwright::studies
