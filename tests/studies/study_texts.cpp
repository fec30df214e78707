#include "tests/studies/study_texts.hpp"

#include <catch2/catch.hpp>

#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"

namespace flankwright::studies::study_texts {

Study read(const std::string& more, const std::vector<Override>& overrides) { return parse_study(small_study + more, "small.toml", overrides); }

std::vector<StudyProblem> problems_of(const std::string& text, const std::vector<Override>& overrides) {
  try {
    parse_study(text, "small.toml", overrides);
  } catch (const StudyErrors& errors) {
    return errors.problems();
  }
  return {};
}

StudyProblem problem_of(const std::string& more, const std::vector<Override>& overrides) {
  const std::vector<StudyProblem> problems = problems_of(small_study + more, overrides);
  CAPTURE(more);
  REQUIRE(problems.size() == 1);
  return problems.front();
}

Json results_of(const std::string& text, const std::vector<Override>& overrides) {
  return Json::parse(results_json(run_study(parse_study(text, "small.toml", overrides))));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) { return text.replace(text.find(from), from.size(), to); }

}  // namespace flankwright::studies::study_texts
