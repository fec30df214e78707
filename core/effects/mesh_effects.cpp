#include "core/effects/mesh_effects.hpp"

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"

namespace flankwright {

namespace {

EffectList::const_iterator find_by_name(const EffectList& effects, std::string_view name) {
  return std::ranges::find(effects, name, [](const Effect* effect) { return effect->name(); });
}

/// One that needs another may be needed by a third.
EffectList without_dangling(EffectList effects) {
  const auto dangles = [](const EffectList& all) {
    return std::ranges::find_if(all, [&](const Effect* e) { return !e->needs().empty() && find_by_name(all, e->needs()) == all.end(); });
  };
  for (auto lost = dangles(effects); lost != effects.end(); lost = dangles(effects)) effects.erase(lost);
  return effects;
}

}  // namespace

MeshEffects::MeshEffects(EffectList on)
    : on_(without_dangling(in_order_of_flow(std::move(on)))), costs_(std::make_shared<std::vector<Cost>>(on_.size())) {}

MeshEffects MeshEffects::all_but(std::initializer_list<std::string_view> names) {
  EffectList left = registered_effects();
  for (const std::string_view name : names) {
    const auto found = find_by_name(left, name);
    if (found == left.end()) throw InvalidInput("effects", std::string(name), "one of the effect names, once");
    left.erase(found);
  }
  return MeshEffects(std::move(left));
}

bool MeshEffects::has(std::string_view name) const { return find_by_name(on_, name) != on_.end(); }

bool MeshEffects::make_compliant() const { return std::ranges::any_of(on_, &Effect::makes_compliant); }

void MeshEffects::act(EffectStage stage, MeshBuilder& builder) const {
  for (std::size_t i = 0; i < on_.size(); ++i) {
    if (on_[i]->stage() != stage) continue;
    const Stopwatch clock;
    on_[i]->act(builder);
    (*costs_)[i].seconds += clock.seconds();
    ++(*costs_)[i].calls;
  }
}

std::int64_t MeshEffects::calls(std::string_view name) const {
  const auto found = find_by_name(on_, name);
  return found == on_.end() ? 0 : (*costs_)[static_cast<std::size_t>(found - on_.begin())].calls.load();
}

double MeshEffects::seconds(std::string_view name) const {
  const auto found = find_by_name(on_, name);
  return found == on_.end() ? 0.0 : (*costs_)[static_cast<std::size_t>(found - on_.begin())].seconds.load();
}

}  // namespace flankwright
