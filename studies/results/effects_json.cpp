#include "studies/results/effects_json.hpp"

namespace flankwright::studies {

namespace {

/// Of a size that was left out; empty of another.
std::string why_no_size(const StudyResults& results, const SizeInStudy& size) {
  const bool rigid_bodies = results.structures.pair == nullptr || results.structures.pair->knows_rigid_bodies();
  if (size.size.name != "gear_body_compliance" || rigid_bodies) return "";
  return "takes finite elements of both gears with rigid bodies: fidelity.effect_sizes = \"exact\" solves them";
}

Json size_json(const StudyResults& results, const SizeInStudy* size) {
  if (size == nullptr) return nullptr;
  const EffectInfluence& influence = size->size.influence;
  Json json{{"scene", size->scene},
            {"torque_Nm", in_Nm(size->torque)},
            {"te_mean_change_um", in_um(influence.te_mean)},
            {"te_peak_to_peak_change_um", in_um(influence.te_peak_to_peak)},
            {"peak_contact_stress_change_MPa", influence.peak_contact_stress},
            {"peak_contact_stress_change_percent", percent * influence.relative_stress},
            {"share_percent", percent * influence.share},
            {"largest_in", influence.largest_in},
            {"seconds", size->size.seconds}};
  if (const std::string why = why_no_size(results, *size); !why.empty()) json["why_no_size"] = why;
  if (size->positions > 0) json["positions"] = {{"solved", size->positions}, {"solved_again", size->solved_again}};
  return json;
}

}  // namespace

Json effects_json(const StudyResults& results) {
  return list(results.effects, [&](const EffectDecision& effect) -> Json {
    return {{"name", effect.name},
            {"on", effect.on},
            {"why", effect.why},
            {"seconds", effect.seconds},
            {"estimate", size_json(results, size_of(results.effect_sizes.estimated, effect.name))},
            {"exact", size_json(results, size_of(results.effect_sizes.exact, effect.name))}};
  });
}

}  // namespace flankwright::studies
