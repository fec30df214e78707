#pragma once

#include <memory>

#include "core/compliance/pair_compliance.hpp"
#include "studies/run_study.hpp"

namespace flankwright::studies {

/// The structure that a study's compliance model asks for; null for "rigid" and "thin_slice", which need none.
std::shared_ptr<const PairCompliance> gear_structures(const Study& study, const GearPair& pair,
                                                      const ProgressReport& progress);

}  // namespace flankwright::studies
