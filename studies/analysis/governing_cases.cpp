#include "studies/analysis/governing_cases.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "studies/analysis/case_life.hpp"

namespace flankwright::studies {

namespace {

using Measures = std::vector<double>;

/// What a load case is judged by; NaN where it was not computed.
Measures measures_of(const StudyResults& results, std::size_t loaded) {
  const CycleSummary& summary = results.loaded[loaded].summary;
  Measures of{summary.peak_contact_stress,
              summary.pinion_root_stress.stress,
              summary.wheel_root_stress.stress,
              summary.te_peak_to_peak,
              not_given,
              not_given,
              not_given,
              not_given};
  const CaseLife* life = results.life ? results.life->find(loaded) : nullptr;
  if (life == nullptr) return of;
  of[4] = life->contact_damage.pinion;
  of[5] = life->contact_damage.wheel;
  of[6] = life->root_damage.pinion;
  of[7] = life->root_damage.wheel;
  return of;
}

/// The same case in every design: scene, torque and bin of a spectrum.
using CaseKey = std::tuple<std::string, double, int>;
CaseKey case_key_of(const LoadedResult& loaded) { return {loaded.scene, loaded.torque, loaded.bin}; }

/// Which load cases have a measure within governs_within of the largest of their design, in any design.
std::vector<bool> governing_by(const StudyResults& results, const std::vector<Measures>& measures) {
  std::map<std::string, Measures> largest;  // of each design
  for (std::size_t i = 0; i < measures.size(); ++i) {
    Measures& of_design = largest.try_emplace(results.loaded[i].design, measures[i]).first->second;
    for (std::size_t k = 0; k < of_design.size(); ++k) of_design[k] = std::fmax(of_design[k], measures[i][k]);
  }
  std::set<CaseKey> governing;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const Measures& of_design = largest.at(results.loaded[i].design);
    for (std::size_t k = 0; k < of_design.size(); ++k) {
      if (measures[i][k] > 0.0 && measures[i][k] >= (1.0 - governs_within) * of_design[k]) governing.insert(case_key_of(results.loaded[i]));
    }
  }
  std::vector<bool> governs;
  for (const LoadedResult& loaded : results.loaded) governs.push_back(governing.contains(case_key_of(loaded)));
  return governs;
}

}  // namespace

std::vector<bool> governing_cases(const StudyResults& results) {
  std::vector<Measures> measures;
  for (std::size_t i = 0; i < results.loaded.size(); ++i) measures.push_back(measures_of(results, i));
  return governing_by(results, measures);
}

std::vector<bool> most_utilised_cases(const StudyResults& results, const LifeModel& life) {
  std::vector<Measures> measures;
  for (const LoadedResult& loaded : results.loaded) {
    if (!loaded.cycle.usable()) {
      measures.push_back({not_given, not_given});
      continue;
    }
    const CaseLife of = case_life(results.models[loaded.model], life, loaded);
    measures.push_back(
        {1.0 / std::fmin(of.contact_safety.pinion, of.contact_safety.wheel), 1.0 / std::fmin(of.root_safety.pinion, of.root_safety.wheel)});
  }
  return governing_by(results, measures);
}

std::vector<bool> cases_with_points(const StudyResults& results) {
  return results.study.points_of_all_cases ? std::vector<bool>(results.loaded.size(), true) : governing_cases(results);
}

}  // namespace flankwright::studies
