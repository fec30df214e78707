#pragma once

#include "optimize/design/outputs/life_outputs.hpp"

namespace flankwright {

/// Rows of design_outputs() that are the reciprocal of a safety [-]: 1 is the limit, and less is better.
///
/// - contact: the contact stress over the one that the weaker flank bears for the load cycles of the case, or for ever where these are not known;
/// - root: likewise the largest principal stress of each gear's fillets;
/// - micropitting: lambda_GFP over the local film ratio [ISO/TS 6336-22];
/// - scuffing: (theta_B - theta_oil)/(theta_S - theta_oil) [ISO/TS 6336-20].
///
/// Candidates are those of PeakContactStress, PeakRootStress, SpecificFilmThickness and ContactTemperature.
/// They throw InvalidInput where the scene lacks what they need: an S-N curve, the permissible film, the scuffing temperature, a lubricant or a speed.
CandidateValues contact_utilisations(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue contact_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

CandidateValues root_utilisations(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue root_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

CandidateValues micropitting_utilisations(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue micropitting_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

CandidateValues scuffing_utilisations(const ObjectiveTerm& term, const LoadedScene& scene);
SmoothValue scuffing_utilisation_of(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

}  // namespace flankwright
