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

LoadedPoint point_of(const PeakCandidate& candidate, const LoadedScene& scene) {
  const auto i = static_cast<std::size_t>(candidate.position);
  return loaded_point(scene.model.positions[i], scene.cycle.positions[i], candidate.other);
}

/// A value at one point with its gradient: by the point's line load and pressure and, where a parameter moves it, by the force of the mesh, on which mean friction and
/// bulk temperature depend.
/// @param local  LocalFilm or LocalTemperature of a film, at the point
/// @param field  the member of it that is the value
template <class Local, class Field>
SmoothValue value_at(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene, const Local& local, Field field) {
  const auto here = local(film_of(term, scene));
  SmoothValue found{here.*field, {}};
  const LoadedCycle& cycle = scene.cycle;
  const LoadedPosition& position = cycle.positions[static_cast<std::size_t>(candidate.position)];
  if (position.line_load_derivative.cols() == 0) return found;
  found.gradient =
      (here.by_load * position.peak_load_derivative.row(candidate.other) + here.by_pressure * position.contact_stress_derivative.row(candidate.other))
          .transpose();
  if (cycle.force_derivative.size() != found.gradient.size() || cycle.force_derivative.isZero(0.0)) return found;
  const double step = 1e-5 * cycle.force;  // its square and round-off over it are below 1e-9 of powers of the force
  const double by_force =
      (local(film_under(cycle.force + step, term, scene)).*field - local(film_under(cycle.force - step, term, scene)).*field) / (2.0 * step);
  found.gradient += by_force * cycle.force_derivative.transpose();
  return found;
}

LocalTemperature temperature_at(const LoadedPoint& at, const Film& film, const MeshModel& model) {
  return local_temperature(model.pair, at, film.condition);
}

LocalFilm film_at(const LoadedPoint& at, const Film& film, const MeshModel& model) {
  return local_film(model.pair, model.contact_modulus, at, film.lubricant, film.condition);
}

/// A number of every point that has it.
template <class Number>
CandidateValues of_points(const LoadedScene& scene, const Number& number_at) {
  CandidateValues values;
  for (std::size_t i = 0; i < scene.model.positions.size(); ++i) {
    for (Eigen::Index j = 0; j < scene.cycle.positions[i].peak_load.size(); ++j) {
      const PeakCandidate candidate{static_cast<int>(i), static_cast<int>(j)};
      const double value = number_at(point_of(candidate, scene));
      if (!std::isnan(value)) values.push_back({candidate, value});
    }
  }
  return values;
}

/// One temperature of all points.
CandidateValues temperatures(const ObjectiveTerm& term, const LoadedScene& scene, double LocalTemperature::*which) {
  return of_points(scene, [&, film = film_of(term, scene)](const LoadedPoint& at) { return temperature_at(at, film, scene.model).*which; });
}

SmoothValue temperature_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene, double LocalTemperature::*which) {
  const LoadedPoint at = point_of(candidate, scene);
  return value_at(
      term, candidate, scene, [&](const Film& film) { return temperature_at(at, film, scene.model); }, which);
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
  return of_points(scene, [&, film = film_of(term, scene)](const LoadedPoint& at) { return film_at(at, film, scene.model).ratio; });
}

SmoothValue film_ratio_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  // A point that has lost its load borders on a thick film: 1e-3 N/mm, with which lambda is three times that of 4 N/mm.
  constexpr double least_load = 1e-3;
  const LoadedPoint here = point_of(candidate, scene);
  const LoadedPoint at = here.line_load > least_load ? here : flank_point(here.point, scene.model.contact_modulus, least_load);
  return value_at(
      term, candidate, scene, [&](const Film& film) { return film_at(at, film, scene.model); }, &LocalFilm::ratio);
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
