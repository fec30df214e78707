#include "studies/analysis/governing_cases.hpp"

#include <fmt/format.h>

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

/// What a load case is judged by, each the worse the larger; NaN where it was not computed.
Measures measures_of(const StudyResults& results, std::size_t loaded) {
  const CycleSummary& summary = results.loaded[loaded].summary;
  Measures of{summary.peak_contact_stress,      summary.edge_stress,    summary.peak_line_load, summary.pinion_root_stress.stress,
              summary.wheel_root_stress.stress, summary.te_peak_to_peak};
  const CaseLife* life = results.life ? results.life->find(loaded) : nullptr;
  const CaseLife unknown;
  const CaseLife& by_life = life != nullptr ? *life : unknown;
  for (const PerGear<double>* damage : {&by_life.contact_damage, &by_life.root_damage}) of.insert(of.end(), {damage->pinion, damage->wheel});
  for (const PerGear<double>* least : {&by_life.contact_safety, &by_life.root_safety, &by_life.iso_contact_safety, &by_life.iso_root_safety}) {
    of.insert(of.end(), {1.0 / least->pinion, 1.0 / least->wheel});
  }
  of.insert(of.end(), {1.0 / by_life.film, 1.0 / by_life.micropitting_safety, by_life.contact_temperature, 1.0 / by_life.scuffing_safety});
  return of;
}

/// The same case in every design: scene, torque and bin of a spectrum.
using CaseKey = std::tuple<std::string, double, int>;
CaseKey case_key_of(const LoadedResult& loaded) { return {loaded.scene, loaded.torque, loaded.bin}; }

/// Load cases that are compared with each other.
using Group = std::string;
Group design_of(const LoadedResult& loaded) { return loaded.design; }
Group design_and_flank_of(const LoadedResult& loaded) { return loaded.design + (loaded.condition.other_flanks ? " on the other flanks" : ""); }

/// Which load cases have a measure within a part of the largest of their group, in any design.
std::vector<bool> governing_by(const StudyResults& results, const std::vector<Measures>& measures, Group (*group_of)(const LoadedResult&),
                               double within = governs_within) {
  std::map<Group, Measures> largest;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    Measures& of_group = largest.try_emplace(group_of(results.loaded[i]), measures[i]).first->second;
    for (std::size_t k = 0; k < of_group.size(); ++k) of_group[k] = std::fmax(of_group[k], measures[i][k]);
  }
  std::set<CaseKey> governing;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const Measures& of_group = largest.at(group_of(results.loaded[i]));
    for (std::size_t k = 0; k < of_group.size(); ++k) {
      if (measures[i][k] > 0.0 && measures[i][k] >= (1.0 - within) * of_group[k]) governing.insert(case_key_of(results.loaded[i]));
    }
  }
  std::vector<bool> governs;
  for (const LoadedResult& loaded : results.loaded) governs.push_back(governing.contains(case_key_of(loaded)));
  return governs;
}

std::vector<Measures> all_measures(const StudyResults& results) {
  std::vector<Measures> measures;
  for (std::size_t i = 0; i < results.loaded.size(); ++i) measures.push_back(measures_of(results, i));
  return measures;
}

}  // namespace

std::vector<bool> governing_cases(const StudyResults& results) { return governing_by(results, all_measures(results), design_and_flank_of); }

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
  return governing_by(results, measures, design_of);
}

CasesWithPoints kept_points(const StudyResults& results) {
  const bool few = results.loaded.size() <= most_cases_with_points;
  return results.study.points.value_or(few ? CasesWithPoints::All : CasesWithPoints::Governing);
}

std::vector<bool> cases_with_points(const StudyResults& results) {
  if (kept_points(results) == CasesWithPoints::All) return std::vector<bool>(results.loaded.size(), true);
  std::vector<bool> governs = governing_cases(results);
  const bool few = static_cast<std::size_t>(std::ranges::count(governs, true)) <= most_cases_with_points;
  return few ? governs : governing_by(results, all_measures(results), design_and_flank_of, 0.0);
}

std::string points_note(const StudyResults& results) {
  if (results.study.points || kept_points(results) == CasesWithPoints::All) return {};
  const std::vector<bool> kept = cases_with_points(results);
  return fmt::format(
      "results.json, points.csv and the report have the contact points of the {} governing load cases of {}, and all other quantities of every one: beyond {} load cases "
      "output.points is \"governing\"; \"all\" keeps all points, 1 to 3 MB each",
      std::ranges::count(kept, true), kept.size(), most_cases_with_points);
}

}  // namespace flankwright::studies
