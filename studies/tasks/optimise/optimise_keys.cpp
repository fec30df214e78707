#include "studies/tasks/optimise/optimise_keys.hpp"

#include "optimize/design/outputs/design_output.hpp"
#include "optimize/solvers/solver.hpp"
#include "studies/study_file/key_rows.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> optimise_keys() {
  using enum ValueKind;
  return {
      {.path = "optimise.objective", .kind = Free, .allowed = quoted_list(term_names()) + ", a table of them, or a list in the order of importance",
       .fallback = "\"peak_contact_stress\"",
       .meaning = "minimised; a table of names and weights minimises the sum of weight * value (um, MPa, N/mm); of a list each while those before it stay near their least"},
      {.path = "optimise.lexicographic_tolerance", .range = above_zero(10.0), .fallback = "0.01",
       .meaning = "of a list of objectives: how far one may rise above its least while the next is minimised, as a share of it",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().lexicographic_tolerance = v.number; }},
      {.path = "optimise.over", .kind = Word, .words = {"nominal", "worst", "mean", "mean+sigmas", "cvar", "mean+2sigma"},
       .fallback = "\"worst\"", .meaning = "of the scenes; nominal is the first, mean+2sigma is mean+sigmas with sigmas = 2, cvar the mean over the worst of them",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         const bool two_sigmas = v.text == "mean+2sigma";
         d.study.table<OptimiseTable>().over.kind = two_sigmas ? Aggregate::MeanPlusSigmas : static_cast<Aggregate>(v.integer);
       }},
      {.path = "optimise.sigmas", .range = above_zero(100.0), .fallback = "2", .meaning = "k of over = \"mean+sigmas\": mean + k standard deviations",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().over.sigmas = v.number; }},
      {.path = "optimise.cvar_level", .range = {.low = 0.0, .high = 1.0, .high_open = true}, .fallback = "0.9",
       .meaning = "of over = \"cvar\": the mean over the worst 1 - level of the scenes' weight (conditional value at risk)",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().over.level = v.number; }},
      {.path = "optimise.solver", .kind = Word, .words = solver_names(), .fallback = "\"nlopt:slsqp\"",
       .meaning = "the optimiser",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().solver.name = v.text; }},
      {.path = "optimise.finisher", .kind = Word, .words = finisher_names(), .fallback = "\"nlopt:slsqp\"",
       .meaning = "what goes on from the best design where a solver with gradients and constraints stalls on a kink; none: the search ends there",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().solver.finisher = v.text; }},
      {.path = "optimise.variables", .kind = Free, .allowed = "a table of keys below pinion.modification or wheel.modification, or twist_compensation of either, each with [low, high] or { range = [low, high], step = ... }",
       .fallback = "(none)",
       .meaning = "\"pinion.modification.lead_crowning\" = [0, 40]: what may change, in the unit of its key; { range = [0, 40], step = 1 }: and is ground in such steps"},
      {.path = "optimise.step", .kind = NumberOrNone, .quantity = Quantity::Deviation, .range = above_zero(100.0), .fallback = "\"none\"",
       .meaning = "what the grinder can set: the optimum is rounded to multiples of it, in variables that are amounts and have no step of their own; none: it is not rounded",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().step = v.number; }},
      {.path = "optimise.ties", .kind = Free, .allowed = "a table of keys that may be variables, each with { as = a variable } and factor, offset",
       .fallback = "(none)",
       .meaning = "\"wheel.modification.lead_crowning\" = { as = \"pinion.modification.lead_crowning\", factor = 1, offset = 0 }: follows a variable, factor * value + offset"},
      {.path = "optimise.constraints", .kind = Free, .allowed = "a table of outputs, or sums of keys below pinion.modification and wheel.modification, each with { max = ... }, { min = ... } or both",
       .fallback = "(none)",
       .meaning = "\"te_peak_to_peak\" = { max = 1.5 }: transmission error in um, stress in MPa, line load in N/mm, in every scene; \"pinion.modification.lead_crowning + wheel.modification.lead_crowning\" = { max = 30 }"},
      {.path = "optimise.edge_margin", .range = {.low = 0.0, .high = 0.5, .low_open = true}, .fallback = "0.05",
       .meaning = "of edge_load: share of the face width at either end and of the active height at either tip",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().edge_margin = v.number; }},
      {.path = "optimise.starts", .kind = Integer, .range = {.low = 1, .high = 1000}, .fallback = "1",
       .meaning = "searches, side by side: from the file's values and from a space-filling set; max_evaluations is shared among them; of a front for the best of each objective",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().starts = static_cast<int>(v.integer); }},
      {.path = "optimise.pareto.objectives", .kind = Free, .allowed = "a list of two or three outputs, or tables of them",
       .fallback = "(none)",
       .meaning = "a front of compromises between these as well, with a budget of its own of the same size"},
      {.path = "optimise.pareto.points", .kind = Integer, .range = {.low = 3, .high = 200}, .fallback = "9",
       .meaning = "of the front; of three objectives the largest of 3, 6, 10, 15 ... within it",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().pareto_points = static_cast<int>(v.integer); }},
      {.path = "optimise.max_evaluations", .kind = Integer, .range = {.low = 1, .high = 10'000'000}, .fallback = "2000",
       .meaning = "then the search ends with the best design so far, which is still looked at finely",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.table<OptimiseTable>().solver.max_evaluations = static_cast<int>(v.integer);
       }},
      {.path = "optimise.max_seconds", .quantity = Quantity::Time, .range = above_zero(1e8), .fallback = "(no limit)",
       .meaning = "then the search ends with the best design so far, which is still looked at finely",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().solver.max_seconds = v.number; }},
      {.path = "optimise.seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "1",
       .meaning = "of the stochastic solvers and of the starts",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.table<OptimiseTable>().solver.seed = static_cast<unsigned long>(v.integer);
       }},
  };
}

// clang-format on

}  // namespace flankwright::studies
