#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// A load case governs where one of its figures is within this part of the largest of its design [-].
inline constexpr double governs_within = 0.01;

/// Which load cases govern, one entry for each of StudyResults::loaded. A load case governs where one of these is within governs_within of the largest of its design and of the flank
/// that it loads: the contact stress, on a flank or a tip edge, the line load, the root stress of a gear, the transmission error peak to peak, the damage at the most damaged point of a
/// gear's flank or fillet, the reciprocals of the safeties and of the film, the contact temperature. The same scene under the same torque then counts in every design.
std::vector<bool> governing_cases(const StudyResults& results);

/// Which load cases use the strength of flanks or roots most, likewise: the reciprocal of their least safety by local stress is within governs_within of the
/// largest of its design.
std::vector<bool> most_utilised_cases(const StudyResults& results, const LifeModel& life);

/// Load cases of all designs together up to which a study that says nothing of `output.points` keeps the points of all, and how many at most govern beyond. Each takes 1 to 3 MB of
/// results.json and 0.2 to 0.4 MB of report.html: these then stay below about 300 MB, which programs still read, and 40 MB, which a browser still opens.
inline constexpr std::size_t most_cases_with_points = 100;

/// Load cases of all designs together up to which each may be compared with a mesh of twice the intervals; beyond, those that govern. The others state the wider error that half the
/// intervals tell of.
inline constexpr std::size_t most_cases_compared_finely = 100;

/// `output.points` as the study gives it, else all up to most_cases_with_points and those that govern beyond.
CasesWithPoints kept_points(const StudyResults& results);

/// Which load cases have their contact points in the results, one entry for each of StudyResults::loaded, by kept_points(). Where more than most_cases_with_points govern, as under many loads
/// that are nearly the same, only the largest of each measure.
std::vector<bool> cases_with_points(const StudyResults& results);

/// That and why points are left out, where the study does not say which are kept; empty: they are not.
std::string points_note(const StudyResults& results);

}  // namespace flankwright::studies
