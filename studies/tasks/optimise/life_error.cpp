#include "studies/tasks/optimise/life_error.hpp"

#include <cmath>

#include "studies/analysis/life_quantities.hpp"

namespace flankwright::studies {

namespace {

/// Of the spectrum that a load case belongs to.
double damage_error(const StudyLife& life, std::size_t of_case, DamagedPoints SpectrumLife::*kind) {
  const auto spectrum =
      std::ranges::find_if(life.spectra, [&](const SpectrumLife& s) { return std::ranges::find(s.cases, of_case) != s.cases.end(); });
  if (spectrum == life.spectra.end()) return not_given;
  double damage = not_given, at_most = not_given;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const std::optional<DamagedPoint>& point = ((*spectrum).*kind)[m];
    if (!point) continue;
    if (std::isnan(point->damage_error)) return not_given;
    damage = std::fmax(damage, point->damage);
    at_most = std::fmax(at_most, point->damage + point->damage_error);
  }
  return at_most - damage;
}

}  // namespace

double life_error(const StudyLife& life, std::size_t loaded, Output output) {
  const CaseLife* of = life.find(loaded);
  const auto quantity = std::ranges::find(life_quantities(), output, &LifeQuantity::output);
  if (of == nullptr || quantity == life_quantities().end()) return not_given;
  if (quantity->of_spectrum != nullptr) return damage_error(life, static_cast<std::size_t>(of - life.cases.data()), quantity->of_spectrum);
  if (quantity->error == nullptr) return not_given;
  const double error = of->errors.*quantity->error, value = of->*quantity->of_pair;
  return quantity->is_reciprocal ? error / (value * value) : error;
}

}  // namespace flankwright::studies
