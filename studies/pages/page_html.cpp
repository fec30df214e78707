#include "studies/pages/page_html.hpp"

#include <cmark-gfm-core-extensions.h>
#include <cmark-gfm-extension_api.h>
#include <cmark-gfm.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "studies/pages/page_list.hpp"

namespace flankwright::studies {

namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --line: #8886; --shade: #8882; }
body { max-width: 60rem; margin: 0 auto; padding: 1rem 1.5rem 4rem; font: 16px/1.5 system-ui, sans-serif; }
nav { border-bottom: 1px solid var(--line); padding-bottom: 0.5rem; }
nav a { margin-right: 1.2rem; }
h1, h2, h3, h4 { line-height: 1.25; margin-top: 1.8em; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
th, td { border: 1px solid var(--line); padding: 0.25rem 0.6rem; text-align: left; vertical-align: top; }
pre, code { font-family: ui-monospace, monospace; font-size: 0.9em; background: var(--shade); border-radius: 3px; }
code { padding: 0.1em 0.25em; }
pre { padding: 0.7rem 1rem; overflow-x: auto; }
pre code { background: none; padding: 0; }
img { max-width: 100%; background: white; }
)";

using Node = std::unique_ptr<cmark_node, decltype(&cmark_node_free)>;

std::string taken_text(char* text) {
  const std::string copy(text);
  std::free(text);  // NOLINT(cppcoreguidelines-no-malloc): the library's default allocator
  return copy;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

Node parsed(const std::string& markdown) {
  cmark_gfm_core_extensions_ensure_registered();
  cmark_syntax_extension* tables = cmark_find_syntax_extension("table");
  if (tables == nullptr) throw std::runtime_error("cmark-gfm has no tables");
  const std::unique_ptr<cmark_parser, decltype(&cmark_parser_free)> parser(cmark_parser_new(CMARK_OPT_DEFAULT), &cmark_parser_free);
  cmark_parser_attach_syntax_extension(parser.get(), tables);
  cmark_parser_feed(parser.get(), markdown.data(), markdown.size());
  return {cmark_parser_finish(parser.get()), &cmark_node_free};
}

/// All nodes of a type, in the order of the page.
std::vector<cmark_node*> nodes_of(cmark_node* root, cmark_node_type type) {
  const std::unique_ptr<cmark_iter, decltype(&cmark_iter_free)> iterator(cmark_iter_new(root), &cmark_iter_free);
  std::vector<cmark_node*> found;
  for (cmark_event_type event = cmark_iter_next(iterator.get()); event != CMARK_EVENT_DONE; event = cmark_iter_next(iterator.get())) {
    cmark_node* node = cmark_iter_get_node(iterator.get());
    if (event == CMARK_EVENT_ENTER && cmark_node_get_type(node) == type) found.push_back(node);
  }
  return found;
}

std::string text_of(cmark_node* heading) {
  const std::unique_ptr<cmark_iter, decltype(&cmark_iter_free)> iterator(cmark_iter_new(heading), &cmark_iter_free);
  std::string text;
  for (cmark_event_type event = cmark_iter_next(iterator.get()); event != CMARK_EVENT_DONE; event = cmark_iter_next(iterator.get())) {
    const char* literal = event == CMARK_EVENT_ENTER ? cmark_node_get_literal(cmark_iter_get_node(iterator.get())) : nullptr;
    if (literal != nullptr) text += literal;
  }
  return text;
}

/// Puts its anchor before each heading.
/// @return the first heading's text
std::string add_anchors(cmark_node* root) {
  std::map<std::string, int> seen;
  std::string first;
  for (cmark_node* heading : nodes_of(root, CMARK_NODE_HEADING)) {
    const std::string text = text_of(heading), plain = heading_anchor(text);
    if (first.empty()) first = text;
    const int before = seen[plain]++;
    const std::string id = before == 0 ? plain : plain + "-" + std::to_string(before);
    Node anchor(cmark_node_new(CMARK_NODE_CUSTOM_BLOCK), &cmark_node_free);
    cmark_node_set_on_enter(anchor.get(), ("<a id=\"" + id + "\"></a>").c_str());
    if (cmark_node_insert_before(heading, anchor.get()) != 0) static_cast<void>(anchor.release());
  }
  return first;
}

bool names_server(const std::string& url) { return url.starts_with("http:") || url.starts_with("https:") || url.starts_with("mailto:"); }

void turn_link(cmark_node* link, const std::function<std::string(const std::string&)>& link_target) {
  const std::string url = cmark_node_get_url(link);
  const std::size_t hash = std::min(url.find('#'), url.size());
  if (names_server(url) || hash == 0) return;
  const std::string target = link_target(url.substr(0, hash));
  if (!target.empty()) {
    cmark_node_set_url(link, (target + url.substr(hash)).c_str());
    return;
  }
  while (cmark_node* child = cmark_node_first_child(link)) cmark_node_insert_before(link, child);
  cmark_node_free(link);
}

}  // namespace

std::string heading_anchor(const std::string& heading) {
  std::string anchor;
  for (std::size_t i = 0; i < heading.size(); ++i) {
    const auto c = static_cast<unsigned char>(heading[i]);
    if (c == ' ' || c == '-') anchor += '-';
    // Of other alphabets letters stay; the signs of Latin-1, but for the micro sign, and general punctuation go.
    else if (c == 0xC2 && i + 1 < heading.size() && heading[i + 1] != '\xB5')
      ++i;
    else if (c == 0xE2 && i + 2 < heading.size() && (static_cast<unsigned char>(heading[i + 1]) & 0xFEU) == 0x80U)
      i += 2;
    else if (c >= 0x80 || c == '_' || std::isalnum(c) != 0)
      anchor += static_cast<char>(std::tolower(c));
  }
  return anchor;
}

std::string page_html(const std::string& markdown, const std::string& to_root, const std::function<std::string(const std::string&)>& link_target) {
  const Node root = parsed(markdown);
  const std::string title = add_anchors(root.get());
  for (const cmark_node_type type : {CMARK_NODE_LINK, CMARK_NODE_IMAGE}) {
    for (cmark_node* link : nodes_of(root.get(), type)) turn_link(link, link_target);
  }
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
      escaped(title) + "</title><style>" + style + "</style></head><body>\n<nav>";
  for (const NamedPage& named : documentation_pages) {
    page += "<a href=\"" + to_root + std::string(named.file) + "\">" + std::string(named.name) + "</a>";
  }
  page += "</nav>\n" + taken_text(cmark_render_html(root.get(), CMARK_OPT_DEFAULT, nullptr)) + "</body></html>\n";
  return page;
}

}  // namespace flankwright::studies
