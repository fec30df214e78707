#pragma once

#include <string>
#include <vector>

#include "studies/study/study.hpp"

namespace flankwright::studies {

/// One sample of a sweep as a study of its own, task "analyse": the sweep's study with the sample's values, without [sweep] and [expect].
/// Running it gives the sample's outputs, bit for bit. Paths of measured grids become absolute, so that it runs from anywhere.
///
/// @param title   of the new study
/// @param values  of the parameters, in the units of bare numbers
std::string sample_study(const Study& study, const std::string& title, const std::vector<double>& values);

}  // namespace flankwright::studies
