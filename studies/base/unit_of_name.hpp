#pragma once

#include <string_view>

namespace flankwright::studies {

/// The unit that the end of a name in results.json says: "um" of "te_peak_to_peak_um", of its estimated error "te_peak_to_peak_um_error"
/// and of "loaded.0.summary.te_peak_to_peak_um"; "N/(mm um)" of "mean_stiffness_N_per_mm_um". "-" of a name that ends in no unit: a plain
/// number, or a text.
std::string_view unit_of_name(std::string_view name);

}  // namespace flankwright::studies
