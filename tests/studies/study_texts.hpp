#pragma once

#include <string>
#include <vector>

#include "studies/base/json_format.hpp"
#include "studies/study_file/study_file.hpp"

/// Studies as texts, and what the reader makes of them.
namespace flankwright::studies::study_texts {

/// Twelve lines that are a study; more tables may follow from line 13 on.
inline const std::string small_study = R"(title = "Small"
[pair]
normal_module = 4
helix_angle = 20

[pinion]
teeth = 20
face_width = 40

[wheel]
teeth = 30
face_width = 40
)";

/// The small study with more lines.
Study read(const std::string& more = "", const std::vector<Override>& overrides = {});

/// Everything that is wrong with a text; empty where it is a study.
std::vector<StudyProblem> problems_of(const std::string& text, const std::vector<Override>& overrides = {});

/// The one problem that the small study with these lines added has.
StudyProblem problem_of(const std::string& more, const std::vector<Override>& overrides = {});

/// What results.json says after a run of the text.
Json results_of(const std::string& text, const std::vector<Override>& overrides = {});

/// The text with the first `from` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace flankwright::studies::study_texts
