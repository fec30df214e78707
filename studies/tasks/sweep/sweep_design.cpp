#include "studies/tasks/sweep/sweep_design.hpp"

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

}  // namespace flankwright::studies
