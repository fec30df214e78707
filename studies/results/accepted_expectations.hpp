#pragma once

#include <string>
#include <vector>

#include "studies/base/json_format.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// A study whose [expect] table has what was found in place of what was expected.
struct AcceptedStudy {
  std::string text;  ///< of the study; all else in it is as it was, comments too
  int values{0};     ///< how many were written
  std::vector<std::string>
      kept;  ///< a line for each expectation that stays unmet: bounds, keys that lead nowhere, entries of a list that differ by more than the tolerance
};

/// Writes the values of results.json into the text of a study, of `value` and `is`. Where a key stands for several entries of a list it gets the middle of
/// their values, which all of them must meet. Bounds are no values and stay.
/// @param text  the file that `expectations` were read from
AcceptedStudy accept_results(const std::string& text, const std::vector<Expectation>& expectations, const Json& results);

}  // namespace flankwright::studies
