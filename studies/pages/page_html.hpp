#pragma once

#include <functional>
#include <string>

namespace flankwright::studies {

/// A page of the documentation, to be read offline.
struct PageHtml {
  std::string title;  ///< its first heading
  std::string html;   ///< whole document
};

/// The anchor that GitHub gives a heading: small letters, without punctuation, hyphens for spaces.
std::string heading_anchor(const std::string& heading);

/// Turns a page of Markdown, with tables, into HTML. Headings carry the anchors of heading_anchor(), of equal ones the further with -1, -2 ...
/// HTML within the page is left out, comments with it.
/// @param to_root      from the page to the first page's folder: "", "../", "../../" ...
/// @param link_target  what stands in the HTML for the target of a link or picture that names no server, without its anchor; empty: only the text is left
/// @throws std::runtime_error where the Markdown library has no tables
PageHtml page_html(const std::string& markdown, const std::string& to_root, const std::function<std::string(const std::string&)>& link_target);

}  // namespace flankwright::studies
