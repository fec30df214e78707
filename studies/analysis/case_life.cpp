#include "studies/analysis/case_life.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "core/gear/both_gears.hpp"
#include "core/fidelity/cycle_error.hpp"
#include "core/rating/contact_temperature.hpp"
#include "core/rating/film_thickness.hpp"
#include "core/rating/sliding_loss.hpp"

namespace flankwright::studies {

namespace {

/// The oil of a load case, as far as it is known.
struct Oil {
  const Lubricant* lubricant;
  double temperature, roughness;
};

std::optional<Oil> oil_of(const LifeModel& life, const LoadedResult& loaded) {
  if (!life.lubricant) return std::nullopt;
  const double temperature = std::isnan(loaded.operation.temperature) ? life.lubricant->temperature : loaded.operation.temperature;
  return Oil{&*life.lubricant, temperature, life.roughness};
}

/// Largest flash temperature, and the reciprocal of the least specific film thickness, at each position.
struct FilmCurves {
  std::vector<double> flash, thinness;
};

/// A position without a loaded point has neither.
FilmCurves film_curves(const MeshModel& model, const LoadedCycle& cycle, const Lubricant& lubricant, const FilmCondition& condition) {
  FilmCurves curves;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const Eigen::VectorXd& load = cycle.positions[i].load.line_load;
    double flash = 0.0, thinness = 0.0;
    for (Eigen::Index j = 0; j < load.size(); ++j) {
      const ContactPoint& point = model.positions[i].points[static_cast<std::size_t>(j)];
      flash = std::fmax(flash, local_temperature(model.pair, model.contact_modulus, point, load[j], condition).flash);
      thinness = std::fmax(thinness, 1.0 / local_film(model.pair, model.contact_modulus, point, load[j], lubricant, condition).ratio);
    }
    curves.flash.push_back(flash);
    curves.thinness.push_back(thinness);
  }
  return curves;
}

void add_loss(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, CaseLife& of) {
  of.loss_factor = local_loss_factor(model, loaded.cycle).value;
  const double speed = loaded.operation.speed;
  if (!(speed > 0.0)) return;
  constexpr double watt = 1e3;  // N mm/s
  of.power = loaded.torque * speed / watt;
  const std::optional<Oil> oil = oil_of(life, loaded);
  if (!oil) return;
  of.friction = schlenk_friction(model.pair, model.face_width, loaded.cycle.force, speed, *oil->lubricant, oil->temperature, oil->roughness);
  of.loss_power = of.friction * of.loss_factor * of.power;
}

FilmCondition condition_of_film(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, const Oil& oil) {
  const FilmCondition given{.speed = loaded.operation.speed,
                            .oil_temperature = oil.temperature,
                            .bulk_temperature = life.bulk_temperature,
                            .roughness = oil.roughness,
                            .overload = loaded.operation.overload()};
  return film_condition(model.pair, model.face_width, loaded.cycle.force, *oil.lubricant, given);
}

/// Film and temperatures of all points.
void add_film(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, CaseLife& of) {
  const std::optional<Oil> oil = oil_of(life, loaded);
  if (!oil || !(loaded.operation.speed > 0.0)) return;
  const FilmCondition condition = condition_of_film(model, life, loaded, *oil);
  of.film_friction = condition.friction;
  of.bulk_temperature = condition.bulk_temperature;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const Eigen::VectorXd& load = loaded.cycle.positions[i].load.line_load;
    Eigen::VectorXd &flash = of.flash.emplace_back(load.size()), &film = of.film_at_points.emplace_back(load.size());
    for (Eigen::Index j = 0; j < load.size(); ++j) {
      const ContactPoint& point = model.positions[i].points[static_cast<std::size_t>(j)];
      film[j] = local_film(model.pair, model.contact_modulus, point, load[j], *oil->lubricant, condition).ratio;
      of.film = std::fmin(of.film, film[j]);
      const LocalTemperature local = local_temperature(model.pair, model.contact_modulus, point, load[j], condition);
      flash[j] = local.flash;
      if (std::islessequal(local.flash, of.flash_temperature)) continue;
      of.flash_temperature = local.flash;
      of.contact_temperature = local.contact;
      of.hottest_z = point.z;
      of.hottest_pinion_radius = point.pinion_radius;
    }
  }
  of.micropitting_safety = of.film / life.permissible_film;
  if (of.contact_temperature > oil->temperature) {
    of.scuffing_safety = scuffing_safety(life.scuffing_temperature, of.contact_temperature, oil->temperature);
  }
}

