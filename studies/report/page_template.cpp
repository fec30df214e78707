#include "studies/report/page_template.hpp"

#include <string_view>
#include <utility>

#include "studies/report/report_assets.hpp"

namespace flankwright::studies {

namespace {

std::string replace_all(std::string_view text, const std::vector<std::pair<std::string_view, std::string_view>>& rules) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    bool replaced = false;
    for (const auto& [from, to] : rules) {
      if (text.substr(at, from.size()) != from) continue;
      out += to;
      at += from.size();
      replaced = true;
      break;
    }
    if (!replaced) out += text[at++];
  }
  return out;
}

std::string escape_html(std::string_view text) {
  return replace_all(text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}});
}

/// JSON that is valid inside a script element: pure ASCII (which also covers U+2028 and U+2029), and without '<',
/// so that neither "</script" nor "<!--" can occur. '<' can only be inside a JSON string, where \u003c means the same.
std::string script_safe(const Json& value) { return replace_all(value.dump(-1, ' ', true, Json::error_handler_t::replace), {{"<", "\\u003c"}}); }

}  // namespace

std::string render_page(const std::string& title, const std::vector<PageSection>& sections, const Json& data, const std::string& script) {
  std::string links, bodies;
  for (const auto& [id, heading] : sections) {
    links += "<a href=\"#" + id + "\">" + heading + "</a>\n";
    bodies += "<section id=\"" + id + "\"><h2>" + heading + "</h2><div class=\"body\"></div></section>\n";
  }
  const std::string shown = escape_html(title), safe = script_safe(data);
  // One pass over the template: what is filled in is never searched for placeholders again.
  return replace_all(assets::page_html, {{"{{title}}", shown},
                                         {"{{style}}", assets::page_css},
                                         {"{{notices}}", assets::notices},
                                         {"{{links}}", links},
                                         {"{{sections}}", bodies},
                                         {"{{results}}", safe},
                                         {"{{chart_library}}", assets::chart_library},
                                         {"{{script}}", script}});
}

}  // namespace flankwright::studies
