#pragma once

#include <string>

namespace flankwright::studies {

/// The key reference keys.md, in Markdown: every key of study_schema() with its unit, default, allowed values and meaning, a section a table.
/// A key of the pinion stands for the wheel's as well where both say the same.
std::string key_page();

}  // namespace flankwright::studies