/// From the same load case with half the points at every second position, by the rules of the cycle's own figures.
void add_errors(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, const CoarseCycle& coarse, CaseLife& of) {
  of.errors.loss_factor = mean_error(local_loss_factors(model, loaded.cycle), local_loss_factors(*coarse.mesh, coarse.cycle));
  of.errors.loss_power = of.friction * of.power * of.errors.loss_factor;
  const std::optional<Oil> oil = oil_of(life, loaded);
  if (!oil || !(loaded.operation.speed > 0.0)) return;
  const FilmCondition condition = condition_of_film(model, life, loaded, *oil);
  const FilmCurves fine = film_curves(model, loaded.cycle, *oil->lubricant, condition);
  const FilmCurves rough = film_curves(*coarse.mesh, coarse.cycle, *oil->lubricant, condition);
  of.errors.film = of.film * of.film * peak_error(fine.thinness, rough.thinness);  // the change of 1/x is x^-2 times that of x
  of.errors.micropitting_safety = of.errors.film / life.permissible_film;
  of.errors.flash_temperature = of.errors.contact_temperature = peak_error(fine.flash, rough.flash);
  of.errors.scuffing_safety = of.scuffing_safety * of.errors.contact_temperature / (of.contact_temperature - oil->temperature);
}

/// What a curve allows in a load case over a stress, as it acts.
double stress_safety(const std::optional<SnCurve>& curve, double cycles, double stress) {
  if (!curve) return not_given;
  return curve->stress_borne(cycles) / stress;
}

void add_safety(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, CaseLife& of) {
  of.iso = iso_stress_numbers(model.pair, model.material, loaded.torque, model.face_width, life.rim_thickness);
  of.K_from_contact = loaded.rating.has_value() && !std::isnan(loaded.rating->factors.without_spikes.combined);
  const double lead = of.K_from_contact ? loaded.rating->factors.without_spikes.lead : loaded.iso.lead;
  const double combined = of.K_from_contact ? loaded.rating->factors.without_spikes.combined : loaded.iso.combined();
  // ISO 6336-1: neither factor is below 1. A flank better than the perfect one earns nothing.
  const auto at_least_one = [](double factor) { return factor < 1.0 ? 1.0 : factor; };  // NaN stays
  const double K_Hbeta = at_least_one(lead), K_Halpha = at_least_one(combined / K_Hbeta);
  of.K_H = K_Hbeta * K_Halpha;
  of.K_F = K_Halpha * root_face_load_factor(model.pair, model.face_width, K_Hbeta);
  for (const Member m : both_gears) {
    const FatigueStrength& strength = life.strength[m];
    const double cycles = load_cycles(model.pair, m, loaded.operation);
    const Operation& under = loaded.operation;
    of.iso_contact[m] = of.iso.contact_stress(m, under.overload() * of.K_H);
    of.iso_root[m] = of.iso.root_stress(m, under.overload() * of.K_F);
    of.contact_safety[m] = stress_safety(strength.contact, cycles, under.contact_overload() * loaded.summary.peak_contact_stress);
    of.iso_contact_safety[m] = stress_safety(strength.contact, cycles, of.iso_contact[m]);
    const RootStressPeak& root = m == Member::Pinion ? loaded.summary.pinion_root_stress : loaded.summary.wheel_root_stress;
    of.root_safety[m] = stress_safety(strength.root, cycles, under.overload() * root.stress);
    of.iso_root_safety[m] = stress_safety(strength.root, cycles, of.iso_root[m]);
  }
}

}  // namespace

CaseLife case_life(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, const CoarseCycle* coarse) {
  CaseLife of;
  add_loss(model, life, loaded, of);
  add_film(model, life, loaded, of);
  add_safety(model, life, loaded, of);
  if (coarse != nullptr) add_errors(model, life, loaded, *coarse, of);
  return of;
}

}  // namespace flankwright::studies
