#include "studies/tasks/optimise/life_error.hpp"

#include <cmath>

namespace flankwright::studies {

namespace {

/// Of the spectrum that a load case belongs to.
double damage_error(const StudyLife& life, std::size_t of_case, PerGear<std::optional<DamagedPoint>> SpectrumLife::*kind) {
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
  if (of == nullptr) return not_given;
  const auto number = static_cast<std::size_t>(of - life.cases.data());
  switch (output) {
    case Output::ContactDamage:
      return damage_error(life, number, &SpectrumLife::contact);
    case Output::RootDamage:
      return damage_error(life, number, &SpectrumLife::root);
    case Output::LossFactor:
      return of->errors.loss_factor;
    case Output::SpecificFilmThickness:
      return of->errors.film;
    case Output::FlashTemperature:
      return of->errors.flash_temperature;
    case Output::ContactTemperature:
      return of->errors.contact_temperature;
    case Output::MicropittingUtilisation:  // 1/S
      return of->errors.micropitting_safety / (of->micropitting_safety * of->micropitting_safety);
    case Output::ScuffingUtilisation:
      return of->errors.scuffing_safety / (of->scuffing_safety * of->scuffing_safety);
    default:
      return not_given;
  }
}

}  // namespace flankwright::studies
