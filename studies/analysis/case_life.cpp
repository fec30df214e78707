#include "studies/analysis/case_life.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "core/gear/both_gears.hpp"
#include "core/fidelity/cycle_error.hpp"
#include "core/rating/contact_temperature.hpp"
#include "core/rating/edge_contact_start.hpp"
#include "core/rating/film_thickness.hpp"
#include "core/rating/sliding_loss.hpp"
#include "studies/analysis/film_readings.hpp"

namespace flankwright::studies {

namespace {

void add_loss(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, CaseLife& of) {
  const CycleNumber factor = local_loss_factor(model, loaded.cycle);
  of.loss_factor = factor.value;
  const double speed = loaded.operation.speed;
  if (!(speed > 0.0)) return;
  constexpr double watt = 1e3;  // N mm/s
  of.power = loaded.torque * speed / watt;
  const std::optional<Oil> oil = oil_of(life, loaded.operation);
  if (!oil) return;
  const double force = loaded.cycle.force;
  const auto friction_under = [&](double of_mesh) {
    return schlenk_friction(model.pair, model.face_width, of_mesh, speed, *oil->lubricant, oil->temperature, oil->roughness);
  };
  of.friction = friction_under(force);
  of.loss_power = of.friction * of.loss_factor * of.power;
  if (factor.gradient.size() == 0) return;
  const auto friction_power = [&](double of_mesh) { return friction_under(of_mesh) * of.power * of_mesh / force; };  // the power is as the force
  const double step = 1e-5 * force;  // its square and round-off over it are below 1e-9 of powers of the force
  const double by_force = (friction_power(force + step) - friction_power(force - step)) / (2.0 * step);
  of.loss_power_gradient = of.friction * of.power * factor.gradient + of.loss_factor * by_force * loaded.cycle.force_derivative;
}

/// Takes the extremes of one cycle's points.
/// @param films, flashes  where the values at the points of each position are kept
void add_film_of(const MeshModel& model, const LoadedCycle& cycle, const Lubricant& lubricant, const FilmCondition& condition,
                 std::vector<Eigen::VectorXd>& films, std::vector<Eigen::VectorXd>& flashes, CaseLife& of) {
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const LoadedPosition& loaded = cycle.positions[i];
    const Eigen::Index points = loaded.peak_load.size();
    Eigen::VectorXd &flash = flashes.emplace_back(points), &film = films.emplace_back(points);
    for (Eigen::Index j = 0; j < points; ++j) {
      const LoadedPoint at = loaded_point(model.positions[i], loaded, j);
      film[j] = local_film(model.pair, model.contact_modulus, at, lubricant, condition).ratio;
      of.film = std::fmin(of.film, film[j]);
      const LocalTemperature local = local_temperature(model.pair, at, condition);
      if (!reaches_tip_edge(model.positions[i], loaded, static_cast<std::size_t>(j))) {
        of.film_of_flanks = std::fmin(of.film_of_flanks, film[j]);
        of.flank_temperature = std::fmax(of.flank_temperature, local.contact);
      }
      flash[j] = local.flash;
      if (std::islessequal(local.flash, of.flash_temperature)) continue;
      of.flash_temperature = local.flash;
      of.contact_temperature = local.contact;
      of.hottest_z = at.point.z;
      of.hottest_pinion_radius = at.point.pinion_radius;
    }
  }
}

/// Film and temperatures of all points, and their extremes between the positions.
void add_film(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, CaseLife& of) {
  const std::optional<FilmCondition> condition = film_condition_of(model, life, loaded.operation, loaded.cycle.force);
  if (!condition) return;
  of.film_friction = condition->friction;
  of.bulk_temperature = condition->bulk_temperature;
  add_film_of(model, loaded.cycle, *life.lubricant, *condition, of.film_at_points, of.flash, of);
  if (loaded.resolved.extreme_mesh && loaded.resolved.extreme_cycle.usable()) {
    std::vector<Eigen::VectorXd> films, flashes;  // of positions that are not shown
    add_film_of(*loaded.resolved.extreme_mesh, loaded.resolved.extreme_cycle, *life.lubricant, *condition, films, flashes, of);
  }
  of.micropitting_safety = of.film / life.permissible_film;
  if (of.contact_temperature > condition->oil_temperature)
    of.scuffing_safety = scuffing_safety(life.scuffing_temperature, of.contact_temperature, condition->oil_temperature);
  if (loaded.resolved.further.empty()) return;
  CaseLifeErrors& errors = of.errors;
  errors.film = of.film * of.film * loaded.resolved.further[FilmReadings::thinness].error();  // the change of 1/x is x^-2 times that of x
  errors.micropitting_safety = errors.film / life.permissible_film;
  errors.flash_temperature = errors.contact_temperature = loaded.resolved.further[FilmReadings::flash].error();
  errors.scuffing_safety = of.scuffing_safety * errors.contact_temperature / (of.contact_temperature - condition->oil_temperature);
}

/// From the same load case with half the points at every second position, by the rules of the cycle's own figures.
void add_loss_errors(const MeshModel& model, const LoadedResult& loaded, const CoarseCycle& coarse, CaseLife& of) {
  of.errors.loss_factor = mean_error(local_loss_factors(model, loaded.cycle), local_loss_factors(*coarse.mesh, coarse.cycle));
  of.errors.loss_power = of.friction * of.power * of.errors.loss_factor;
}

/// What a curve allows in a load case over a stress, as it acts.
double stress_safety(const std::optional<SnCurve>& curve, double cycles, double stress) {
  if (!curve) return not_given;
  return curve->stress_borne(cycles) / stress;
}

/// K_Hbeta and K_Halpha of a load case, each at least 1 as ISO 6336-1 demands: flanks better than perfect ones earn nothing. K_Halpha is what the whole of the deviations
/// has beside K_Hbeta. Where K_Hbeta would be below 1, it is at least that of the profile deviations alone, which a crowning shall not make up for.
struct FaceAndTransverse {
  double lead{not_given}, profile{not_given};  ///< NaN where they are not known
};

FaceAndTransverse at_least_one(const LoadFactors::Triple& of) {
  const auto clipped = [](double factor) { return factor < 1.0 ? 1.0 : factor; };  // NaN stays
  const double lead = clipped(of.lead), beside = clipped(of.combined / lead);
  return {lead, of.lead < 1.0 ? std::fmax(beside, of.profile) : beside};
}

/// Of a load case by stress or by line loads of the loaded contact; by ISO 6336-1, method C, where it has none.
FaceAndTransverse load_factors_of(const LoadedResult& loaded, bool from_contact, LoadFactors::Triple LoadFactors::*by) {
  if (from_contact) return at_least_one(loaded.rating->factors.*by);
  return at_least_one({.lead = loaded.iso.lead, .profile = not_given, .combined = loaded.iso.combined()});
}

void add_safety(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, CaseLife& of) {
  of.iso = iso_stress_numbers(model.pair, model.material, loaded.torque, model.face_width, life.rim_thickness);
  of.K_from_contact = loaded.rating.has_value() && !std::isnan(loaded.rating->factors.without_spikes.combined);
  const FaceAndTransverse of_flank = load_factors_of(loaded, of.K_from_contact, &LoadFactors::without_spikes);
  of.K_H = of_flank.lead * of_flank.profile;
  // A root bears the load; the stress of the contact also changes with its radius of curvature.
  const FaceAndTransverse of_root = load_factors_of(loaded, of.K_from_contact, &LoadFactors::line_load);
  of.K_F = of_root.profile * root_face_load_factor(model.pair, model.face_width, of_root.lead);
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
  if (coarse != nullptr) add_loss_errors(model, loaded, *coarse, of);
  return of;
}

}  // namespace flankwright::studies
