#pragma once

#include <string>

#include "studies/study/study_errors.hpp"

namespace flankwright::studies::rexs {

/// Throws StudyErrors with one problem of a file.
[[noreturn]] void refuse(const std::string& file, int line, const std::string& key, const std::string& value, const std::string& allowed);

}  // namespace flankwright::studies::rexs
