#pragma once

#include <utility>
#include <vector>

#include "optimize/design/outputs/output_row.hpp"

namespace flankwright {

/// Rows of design_outputs() that need more than a load case's cycle, see DesignOutput::Candidates. Candidates are numbered
/// {position, 2 * point + gear} of contact damage, {-1, 2 * fillet point + gear} of root damage, {position, point} of the film and of
/// temperatures.
/// They throw InvalidInput where the scene lacks what they need: a spectrum, an S-N curve, a lubricant or a speed.
using CandidateValues = std::vector<std::pair<PeakCandidate, double>>;

CandidateValues contact_damages(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue contact_damage_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

CandidateValues root_damages(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue root_damage_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

CandidateValues loss_factors(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue loss_factor_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

/// Points without load have no film and are none of the candidates; a candidate that loses its load afterwards has the ratio of a film between unloaded flanks.
CandidateValues film_ratios(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue film_ratio_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

/// theta_fl [K] and theta_B [deg C] of local_temperature(); a point without load has no flash.
CandidateValues flash_temperatures(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue flash_temperature_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);
CandidateValues contact_temperatures(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue contact_temperature_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

}  // namespace flankwright
