#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "studies/study.hpp"

/// Reads a study file (TOML) into a Study. Every key, its unit and range: keys.md and study_schema.hpp.
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

/// A value from the command line: --set key=value. The value is TOML, or a text without its quotes ("3 arcmin"); the
/// key is a dotted path, in which a number picks a table of [[scenes]], counted from 0. It replaces what the file says,
/// and, of keys that exclude each other (normal_module and normal_diametral_pitch), removes the other.
struct Override {
  std::string key, value;
};

/// Reads and validates a study file.
///
/// @throws StudyErrors with everything that is wrong, in the order of the lines; a file that cannot be read is one
/// problem
Study read_study(const std::string& path, const std::vector<Override>& overrides = {});

/// The same for a text.
///
/// @param name  stands for the file in messages, and for the title where the study has none
Study parse_study(std::string_view text, const std::string& name, const std::vector<Override>& overrides = {});

}  // namespace flankwright::studies
