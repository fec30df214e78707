#include "optimize/design/outputs/utilisation_outputs.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/gear/both_gears.hpp"
#include "core/base/error.hpp"

namespace flankwright {

namespace {

const LoadedPosition& at(const LoadedScene& scene, int position) { return scene.cycle.positions[static_cast<std::size_t>(position)]; }

/// The stress of the nominal load that a gear bears in a load case; infinite where the study gives it no curve [MPa].
/// @param overload  of the stress under the load's factors
double borne(const std::optional<SnCurve>& curve, const LoadedScene& scene, Member member, double overload) {
  if (!curve) return std::numeric_limits<double>::infinity();
  const double cycles = scene.operation != nullptr ? load_cycles(scene.model.pair, member, *scene.operation) : not_given;
  return curve->of_stress_times(overload).stress_borne(cycles);
}

/// Of both gears.
PerGear<double> borne(const ObjectiveTerm& term, const LoadedScene& scene, std::optional<SnCurve> FatigueStrength::*kind, double overload,
                      const char* key) {
  PerGear<double> stress{not_given, not_given};
  for (const Member m : both_gears) {
    stress[m] = scene.life != nullptr ? borne(scene.life->strength[m].*kind, scene, m, overload) : std::numeric_limits<double>::infinity();
  }
  if (std::isinf(stress.pinion) && std::isinf(stress.wheel)) throw InvalidInput(term.name, "no S-N curve", key);
  return stress;
}

double borne_by_flanks(const ObjectiveTerm& term, const LoadedScene& scene) {
  const double overload = scene.operation != nullptr ? scene.operation->contact_overload() : 1.0;
  const PerGear<double> stress = borne(term, scene, &FatigueStrength::contact, overload, "material.contact_endurance_limit");
  return std::min(stress.pinion, stress.wheel);
}

PerGear<double> borne_by_fillets(const ObjectiveTerm& term, const LoadedScene& scene) {
  const double overload = scene.operation != nullptr ? scene.operation->overload() : 1.0;
  return borne(term, scene, &FatigueStrength::root, overload, "material.root_endurance_limit");
}

double permissible_film(const ObjectiveTerm& term, const LoadedScene& scene) {
  if (scene.life == nullptr || std::isnan(scene.life->permissible_film))
    throw InvalidInput(term.name, "no permissible film", "lubricant.permissible_film");
  return scene.life->permissible_film;
}

/// theta_oil and theta_S.
struct ScuffingRange {
  double oil, limit;
  double utilisation(double contact) const { return (contact - oil) / (limit - oil); }
};

ScuffingRange scuffing_range(const ObjectiveTerm& term, const LoadedScene& scene) {
  if (scene.life == nullptr || !scene.life->lubricant || std::isnan(scene.life->scuffing_temperature))
    throw InvalidInput(term.name, "no scuffing temperature", "lubricant.scuffing_temperature");
  const double of_case = scene.operation != nullptr ? scene.operation->temperature : not_given;
  return {std::isnan(of_case) ? scene.life->lubricant->temperature : of_case, scene.life->scuffing_temperature};
}

SmoothValue scaled(double value, double factor, const Eigen::RowVectorXd& gradient) { return {factor * value, factor * gradient.transpose()}; }

}  // namespace

CandidateValues contact_utilisations(const ObjectiveTerm& term, const LoadedScene& scene) {
  const double limit = borne_by_flanks(term, scene);
  CandidateValues values;
  for (int i = 0; i < std::ssize(scene.cycle.positions); ++i) {
    const Eigen::VectorXd& stress = at(scene, i).contact_stress;
    for (Eigen::Index j = 0; j < stress.size(); ++j) values.push_back({{i, static_cast<int>(j)}, stress[j] / limit});
  }
  return values;
}

SmoothValue contact_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const LoadedPosition& position = at(scene, candidate.position);
  const double per_stress = 1.0 / borne_by_flanks(term, scene), stress = position.contact_stress[candidate.other];
  if (position.contact_stress_derivative.cols() == 0) return {per_stress * stress, {}};
  return scaled(stress, per_stress, position.contact_stress_derivative.row(candidate.other));
}

CandidateValues root_utilisations(const ObjectiveTerm& term, const LoadedScene& scene) {
  const PerGear<double> limit = borne_by_fillets(term, scene);
  CandidateValues values;
  for (int i = 0; i < std::ssize(scene.cycle.positions); ++i) {
    const std::vector<RootStation>& stations = scene.model.positions[static_cast<std::size_t>(i)].root_stress.stations;
    const Eigen::VectorXd& stress = at(scene, i).root_stress;
    for (Eigen::Index p = 0; p < stress.size(); ++p)
      values.push_back({{i, static_cast<int>(p)}, stress[p] / limit[stations[static_cast<std::size_t>(p)].member]});
  }
  return values;
}

SmoothValue root_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const MeshPosition& place = scene.model.positions[static_cast<std::size_t>(candidate.position)];
  const LoadedPosition& position = at(scene, candidate.position);
  const Member member = place.root_stress.stations[static_cast<std::size_t>(candidate.other)].member;
  const double per_stress = 1.0 / borne_by_fillets(term, scene)[member], stress = position.root_stress[candidate.other];
  if (position.line_load_derivative.cols() == 0) return {per_stress * stress, {}};
  return scaled(stress, per_stress, root_stress_derivative(place, position, candidate.other));
}

CandidateValues micropitting_utilisations(const ObjectiveTerm& term, const LoadedScene& scene) {
  const double permissible = permissible_film(term, scene);
  CandidateValues values = film_ratios(term, scene);
  for (auto& [candidate, value] : values) value = permissible / value;
  return values;
}

SmoothValue micropitting_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const double permissible = permissible_film(term, scene);
  const SmoothValue film = film_ratio_of(term, candidate, scene);
  return {permissible / film.value, -permissible / (film.value * film.value) * film.gradient};
}

CandidateValues scuffing_utilisations(const ObjectiveTerm& term, const LoadedScene& scene) {
  const ScuffingRange range = scuffing_range(term, scene);
  CandidateValues values = contact_temperatures(term, scene);
  for (auto& [candidate, value] : values) value = range.utilisation(value);
  return values;
}

SmoothValue scuffing_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene) {
  const ScuffingRange range = scuffing_range(term, scene);
  const SmoothValue contact = contact_temperature_of(term, candidate, scene);
  return {range.utilisation(contact.value), contact.gradient / (range.limit - range.oil)};
}

}  // namespace flankwright
