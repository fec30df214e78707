#include "optimize/design/outputs/life_outputs.hpp"

#include <array>
#include <cmath>

#include "core/gear/both_gears.hpp"
#include "core/base/error.hpp"
#include "core/rating/contact_temperature.hpp"
#include "core/rating/film_thickness.hpp"
#include "core/rating/sliding_loss.hpp"

namespace flankwright {

namespace {

Member member_of(const PeakCandidate& candidate) { return both_gears[static_cast<std::size_t>(candidate.other % 2)]; }
int number(Eigen::Index point, Member member) { return 2 * static_cast<int>(point) + (member == Member::Pinion ? 0 : 1); }

const LifeModel& life_of(const ObjectiveTerm& term, const LoadedScene& scene) {
  if (scene.life == nullptr)
    throw InvalidInput(term.name, "no material data", "material.contact_endurance_limit or root_endurance_limit, or [lubricant]");
  return *scene.life;
}

/// The curve of one kind of each gear; an output of damage needs one at least.
template <class Curve>
PerGear<const SnCurve*> curves(const ObjectiveTerm& term, const LoadedScene& scene, const char* key, const Curve& curve_of) {
  const LifeModel& life = life_of(term, scene);
  PerGear<const SnCurve*> found;
  for (const Member m : both_gears) {
    const std::optional<SnCurve>& curve = curve_of(life.strength[m]);
    found[m] = curve ? &*curve : nullptr;
  }
  if (found.pinion == nullptr && found.wheel == nullptr) throw InvalidInput(term.name, "no S-N curve", key);
  if (scene.spectrum.empty()) throw InvalidInput(term.name, "no load spectrum", "load.spectrum");
  return found;
}

PerGear<const SnCurve*> contact_curves(const ObjectiveTerm& term, const LoadedScene& scene) {
  return curves(
      term, scene, "material.contact_endurance_limit", [](const FatigueStrength& s) -> const auto& { return s.contact; });
}

PerGear<const SnCurve*> root_curves(const ObjectiveTerm& term, const LoadedScene& scene) {
  return curves(
      term, scene, "material.root_endurance_limit", [](const FatigueStrength& s) -> const auto& { return s.root; });
}

SmoothValue smooth(double value, const Eigen::RowVectorXd& gradient) { return {value, gradient.transpose()}; }

FilletPoints fillets_of(const LoadedScene& scene, Member member) {
  return scene.fillets != nullptr ? (*scene.fillets)[member] : fillet_points(scene.model, member);
}

struct Film {
  const Lubricant& lubricant;
  FilmCondition condition;
};

/// @param force  of the mesh [N]
Film film_under(double force, const ObjectiveTerm& term, const LoadedScene& scene) {
  const LifeModel& life = life_of(term, scene);
  if (!life.lubricant) throw InvalidInput(term.name, "no lubricant", "a table [lubricant]");
  if (scene.operation == nullptr || !(scene.operation->speed > 0.0)) throw InvalidInput(term.name, "no speed", "load.speed, or a speed in every bin");
  return {*life.lubricant, *film_condition_of(scene.model, life, *scene.operation, force)};
}

Film film_of(const ObjectiveTerm& term, const LoadedScene& scene) { return film_under(scene.cycle.force, term, scene); }

/// A value at one point with its gradient: by the point's line load and, where a parameter moves it, by the force of the mesh, on which mean friction and bulk
/// temperature depend.
/// @param value  of a film, under the point's line load
template <class Value>
SmoothValue value_at(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene, double slope, const Value& value) {
  SmoothValue found{value(film_of(term, scene)), {}};
  const LoadedCycle& cycle = scene.cycle;
  const LoadedPosition& position = cycle.positions[static_cast<std::size_t>(candidate.position)];
  if (position.line_load_derivative.cols() == 0) return found;
  found.gradient = slope * position.line_load_derivative.row(candidate.other).transpose();
  if (cycle.force_derivative.size() != found.gradient.size() || cycle.force_derivative.isZero(0.0)) return found;
  const double step = 1e-5 * cycle.force;  // its square and round-off over it are below 1e-9 of powers of the force
  const double by_force = (value(film_under(cycle.force + step, term, scene)) - value(film_under(cycle.force - step, term, scene))) / (2.0 * step);
  found.gradient += by_force * cycle.force_derivative.transpose();
  return found;
}

LocalTemperature temperature_at(const Film& film, const LoadedScene& scene, std::size_t position, Eigen::Index point) {
  return local_temperature(scene.model.pair, scene.model.contact_modulus, scene.model.positions[position].points[static_cast<std::size_t>(point)],
                           scene.cycle.positions[position].load.line_load[point], film.condition);
}

/// One temperature of all points.
CandidateValues temperatures(const ObjectiveTerm& term, const LoadedScene& scene, double LocalTemperature::*which) {
  const Film film = film_of(term, scene);
  CandidateValues values;
  for (std::size_t i = 0; i < scene.model.positions.size(); ++i) {
    const Eigen::Index points = scene.cycle.positions[i].load.line_load.size();
    for (Eigen::Index j = 0; j < points; ++j) {
      values.push_back({{static_cast<int>(i), static_cast<int>(j)}, temperature_at(film, scene, i, j).*which});
    }
  }
  return values;
}

SmoothValue temperature_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene, double LocalTemperature::*which) {
  const auto at = [&](const Film& film) { return temperature_at(film, scene, static_cast<std::size_t>(candidate.position), candidate.other); };
  return value_at(term, candidate, scene, at(film_of(term, scene)).slope, [&](const Film& film) { return at(film).*which; });
}

}  // namespace

