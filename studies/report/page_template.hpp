#pragma once

#include <string>
#include <vector>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// A section of a page: the script fills the element `id`.
struct PageSection {
  std::string id, title;
};

/// A page of page/report.html: its title as text, its empty sections with links to them, the data that its script reads, and the script. Everything
/// is inlined; the page loads nothing.
std::string render_page(const std::string& title, const std::vector<PageSection>& sections, const Json& data, const std::string& script);

}  // namespace flankwright::studies
