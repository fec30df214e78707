#include "studies/study_file/left_out_effects.hpp"

#include <cmath>

#include "core/effects/decision.hpp"
#include "studies/study_file/sweep_value.hpp"

namespace flankwright::studies {

namespace {

/// A value of a key that is not its default of 0, in the unit of a bare number.
double some_value(const SchemaKey& key) { return is_in_range(key, 1.0) ? 1.0 : key.range.high; }

}  // namespace

void require_effect_of(StudyReading& reading, const std::string& asked_at, const std::string& path) {
  const SchemaKey& key = *study_keys().at(path);
  const Fidelity& fidelity = reading.builder.study.fidelity;
  if (fidelity.automatic_effects || !is_sweepable(key) || !is_in_range(key, some_value(key))) return;
  SweptCondition only{};
  set_swept(only, key, some_value(key));
  for (const std::string& effect : effects_missing_for(chosen_effects({}, fidelity.effects), only.flanks())) {
    reading.refuse_key(asked_at, "has no effect: fidelity.effects leaves \"" + effect + "\" out. Allowed is \"auto\" there, or a list with it");
  }
}

}  // namespace flankwright::studies
