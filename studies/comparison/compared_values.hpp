#pragma once

#include <string>
#include <vector>

#include "core/gear/gear_data.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// A run that is compared: what it is called, and its results.json.
struct ComparedRun {
  std::string name;
  Json results;
};

/// One number of all runs.
struct ComparedValue {
  std::string section;         ///< "geometry", "design", a load case "hot, 250 N·m", "unloaded contact", "sweep"
  std::string name;            ///< dotted, within the section: "summary.te_mean_um"
  std::string words;           ///< "mean TE"; empty where it has no name but its key
  std::string unit;            ///< "-" of a plain number
  bool headline{false};        ///< belongs to the short table
  std::vector<double> values;  ///< one a run; NaN where it has none

  /// What differences are relative to: the first run's value, of an entry of a list the first run's largest of the list; where that is 0, the largest of all runs.
  double scale{not_given};

  /// Of a run from the first one, as a share of `scale`; NaN where either has no value, 0 where both have none.
  double difference(std::size_t run) const;
  /// Whether a run differs from the first one by more than `tolerance` times `scale`, or only one of them has a value. Round-off is no difference.
  bool differs(std::size_t run, double tolerance) const;
};

/// A key of the studies that is not the same in all of them.
struct ComparedKey {
  std::string key;
  std::vector<std::string> values;  ///< as written, one a run; empty where it is not given
};

struct ComparedRuns {
  std::vector<ComparedKey> keys;      ///< those that differ
  std::vector<ComparedValue> values;  ///< in the order of results.json
};

/// The numbers of several runs side by side: the geometry of gears and pair, what an optimisation has found, the summaries of all load cases and
/// the worst of them, unloaded contact and the statistics of a sweep. A load case is found again by scene and torque; the designs "given" and "after" are the same
/// one, the final design of a run, and "before" is another. Places of extremes, estimated errors, numerical diagnostics and times are no results
/// in this sense and are left out.
///
/// @param runs  at least two
/// @throws InvalidInput where there are fewer, or results that are no object
ComparedRuns compare_runs(const std::vector<ComparedRun>& runs);

/// A load case by its scene, its torque, the number of the load in a spectrum, from 1, and whether it is of the design before an optimisation.
std::string load_case_name(const Json& loaded);

}  // namespace flankwright::studies
