#pragma once

#include <string>
#include <string_view>

namespace flankwright::studies {

/// What a line that is no TOML was probably meant to be, to be said behind the parser's own words: a decimal comma, "3,5", or a value
/// with its unit outside quotes, 3 mm. Empty where neither is meant.
std::string syntax_hint(std::string_view line);

}  // namespace flankwright::studies
