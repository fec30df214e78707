#include "studies/results/life_json.hpp"

#include <cmath>

#include "core/gear/both_gears.hpp"
#include "optimize/design/outputs/scene_outputs.hpp"
#include "studies/analysis/life_quantities.hpp"
#include "studies/results/gradient_rows.hpp"
#include "studies/results/gradients_json.hpp"

namespace flankwright::studies {

namespace {

Json sn_curve_json(const std::optional<SnCurve>& curve) {
  if (!curve) return nullptr;
  return {{"limit_MPa", curve->limit},
          {"knee_cycles", curve->knee},
          {"exponent", curve->exponent},
          {"exponent_beyond", curve->exponent_beyond},
          {"static_limit_MPa", std::isfinite(curve->static_limit) ? Json(curve->static_limit) : Json()}};
}

/// A named material with the numbers of its table, and where the S-N curves have theirs from.
Json grade_json(const LifeTable& life, Member m) {
  const MaterialGrade& grade = *life.grade[m];
  const auto source = [](const GivenSnCurve& given) { return std::isnan(given.limit) ? "ISO 6336-5" : "endurance limit of the study"; };
  return {{"kind", to_string(grade.kind)},
          {"quality", to_string(grade.quality)},
          {"hardness", grade.hardness},
          {"hardness_scale", hardness_scale(grade.kind)},
          {"core_hardness_HRC", grade.core_hardness},
          {"sigma_Hlim_MPa", contact_stress_number(grade)},
          {"sigma_Flim_MPa", root_stress_number(grade)},
          {"contact_limit_from", source(life.contact[m])},
          {"root_limit_from", source(life.root[m])}};
}

Json gear_case_json(const CaseLife& of, Member m) {
  Json json = Json::object();
  for (const LifeQuantity& quantity : life_quantities()) {
    if (quantity.of_gears != nullptr) json[std::string(quantity.key)] = quantity.of(of, m);
  }
  json.update({{"Y_F", of.iso.Y_F[m]}, {"Y_S", of.iso.Y_S[m]}, {"Y_B", of.iso.Y_B[m]}});
  return json;
}

/// Derivatives at the point and position of each quantity of the pair; null by parameters that move the points of contact.
Json gradients_of(const StudyResults& results, const CaseLife& of) {
  const LoadedResult& loaded = results.loaded[of.loaded];
  const MeshModel& model = results.models[loaded.model];
  const GradientRows outside(results.study.gradients);
  const LoadedScene scene{model, loaded.cycle, &loaded.operation, results.life_model.get()};
  const std::vector<Eigen::Index> moving = moving_among(model.placement.gap, outside.parameters());
  Json json = Json::object();
  const auto fixed = [&](Eigen::RowVectorXd gradient) {
    for (const Eigen::Index p : moving) gradient[p] = not_given;
    return outside.row(gradient);
  };
  for (const LifeQuantity& quantity : life_quantities()) {
    if (quantity.of_pair == nullptr || (!quantity.output && quantity.gradient == nullptr)) continue;
    const std::string key(quantity.key);
    json[key] = nullptr;
    if (std::isnan(of.*quantity.of_pair)) continue;
    if (quantity.gradient != nullptr) {
      json[key] = fixed(of.*quantity.gradient);
      continue;
    }
    const ObjectiveTerm term{.output = *quantity.output, .name = key, .reciprocal = quantity.is_reciprocal};
    const std::optional<LoadedScene> between = between_positions(term, scene, loaded.resolved);
    const LoadedScene& at = between ? *between : scene;
    json[key] = fixed(candidate_value(term, leading_candidates(term, at, 0.0, 1).front(), at).gradient.transpose());
  }
  return json;
}

Json life_case_json(const StudyResults& results, const CaseLife& of) {
  const LoadedResult& loaded = results.loaded[of.loaded];
  constexpr double hour = 3600.0;
  Json json{{"scene", loaded.scene},
            {"design", loaded.design},
            {"bin", loaded.bin < 0 ? Json() : Json(loaded.bin)},
            {"torque_Nm", in_Nm(loaded.torque)},
            {"speed_rpm", loaded.operation.speed * 60.0 / (2.0 * units::pi)},
            {"hours", loaded.operation.duration / hour},
            {"cycles", loaded.operation.revolutions},
            {"peak_contact_stress_MPa", loaded.summary.peak_contact_stress},
            {"peak_root_stress_MPa", loaded.summary.peak_root_stress}};
  for (const LifeQuantity& quantity : life_quantities()) {
    if (quantity.of_pair == nullptr) continue;
    const std::string key(quantity.key);
    json[key] = of.*quantity.of_pair;
    if (quantity.error != nullptr) json[key + "_error"] = of.errors.*quantity.error;
  }
  json["iso6336"] = {{"K_from", of.K_from_contact ? "loaded contact" : "ISO 6336-1, method C"},
                     {"K_A", loaded.operation.application_factor},
                     {"K_v", loaded.operation.dynamic_factor},
                     {"K_H", of.K_H},
                     {"K_F", of.K_F},
                     {"Z_H", of.iso.Z_H},
                     {"Z_E", of.iso.Z_E},
                     {"Z_eps", of.iso.Z_eps},
                     {"Z_beta", of.iso.Z_beta},
                     {"Y_beta", of.iso.Y_beta},
                     {"contact_edition", contact_stress_edition},
                     {"root_edition", root_stress_edition},
                     {"sigma_H0_MPa", of.iso.contact}};
  for (const Member m : both_gears) json[name_of(m)] = gear_case_json(of, m);
  if (has_gradients(results) && loaded.cycle.usable()) json["gradients"] = gradients_of(results, of);
  return json;
}

/// Derivatives of a damage by the parameters of the study; null by those that move the points of contact.
Json damage_gradient(const StudyResults& results, const SpectrumLife& spectrum, const DamagedPoint& point) {
  const LoadedResult& loaded = results.loaded[results.life->cases[spectrum.cases.front()].loaded];
  const GradientRows outside(results.study.gradients);
  Eigen::RowVectorXd gradient = point.gradient;
  for (const Eigen::Index p : moving_among(results.models[loaded.model].placement.gap, outside.parameters())) gradient[p] = not_given;
  return outside.row(gradient);
}

Json damaged_point_json(const StudyResults& results, const SpectrumLife& spectrum, const std::optional<DamagedPoint>& point) {
  if (!point) return nullptr;
  Json json{
      {"damage", point->damage}, {"damage_error", point->damage_error}, {"z_mm", point->z}, {"exceeds_static_limit", point->exceeds_static_limit}};
  if (!std::isnan(point->radius)) json["radius_mm"] = point->radius;
  if (!std::isnan(point->along)) json["along_fillet"] = point->along;
  if (has_gradients(results) && point->gradient.size() > 0) json["gradient"] = damage_gradient(results, spectrum, *point);
  return json;
}

Json spectrum_json(const StudyResults& results, const SpectrumLife& spectrum) {
  Json json{{"scene", spectrum.scene}, {"design", spectrum.design}, {"cases", spectrum.cases}};
  for (const Member m : both_gears)
    json[name_of(m)] = {{"contact", damaged_point_json(results, spectrum, spectrum.contact[m])},
                        {"root", damaged_point_json(results, spectrum, spectrum.root[m])}};
  if (spectrum.map.empty()) return json;
  const auto column = [&](const auto& of) { return list(spectrum.map, of); };
  json["map"] = {{"phase", column([](const FlankDamage& p) { return p.phase; })},
                 {"tooth", column([](const FlankDamage& p) { return p.tooth; })},
                 {"z_mm", column([](const FlankDamage& p) { return p.z; })},
                 {"pinion_radius_mm", column([](const FlankDamage& p) { return p.pinion_radius; })},
                 {"wheel_radius_mm", column([](const FlankDamage& p) { return p.wheel_radius; })},
                 {"pinion_damage", column([](const FlankDamage& p) { return p.damage.pinion; })},
                 {"wheel_damage", column([](const FlankDamage& p) { return p.damage.wheel; })}};
  return json;
}

/// Hours and load cycles are those of all repetitions.
Json signal_json(const CountedSignal& signal) {
  constexpr double hour = 3600.0;
  const bool is_rainflow = signal.counting == LoadCounting::Rainflow;
  const auto hours = [&](double of_once) { return is_rainflow ? not_given : signal.repeats * of_once / hour; };
  double cycles = 0.0;
  for (const LoadLevel& level : signal.count.levels) cycles += signal.repeats * level.cycles;
  return {{"file", signal.file},
          {"counting", is_rainflow ? "rainflow" : "time_at_level"},
          {"samples", signal.samples},
          {"signal_seconds", signal.duration},
          {"repeats", signal.repeats},
          {"hours", signal.repeats * signal.duration / hour},
          {"idle_hours", hours(signal.count.idle_duration)},
          {"reversed_hours", hours(signal.count.reversed_duration)},
          {"standing_hours", hours(signal.count.standing_duration)},
          {"least_torque_Nm", in_Nm(signal.least_torque)},
          {"largest_torque_Nm", in_Nm(signal.largest_torque)},
          {"cycles", cycles}};
}

}  // namespace

Json life_json(const StudyResults& results) {
  const StudyLife& life = *results.life;
  Json json{{"ohlendorf_loss_factor", life.ohlendorf}};
  for (const Member m : both_gears) {
    json[name_of(m)] = {{"meshes_per_revolution", results.study.life.meshes_per_revolution[m]},
                        {"contact_sn_curve", sn_curve_json(results.life_model->strength[m].contact)},
                        {"root_sn_curve", sn_curve_json(results.life_model->strength[m].root)}};
    if (results.study.life.grade[m]) json[name_of(m)]["strength"] = grade_json(results.study.life, m);
  }
  if (results.study.signal) json["signal"] = signal_json(*results.study.signal);
  json["cases"] = list(life.cases, [&](const CaseLife& of) { return life_case_json(results, of); });
  json["spectra"] = list(life.spectra, [&](const SpectrumLife& spectrum) { return spectrum_json(results, spectrum); });
  return json;
}

}  // namespace flankwright::studies
