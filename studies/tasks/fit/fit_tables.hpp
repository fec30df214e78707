#pragma once

#include "studies/tasks/fit/fit_gears.hpp"
#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

/// CSV tables of fits: fit_pinion.csv and fit_wheel.csv, all that defines a fit, a name and a
/// number a line; fit_residuals.csv and deflection_curves.csv of both gears.
std::vector<NamedText> fit_tables(const std::vector<GearFit>& fits);

/// Summary on the terminal: the status of each fit, and its residuals beside those of the thesis' forms.
std::string fit_summary(const std::vector<GearFit>& fits);

}  // namespace flankwright::studies
