#include "studies/study/study_errors.hpp"

#include <sstream>
#include <utility>

#include "studies/base/printable.hpp"

namespace flankwright::studies {

std::string to_string(const StudyProblem& problem) {
  std::ostringstream line;
  line << printable(problem.file);
  if (problem.line > 0) line << ':' << problem.line << ':' << problem.column;
  if (!problem.key.empty()) line << ": " << printable(problem.key) << " = " << printable(problem.value);
  line << ": " << printable(problem.allowed);
  return line.str();
}

namespace {

std::string lines_of(const std::vector<StudyProblem>& problems) {
  std::string lines;
  for (const StudyProblem& problem : problems) {
    if (!lines.empty()) lines += '\n';
    lines += to_string(problem);
  }
  return lines;
}

}  // namespace

StudyErrors::StudyErrors(std::vector<StudyProblem> problems)
    : InvalidInput(problems.at(0).key, problems.at(0).value, problems.at(0).allowed), problems_(std::move(problems)), lines_(lines_of(problems_)) {}

}  // namespace flankwright::studies
