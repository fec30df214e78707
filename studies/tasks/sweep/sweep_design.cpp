#include "studies/tasks/sweep/sweep_design.hpp"

#include <algorithm>

namespace flankwright::studies {

namespace {

std::variant<SampleDesign, SensitivityDesign> make_design(const SweepTable& sweep) {
  const auto count = static_cast<int>(sweep.parameters.size());
  if (sweep.sampler == Sampler::Grid) {
    std::vector<int> levels;
    for (const SweepParameter& p : sweep.parameters) levels.push_back(p.distribution.levels());
    return SampleDesign(levels);
  }
  if (sweep.indices) return SensitivityDesign(sweep.sampler, sweep.samples, count, sweep.seed);
  return SampleDesign(sweep.sampler, sweep.samples, count, sweep.seed);
}

}  // namespace

SweepDesign::SweepDesign(const SweepTable& sweep) : parameters_(sweep.parameters), design_(make_design(sweep)), samples_(sweep.samples) {}

int SweepDesign::block_size() const {
  const auto* blocks = std::get_if<SensitivityDesign>(&design_);
  return blocks == nullptr ? 0 : blocks->block_size();
}

std::vector<double> SweepDesign::values(long long i) const {
  std::vector<double> values = std::visit([i](const auto& design) { return design.point(i); }, design_);
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = parameters_[j].distribution.quantile(values[j]);
  return values;
}

void set_swept(SweptCondition& condition, const SweepParameter& parameter, double value) {
  const SchemaKey& key = *study_keys().at(parameter.path);
  if (!parameter.pitch) return set_swept(condition, key, value);
  set_drawn_pitch(condition.scene.error[key.member], *parameter.pitch, value);
}

std::vector<SweptCondition> extreme_conditions(const Study& study) {
  constexpr double outer_share = 1e-6;  // beyond either end
  std::vector<SweptCondition> conditions;
  for (const SweepParameter& p : study.table<SweepTable>().parameters) {
    const SchemaKey& key = *study_keys().at(p.path);
    for (const double u : {outer_share, 1.0 - outer_share}) {
      const double value = p.distribution.quantile(u);
      if (!p.pitch && !is_in_range(key, value)) continue;
      conditions.push_back(SweptCondition::of(study));
      set_swept(conditions.back(), p, value);
    }
  }
  SweptCondition together = SweptCondition::of(study);
  for (const SweepParameter& p : study.table<SweepTable>().parameters) {
    const SchemaKey& key = *study_keys().at(p.path);
    const auto* parameter = std::get_if<ModificationParameter>(&key.store);
    const bool takes_back = parameter != nullptr && of_process(*parameter) != nullptr;  // a compensation: the least leaves most
    const double widest = p.distribution.widest(), held = takes_back ? key.range.low : std::clamp(widest, key.range.low, key.range.high);
    if (p.pitch) {
      set_swept(together, p, widest);
    } else if (is_in_range(key, held)) {
      set_swept(together, p, held);
    }
  }
  conditions.push_back(together);
  return conditions;
}

}  // namespace flankwright::studies
