#include "core/compliance/fitted/correction_grid.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

template <class Value>
void sort_unique(std::vector<Value>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

/// Lagrange's polynomials through the nodes, at x.
std::vector<double> cardinal_polynomials(const std::vector<double>& nodes, double x) {
  std::vector<double> weights(nodes.size(), 1.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != i) weights[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
    }
  }
  return weights;
}

std::vector<double> mirrored(const KernelForm& form, const std::vector<double>& coefficients) {
  std::vector<double> result = coefficients;
  // The warp of the axis, counted from the other end.
  result[0] = -coefficients[0];
  std::swap(result[1], result[3]);
  std::swap(result[2], result[4]);
  auto at = result.begin() + KernelForm::kWarpCoefficients;
  for (const Kernel& kernel : form.kernels) {
    for (const EndPolynomial* polynomial : {&kernel.amplitude, &kernel.axial, &kernel.radial}) {
      at += polynomial->middle;
      for (const int powers : polynomial->end) {
        std::swap_ranges(at, at + powers, at + powers);
        at += 2 * powers;
      }
    }
    if (kernel.couples_teeth()) {
      ++at;
      *at = -*at;
      ++at;
    }
  }
  return result;
}

CorrectionGrid::CorrectionGrid(std::vector<CorrectionEntry> entries) : entries_(std::move(entries)) {
  const auto wrong = [](const std::string& what) {
    throw InvalidInput("library", what, "an entry for each combination of its teeth, helix angles from 0 and profile shifts");
  };
  if (entries_.empty()) wrong("no entries");
  for (const CorrectionEntry& entry : entries_) {
    entry.gear.validate();
    if (static_cast<int>(entry.coefficients.size()) != KernelForm::correction().count()) wrong("coefficients of another form");
    teeth_.push_back(entry.gear.teeth);
    helix_angles_.push_back(entry.gear.helix_angle);
    profile_shifts_.push_back(entry.gear.profile_shift);
  }
  sort_unique(teeth_);
  sort_unique(helix_angles_);
  sort_unique(profile_shifts_);
  const auto key = [](const CorrectionEntry& entry) { return std::tuple(entry.gear.teeth, entry.gear.helix_angle, entry.gear.profile_shift); };
  std::ranges::sort(entries_, {}, key);
  if (std::ranges::adjacent_find(entries_, {}, key) != entries_.end()) wrong("an entry twice");
  if (entries_.size() != teeth_.size() * helix_angles_.size() * profile_shifts_.size()) wrong("an entry missing");
  if (helix_angles_.front() != 0) wrong("no spur gears");
}

GearProportions CorrectionGrid::nearest(GearProportions gear) const {
  gear.teeth = std::clamp(gear.teeth, teeth_.front(), teeth_.back());
  gear.helix_angle = std::clamp(gear.helix_angle, -helix_angles_.back(), helix_angles_.back());
  gear.profile_shift = std::clamp(gear.profile_shift, profile_shifts_.front(), profile_shifts_.back());
  return gear;
}

std::vector<double> CorrectionGrid::coefficients(const GearProportions& gear) const {
  std::vector<double> inverse_teeth, angles;
  for (const int z : teeth_) inverse_teeth.push_back(1.0 / z);
  for (std::size_t i = helix_angles_.size(); i-- > 1;) angles.push_back(-helix_angles_[i]);
  angles.insert(angles.end(), helix_angles_.begin(), helix_angles_.end());
  const std::vector<double> of_teeth = cardinal_polynomials(inverse_teeth, 1.0 / gear.teeth),
                            of_angle = cardinal_polynomials(angles, gear.helix_angle),
                            of_shift = cardinal_polynomials(profile_shifts_, gear.profile_shift);
  const KernelForm form = KernelForm::correction();
  const std::size_t centre = helix_angles_.size() - 1;
  std::vector<double> sum(static_cast<std::size_t>(form.count()), 0.0);
  const auto add = [&sum](double weight, const std::vector<double>& values) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * values[i];
  };
  auto entry = entries_.begin();
  for (const double z : of_teeth) {
    for (std::size_t b = 0; b <= centre; ++b) {
      // beta = 0 represents both of its halves.
      const double here = b == 0 ? 0.5 * of_angle[centre] : of_angle[centre + b];
      const double there = b == 0 ? 0.5 * of_angle[centre] : of_angle[centre - b];
      for (const double x : of_shift) {
        add(z * x * here, entry->coefficients);
        add(z * x * there, mirrored(form, entry->coefficients));
        ++entry;
      }
    }
  }
  return sum;
}

}  // namespace flankwright
