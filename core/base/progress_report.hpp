#pragma once

#include <functional>
#include <string>

namespace flankwright {

/// Progress of long work: a label, done and total steps (total 0: unknown), a remark.
using ProgressReport = std::function<void(const std::string& label, int done, int total, const std::string& remark)>;

}  // namespace flankwright
