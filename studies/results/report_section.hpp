#pragma once

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// Parts of the report in their order, which is the order of interest for a gear engineer.
enum class Chapter {
  Answer,     ///< what the study asks for: the modifications to grind and their gain, the scatter, the cost of accuracy
  Contact,    ///< load, stress and transmission error of the load cases
  Assurance,  ///< how certain the answer is
  Search,     ///< how it was found
  Numbers     ///< everything else
};

/// A section of the report: the script fills the element `id` (page/task_pages.js, add_sections), which exists only where `present` holds.
struct ReportSection {
  Chapter chapter{Chapter::Numbers};
  const char* id{nullptr};
  const char* title{nullptr};
  bool (*present)(const Json& results){nullptr};  ///< of results.json, which may be damaged: any member may be absent or of another type
};

/// Whether an object has this member, and in it anything.
inline bool has(const Json& object, const char* key) {
  if (!object.is_object()) return false;
  const auto found = object.find(key);
  return found != object.end() && found->is_structured() && !found->empty();
}

/// Likewise, for a member of a member.
inline bool has(const Json& object, const char* key, const char* part) { return has(object, key) && has(object.at(key), part); }

}  // namespace flankwright::studies
