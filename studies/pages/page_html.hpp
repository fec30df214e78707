#pragma once

#include <functional>
#include <string>

namespace flankwright::studies {

/// The anchor that GitHub gives a heading: small letters, without punctuation, hyphens for spaces.
std::string heading_anchor(const std::string& heading);

/// Turns a page of the documentation, Markdown with tables, into an HTML document to be read offline. Its title is the first heading.
/// Headings carry the anchors of heading_anchor(), of equal ones the further with -1, -2 ... HTML within the page is left out, comments with it.
/// @param to_root      from the page to the first page's folder: "", "../", "../../" ...
/// @param link_target  what stands in the HTML for the target of a link or picture that names no server, without its anchor; empty: only the text is left
/// @throws std::runtime_error where the Markdown library has no tables
std::string page_html(const std::string& markdown, const std::string& to_root, const std::function<std::string(const std::string&)>& link_target);

}  // namespace flankwright::studies
