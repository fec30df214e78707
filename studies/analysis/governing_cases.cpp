#include "studies/analysis/governing_cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace flankwright::studies {

namespace {

constexpr std::size_t measure_count = 8;
using Measures = std::array<double, measure_count>;

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

}  // namespace

std::vector<bool> governing_cases(const StudyResults& results) {
  const std::size_t count = results.loaded.size();
  std::vector<Measures> measures;
  std::map<std::string, Measures> largest;  // of each design
  for (std::size_t i = 0; i < count; ++i) {
    measures.push_back(measures_of(results, i));
    Measures& of_design = largest.try_emplace(results.loaded[i].design, measures.back()).first->second;
    for (std::size_t k = 0; k < measure_count; ++k) of_design[k] = std::fmax(of_design[k], measures.back()[k]);
  }
  std::set<CaseKey> governing;
  for (std::size_t i = 0; i < count; ++i) {
    const Measures& of_design = largest.at(results.loaded[i].design);
    for (std::size_t k = 0; k < measure_count; ++k) {
      if (measures[i][k] > 0.0 && measures[i][k] >= (1.0 - governs_within) * of_design[k]) governing.insert(case_key_of(results.loaded[i]));
    }
  }
  std::vector<bool> governs;
  for (const LoadedResult& loaded : results.loaded) governs.push_back(governing.contains(case_key_of(loaded)));
  return governs;
}

std::vector<bool> cases_with_points(const StudyResults& results) {
  return results.study.points_of_all_cases ? std::vector<bool>(results.loaded.size(), true) : governing_cases(results);
}

}  // namespace flankwright::studies
