#include "optimize/design/problem/design_task.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

double allowed_deviation(const ParameterDescription& parameter, double design, double deviation) {
  const bool is_of_relief = parameter.kind == ParameterKind::Extent || !parameter.extent.empty();
  return is_of_relief && design >= 0.0 ? std::max(deviation, -design) : deviation;
}

bool ModificationDeviation::is_cut(const PerGear<Modification>& design) const {
  return allowed_deviation(describe(parameter), get(design[member], parameter), value) != value;
}

void ModificationDeviation::add_to(PerGear<Modification>& modification) const {
  Modification& m = modification[member];
  const ParameterDescription& row = describe(parameter);
  if (row.half.empty()) return set(m, parameter, get(m, parameter) + allowed_deviation(row, get(m, parameter), value));
  for (const std::string_view key : {row.half, row.other_half}) {
    const ModificationDescriptor& half = *find_parameter(key);
    half.set(m, half.get(m) + value);
  }
}

FlankCondition DesignScene::with_design(PerGear<Modification> design) const {
  for (const ModificationDeviation& d : deviations) d.add_to(design);
  FlankCondition with = condition;
  with.set_design(design);
  return with;
}

bool DesignVariable::touches(Member of, ModificationParameter other) const {
  const ParameterDescription &own = describe(parameter), &row = describe(other);
  return member == of && (own.key == row.key || own.key == row.half || own.key == row.other_half || own.half == row.key || own.other_half == row.key);
}

double DesignVariable::outside_factor() const { return flankwright::outside_factor(describe(parameter).kind); }

double DesignVariable::outside(double value) const { return units::without_round_off(value * outside_factor()); }

const char* DesignVariable::unit() const { return unit_of(describe(parameter).kind); }

double ModificationConstraint::value(const PerGear<Modification>& modification) const {
  double sum = 0.0;
  for (const Term& term : terms) sum += term.factor * get(modification[term.member], term.parameter);
  return sum;
}

double ModificationConstraint::outside_factor() const { return DesignVariable{{}, {}, terms.front().parameter}.outside_factor(); }

const char* ModificationConstraint::unit() const { return DesignVariable{{}, {}, terms.front().parameter}.unit(); }

bool Objective::over_spectrum() const {
  return std::ranges::any_of(terms, [](const ObjectiveTerm& term) { return design_output(term.output).over_spectrum; });
}

double Objective::growth() const {
  double largest = 1.0;
  for (const ObjectiveTerm& term : terms) largest = std::max(largest, design_output(term.output).growth);
  return largest;
}

std::string Objective::name() const {
  std::string name;
  for (const ObjectiveTerm& term : terms) name += (name.empty() ? "" : " + ") + term.name;
  return name;
}

const char* Objective::unit() const { return terms.size() == 1 ? terms.front().unit() : "weighted sum"; }

ObjectiveBound bound_on(const OutputConstraint& constraint, const Aggregation& over) {
  ObjectiveTerm output = constraint.output;
  output.weight = 1.0;
  output.reciprocal = constraint.is_least();
  return {{{output}, over}, (constraint.is_least() ? 1.0 / constraint.minimum : constraint.maximum) * output.outside_factor()};
}

}  // namespace flankwright
