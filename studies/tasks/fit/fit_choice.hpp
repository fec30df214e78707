#pragma once

#include "core/gear/gear_data.hpp"

namespace flankwright::studies {

/// [fit]: which gears' compliance is fitted, and how.
struct FitChoice {
  PerGear<bool> gears{true, true};
  bool several_teeth{false};  ///< KernelForm::several_teeth(), else one_tooth_accurate()
  bool test_grid{true};       ///< compared at stations that the fit has not seen
  int max_iterations{300};    ///< trust-region steps
};

}  // namespace flankwright::studies
