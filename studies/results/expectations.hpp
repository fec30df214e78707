#pragma once

#include <string>
#include <vector>

#include "studies/base/json_format.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// One comparison of [expect] with the results.
struct Comparison {
  std::string key;       ///< with the index of the entry where the key stands for several: "loaded[1].summary.te_mean_um"
  std::string expected;  ///< in words: "0.84 +- 2 %"
  double found{not_given};
  std::string found_text;  ///< where a text or a truth value was found
  bool met{false};
  std::string hint;  ///< where the key leads nowhere: one that does and looks like what was meant; empty: none does
};

/// Compares results.json with the study's [expect] table. A key is a dotted path; where it passes through an array without naming
/// an index ("loaded.summary.te_mean_um"), every entry must meet it. A key that is not there, or is null, or of another
/// type is not met.
/// A key that leads nowhere gets the name of a neighbour that is spelt almost alike, the entry of a list that another table has under a
/// name of its own (te_harmonic_2_um: te_harmonics_um.1), or the place where the name is found elsewhere.
std::vector<Comparison> compare(const std::vector<Expectation>& expectations, const Json& results);

/// A table of those that are not met; empty where all are.
std::string differences(const std::vector<Comparison>& comparisons);

}  // namespace flankwright::studies
