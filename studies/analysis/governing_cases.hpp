#pragma once

#include <vector>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// A load case governs where one of its figures is within this part of the largest of its design [-].
inline constexpr double governs_within = 0.01;

/// Which load cases govern, one entry for each of StudyResults::loaded. A load case governs where its largest contact stress, root stress of a gear or transmission error peak
/// to peak, or its damage at the most damaged point of a gear's flank or fillet, is within governs_within of the largest of its design; the same scene under
/// the same torque then counts in every design.
std::vector<bool> governing_cases(const StudyResults& results);

/// Which load cases use the strength of flanks or roots most, likewise: the reciprocal of their least safety by local stress is within governs_within of the
/// largest of its design.
std::vector<bool> most_utilised_cases(const StudyResults& results, const LifeModel& life);

/// Which load cases have their contact points in the results, likewise: all, or where the study asks for it (`output.points = "governing"`) those that govern.
std::vector<bool> cases_with_points(const StudyResults& results);

}  // namespace flankwright::studies
