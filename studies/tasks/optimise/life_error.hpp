#pragma once

#include "optimize/design/outputs/output_row.hpp"
#include "studies/analysis/life_result.hpp"

namespace flankwright::studies {

/// Estimated discretisation error of an output of life in a load case, in the output's unit and >= 0; NaN: not estimated, or not an output of life.
/// That of a damage is by how much the more damaged gear's may exceed what is found, over the whole spectrum of the load case.
/// @param loaded  index into StudyResults::loaded
double life_error(const StudyLife& life, std::size_t loaded, Output output);

}  // namespace flankwright::studies
