#include "core/effects/effect_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace flankwright {

namespace {

std::string percent(double share) {
  std::ostringstream out;
  out.precision(2);
  out << 100.0 * share << " %";
  return out.str();
}

const Effect* effect_named(std::string_view name) {
  const EffectList& all = registered_effects();
  const auto found = std::ranges::find(all, name, [](const Effect* e) { return e->name(); });
  return found == all.end() ? nullptr : *found;
}

}  // namespace

bool changes_mesh(std::string_view name) {
  const Effect* effect = effect_named(name);
  return effect && effect->stage() != EffectStage::Unloaded && effect->stage() != EffectStage::Roots;
}

bool may_be_dropped(std::string_view name) {
  const Effect* effect = effect_named(name);
  const bool free_of_cost = effect && (effect->stage() == EffectStage::Condition || effect->stage() == EffectStage::Body);
  return changes_mesh(name) && effect->listed() && !free_of_cost;
}

EffectInfluence EffectInfluence::between(const CycleOutputs& with, const CycleOutputs& without) {
  EffectInfluence influence;
  influence.te_mean = with.te_mean - without.te_mean;
  influence.te_peak_to_peak = with.te_peak_to_peak - without.te_peak_to_peak;
  influence.peak_contact_stress = with.peak_contact_stress - without.peak_contact_stress;
  influence.relative_stress = influence.peak_contact_stress / with.peak_contact_stress;
  influence.te_harmonic = 0.0;
  for (std::size_t k = 0; k < std::min(with.te_harmonics.size(), without.te_harmonics.size()); ++k) {
    influence.te_harmonic = std::max(influence.te_harmonic, std::abs(with.te_harmonics[k] - without.te_harmonics[k]));
  }
  const double variation = std::max(with.te_peak_to_peak, quiet * with.mean_approach);
  const std::array<std::pair<double, const char*>, 4> shares{{
      {std::abs(influence.te_mean) / with.mean_approach, "the mean deflection"},
      {std::abs(influence.te_peak_to_peak) / variation, "the transmission error's variation"},
      {influence.te_harmonic / variation, "a harmonic of the transmission error"},
      {std::abs(influence.relative_stress), "the peak contact stress"},
  }};
  const auto& largest = *std::ranges::max_element(shares, {}, [](const auto& share) { return share.first; });
  if (std::ranges::any_of(shares, [](const auto& share) { return std::isnan(share.first); })) return {};
  influence.share = largest.first;
  influence.largest_in = largest.second;
  return influence;
}

EffectDecisions within_budget(EffectDecisions decisions, std::vector<EffectSize> sizes, double budget) {
  std::erase_if(
      sizes, [&](const EffectSize& size) { return !may_be_dropped(size.name) || !is_on(decisions, size.name) || std::isnan(size.influence.share); });
  std::ranges::sort(sizes, {}, [](const EffectSize& size) { return std::pair(size.influence.share, size.name); });
  double spent = 0.0;
  for (const EffectSize& size : sizes) {
    if (!is_on(decisions, size.name)) continue;  // gone with what it needs
    if (spent + size.influence.share > budget) break;
    const std::string why = "size " + percent(size.influence.share) + " of " + size.influence.largest_in + ", below the budget of " + percent(budget);
    EffectDecisions rest = without(decisions, size.name, why);
    if (!mesh_effects(rest).make_compliant()) continue;
    decisions = std::move(rest);
    spent += size.influence.share;
  }
  return decisions;
}

}  // namespace flankwright