CandidateValues contact_damages(const ObjectiveTerm& term, const LoadedScene& scene) {
  const PerGear<const SnCurve*> curve = contact_curves(term, scene);
  CandidateValues values;
  for (std::size_t i = 0; i < scene.model.positions.size(); ++i) {
    for (const Member m : both_gears) {
      if (curve[m] == nullptr) continue;
      const Eigen::VectorXd damage = contact_damage(scene.model, scene.spectrum, m, *curve[m], i);
      for (Eigen::Index j = 0; j < damage.size(); ++j) values.push_back({{static_cast<int>(i), number(j, m)}, damage[j]});
    }
  }
  return values;
}

SmoothValue contact_damage_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const Member m = member_of(candidate);
  const DamageSum sum = contact_damage_at(scene.model, scene.spectrum, m, *contact_curves(term, scene)[m],
                                          static_cast<std::size_t>(candidate.position), candidate.other / 2);
  return smooth(sum.value, sum.gradient);
}

CandidateValues root_damages(const ObjectiveTerm& term, const LoadedScene& scene) {
  const PerGear<const SnCurve*> curve = root_curves(term, scene);
  CandidateValues values;
  for (const Member m : both_gears) {
    if (curve[m] == nullptr) continue;
    const Eigen::VectorXd damage = root_damage(scene.model, scene.spectrum, m, *curve[m], fillets_of(scene, m));
    for (Eigen::Index p = 0; p < damage.size(); ++p) values.push_back({{-1, number(p, m)}, damage[p]});
  }
  return values;
}

SmoothValue root_damage_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const Member m = member_of(candidate);
  const DamageSum sum = root_damage_at(scene.model, scene.spectrum, m, *root_curves(term, scene)[m], fillets_of(scene, m), candidate.other / 2);
  return smooth(sum.value, sum.gradient);
}

CandidateValues loss_factors(const ObjectiveTerm&, const LoadedScene& scene) {
  return {{whole_output, local_loss_factor(scene.model, scene.cycle).value}};
}

SmoothValue loss_factor_of(const ObjectiveTerm&, const PeakCandidate&, const LoadedScene& scene) {
  const CycleNumber factor = local_loss_factor(scene.model, scene.cycle);
  return smooth(factor.value, factor.gradient);
}

CandidateValues film_ratios(const ObjectiveTerm& term, const LoadedScene& scene) {
  const Film film = film_of(term, scene);
  CandidateValues values;
  for (std::size_t i = 0; i < scene.model.positions.size(); ++i) {
    const Eigen::VectorXd& load = scene.cycle.positions[i].load.line_load;
    for (Eigen::Index j = 0; j < load.size(); ++j) {
      const ContactPoint& point = scene.model.positions[i].points[static_cast<std::size_t>(j)];
      const LocalFilm local = local_film(scene.model.pair, scene.model.contact_modulus, point, load[j], film.lubricant, film.condition);
      if (!std::isnan(local.ratio)) values.push_back({{static_cast<int>(i), static_cast<int>(j)}, local.ratio});
    }
  }
  return values;
}

SmoothValue film_ratio_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const auto i = static_cast<std::size_t>(candidate.position);
  // A point that has lost its load borders on a thick film: 1e-3 N/mm, with which lambda is three times that of 4 N/mm.
  constexpr double least_load = 1e-3;
  const double load = std::max(least_load, scene.cycle.positions[i].load.line_load[candidate.other]);
  const ContactPoint& point = scene.model.positions[i].points[static_cast<std::size_t>(candidate.other)];
  const auto at = [&](const Film& film) {
    return local_film(scene.model.pair, scene.model.contact_modulus, point, load, film.lubricant, film.condition);
  };
  return value_at(term, candidate, scene, at(film_of(term, scene)).slope, [&](const Film& film) { return at(film).ratio; });
}

CandidateValues flash_temperatures(const ObjectiveTerm& term, const LoadedScene& scene) {
  return temperatures(term, scene, &LocalTemperature::flash);
}

SmoothValue flash_temperature_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  return temperature_of(term, candidate, scene, &LocalTemperature::flash);
}

CandidateValues contact_temperatures(const ObjectiveTerm& term, const LoadedScene& scene) {
  return temperatures(term, scene, &LocalTemperature::contact);
}

SmoothValue contact_temperature_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  return temperature_of(term, candidate, scene, &LocalTemperature::contact);
}

}  // namespace flankwright
