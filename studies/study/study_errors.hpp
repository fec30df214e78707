#pragma once

#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace flankwright::studies {

/// One thing in a study file that is not allowed.
struct StudyProblem {
  std::string file;        ///< path as given; "--set" for a value from the command line
  int line{0}, column{0};  ///< from 1; 0 where there is no place in a file
  std::string key;         ///< dotted path; empty for a syntax error
  std::string value;       ///< as written, shortened
  std::string allowed;     ///< a sentence: what would have been accepted
};

/// "gears.toml:12:3: pinion.teeth = 2: allowed is an integer 5 .. 1000"
std::string to_string(const StudyProblem& problem);

/// All problems of a study file at once; what() is a line for each. field(), value() and allowed() are the first's.
class StudyErrors : public InvalidInput {
 public:
  /// @param problems  at least one
  explicit StudyErrors(std::vector<StudyProblem> problems);

  const std::vector<StudyProblem>& problems() const { return problems_; }
  const char* what() const noexcept override { return lines_.c_str(); }

 private:
  std::vector<StudyProblem> problems_;
  std::string lines_;
};

}  // namespace flankwright::studies
