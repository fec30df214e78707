#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studies/study/study.hpp"
#include "studies/study/study_errors.hpp"
#include "studies/study_file/override.hpp"

/// Reads a study file (TOML) into a Study. Every key, its unit and range: README.md and study_schema.hpp.
namespace flankwright::studies {

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
