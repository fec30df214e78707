#include "optimize/design/design_task.hpp"

namespace flankwright {

namespace {

bool is_extent(ModificationParameter parameter) {
  return parameter == ModificationParameter::TipReliefHeight || parameter == ModificationParameter::RootReliefHeight ||
         parameter == ModificationParameter::EndReliefLength;
}

}  // namespace

double DesignVariable::outside_factor() const {
  if (parameter == ModificationParameter::ParabolicTe) return 1.0 / units::arcsec_per_square_deg;
  return is_extent(parameter) ? 1.0 : 1.0 / units::um;
}

const char* DesignVariable::unit() const {
  if (parameter == ModificationParameter::ParabolicTe) return "arcsec/deg^2";
  return is_extent(parameter) ? "mm" : "um";
}

double ModificationConstraint::value(const Modification& pinion, const Modification& wheel) const {
  double sum = 0.0;
  for (const Term& term : terms) sum += term.factor * get(term.member == Member::Pinion ? pinion : wheel, term.parameter);
  return sum;
}

double ModificationConstraint::outside_factor() const { return DesignVariable{{}, {}, terms.front().parameter}.outside_factor(); }

const char* ModificationConstraint::unit() const { return DesignVariable{{}, {}, terms.front().parameter}.unit(); }

std::string Goal::name() const {
  std::string name;
  for (const ObjectiveTerm& term : terms) name += (name.empty() ? "" : " + ") + term.name;
  return name;
}

const char* Goal::unit() const { return terms.size() == 1 ? terms.front().unit() : "weighted sum"; }

}  // namespace flankwright
