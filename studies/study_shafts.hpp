#pragma once

#include <memory>

#include "core/compliance/shaft/shaft_pair.hpp"
#include "studies/study_reading.hpp"

namespace flankwright::studies {

/// Reads what [pinion.shaft] and [wheel.shaft] leave to the rest of the study: the gear's material where the shaft has none
/// of its own, the first bearing as the one that holds axially where none does. Refuses shafts that cannot be.
void read_shafts(StudyReading& reading);

/// A compliance that tells how long it was asked.
class TimedCompliance final : public PairCompliance {
 public:
  explicit TimedCompliance(std::shared_ptr<const PairCompliance> compliance) : compliance_(std::move(compliance)) {}
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override;
  double seconds() const { return seconds_; }

 private:
  std::shared_ptr<const PairCompliance> compliance_;
  mutable double seconds_{0.0};
};

/// The shafts of a study as part of the influence matrix; null where it describes none.
/// @throws InvalidInput  as ShaftPair
std::shared_ptr<const ShaftPair> make_shafts(const Study& study, const GearPair& pair);

}  // namespace flankwright::studies
