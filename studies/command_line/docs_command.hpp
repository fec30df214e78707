#pragma once

#include <string>

namespace flankwright::studies {

/// Names the pages of the documentation, which are HTML beside the program, or one of them, or opens it in a browser.
/// @param page  name of page_list.hpp; empty: all of them, or the first where it is to be opened
/// @throws InvalidInput where there is no such page, the pages are not installed, or there is no browser
int docs_command(const std::string& page, bool open);

}  // namespace flankwright::studies
