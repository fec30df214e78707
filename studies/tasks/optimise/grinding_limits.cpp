#include "studies/tasks/optimise/grinding_limits.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/design/search/design_log.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/study_file/key_rows.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

constexpr double per_mm = units::um;  // um per mm, in mm per mm

ModificationConstraint amount_limit(const DesignVariable& v, double largest) {
  ModificationConstraint limit{.name = "largest amount of " + plain_name(v.path), .terms = {{v.member, v.parameter, 1.0}}, .maximum = largest};
  if (v.lower < 0.0) limit.minimum = -largest;
  limit.grinding = GrindingLimit::Amount;
  return limit;
}

/// Of the relief that an amount belongs to; the extent is that of the same gear.
ModificationConstraint slope_limit(Member member, const ModificationDescriptor& amount, double steepest) {
  const std::string path = std::string(name_of(member)) + ".modification." + std::string(amount.key);
  ModificationConstraint limit{.name = "steepest " + plain_name(path),
                               .terms = {{member, amount.parameter, 1.0}, {member, find_parameter(amount.extent)->parameter, -steepest * per_mm}},
                               .maximum = 0.0};
  limit.grinding = GrindingLimit::Slope;
  return limit;
}

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> grinding_limit_keys() {
  return {
      {.path = "optimise.grinding.largest_amount", .quantity = Quantity::Deviation, .range = above_zero(1000.0), .fallback = "(no limit)",
       .meaning = "of every varied amount, either way",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().largest_amount = v.number; }},
      {.path = "optimise.grinding.smallest_amount", .quantity = Quantity::Deviation, .range = above_zero(1000.0), .fallback = "(no limit)",
       .meaning = "of every varied amount, either way: one that the search leaves below it becomes 0 or at least this, whichever is better",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().grindable.smallest = v.number; }},
      {.path = "optimise.grinding.not_together", .kind = ValueKind::Free, .allowed = "a list of pairs of keys below pinion.modification or below wheel.modification, each of one gear",
       .fallback = "(none)",
       .meaning = "[[\"pinion.modification.tip_relief\", \"pinion.modification.profile_crowning\"]]: not ground at once; the better of the two alternatives without one of them is chosen"},
      {.path = "optimise.grinding.steepest_relief", .range = above_zero(1e4), .fallback = "(no limit)",
       .meaning = "um per mm: amount of every varied relief over its height or length",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.table<OptimiseTable>().steepest_relief = v.number; }},
  };
}

// clang-format on

void read_grinding_limits(StudyReading& reading) {
  OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const std::vector<DesignVariable> varied = optimise.varied();
  if (optimise.largest_amount) {
    for (const DesignVariable& v : varied) {
      if (describe(v.parameter).kind != ParameterKind::Amount) continue;
      if (v.lower > *optimise.largest_amount || v.upper < -*optimise.largest_amount) {
        reading.refuse_key("optimise.variables." + v.path,
                           "a range that reaches optimise.grinding.largest_amount = " + in_words(*optimise.largest_amount / units::um) + " um");
      }
      optimise.modification_constraints.push_back(amount_limit(v, *optimise.largest_amount));
    }
  }
  if (!optimise.steepest_relief) return;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    for (const ModificationDescriptor& amount : modification_parameters) {
      if (amount.extent.empty()) continue;
      const ModificationParameter extent = find_parameter(amount.extent)->parameter;
      const bool is_varied = std::ranges::any_of(
          varied, [&](const DesignVariable& v) { return v.member == member && (v.parameter == amount.parameter || v.parameter == extent); });
      if (is_varied) optimise.modification_constraints.push_back(slope_limit(member, amount, *optimise.steepest_relief));
    }
  }
}

Json grinding_limits_json(const DesignTask& task, const DesignReport& report) {
  Json limits = Json::array();
  for (std::size_t c = 0; c < task.modification_constraints.size(); ++c) {
    const ModificationConstraint& limit = task.modification_constraints[c];
    if (limit.grinding == GrindingLimit::None) continue;
    double scale = 0.0;  // as DesignProblem::modification_scale(), of the first term
    for (const DesignVariable& v : task.variables) {
      for (const auto& term : limit.terms) {
        if (v.member == term.member && v.parameter == term.parameter) scale += std::abs(term.factor) * (v.upper - v.lower);
      }
    }
    if (scale == 0.0) scale = std::max(std::abs(limit.maximum), units::um);  // only what is tied
    const double value = report.modification_values[c], beyond = std::max(value - limit.maximum, limit.minimum - value) / scale;
    Json entry{{"name", limit.name}};
    const PerGear<Modification>& ground = report.analysis.modification;
    if (limit.grinding == GrindingLimit::Slope) {
      const double extent = get(ground[limit.terms[1].member], limit.terms[1].parameter);
      entry.update({{"value", get(ground[limit.terms[0].member], limit.terms[0].parameter) / extent / per_mm},
                    {"limit", -limit.terms[1].factor / per_mm},
                    {"unit", "um/mm"}});
    } else {
      entry.update({{"value", in_um(value)}, {"limit", in_um(limit.maximum)}, {"unit", "um"}});
    }
    entry["state"] = beyond > DesignLog::tolerance ? "exceeded" : beyond > -near_limit ? "active" : "met";
    limits.push_back(std::move(entry));
  }
  return limits;
}

}  // namespace flankwright::studies
