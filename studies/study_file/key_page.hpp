#pragma once

#include <string>

namespace flankwright::studies {

/// The key reference keys.md, in Markdown: every key of study_schema() with its unit, default, allowed values and meaning, a section a table.
/// A key of the pinion represents that of the wheel as well where both rows are equal.
std::string key_page();

}  // namespace flankwright::studies
