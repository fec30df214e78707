#include "studies/pages/page_html.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "studies/pages/page_list.hpp"
#include "tests/studies/command_line.hpp"

namespace flankwright::studies {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

std::string html_of(const std::string& markdown) {
  return page_html(markdown, "../", [](const std::string& link) {
    return link.ends_with(".md") ? link.substr(0, link.size() - 3) + ".html" : link == "folder" ? std::string() : link;
  });
}

std::string text_of_page(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What a pattern's first group holds wherever it occurs.
std::set<std::string> all_of(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::set<std::string> found;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), expression); match != std::sregex_iterator(); ++match) found.insert((*match)[1]);
  return found;
}

}  // namespace

TEST_CASE("A page's tables, links, headings and comments become those of HTML", "[studies][pages]") {
  const std::string html = html_of(
      "# Signs & units\n\n<!-- a remark -->\n\n| key | unit |\n|---|---|\n| `torque` | N·m |\n\n## What it costs: time, memory\n\n"
      "[a](other.md#x) [b](#signs) [c](https://a.org/b.md) [d](folder) ![e](e.png)\n\n    code <b>\n\n## What it costs: time, memory\n");
  CHECK_THAT(html, Contains("<title>Signs &amp; units</title>"));
  CHECK_THAT(html, Contains("<td><code>torque</code></td>\n<td>N·m</td>"));
  CHECK_THAT(html, Contains("<a href=\"other.html#x\">a</a> <a href=\"#signs\">b</a> <a href=\"https://a.org/b.md\">c</a> d <img src=\"e.png\""));
  CHECK_THAT(html, Contains("id=\"what-it-costs-time-memory\"") && Contains("id=\"what-it-costs-time-memory-1\""));
  CHECK_THAT(html, Contains("<pre><code>code &lt;b&gt;\n</code></pre>"));
  CHECK_THAT(html, !Contains("a remark"));
  CHECK_THAT(html, Contains("href=\"../studies/keys.html\""));
}

TEST_CASE("A heading's anchor is that of GitHub", "[studies][pages]") {
  CHECK(heading_anchor("Values and units") == "values-and-units");
  CHECK(heading_anchor("real-17-44-*: measured flanks") == "real-17-44--measured-flanks");
  CHECK(heading_anchor("K_Hβ, in N·m – or µm") == "k_hβ-in-nm--or-µm");
}

TEST_CASE("Every page that the program names is there, and no link between pages is dead", "[studies][pages]") {
  const command_line::ScratchFolder folder;
  const command_line::Ending start = command_line::run(folder, {"docs", "start"});
  CAPTURE(start.err);
  REQUIRE(start.exit_code == 0);
  const fs::path root = fs::path(start.out.substr(0, start.out.size() - 1)).parent_path();
  std::map<std::string, std::string> pages;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".html") pages[entry.path().string()] = text_of_page(entry.path());
  }
  for (const NamedPage& named : documentation_pages) CHECK(pages.contains((root / named.file).string()));
  for (const auto& [file, text] : pages) {
    for (const std::string& url : all_of(text, "(?:href|src)=\"([^\"]*)\"")) {
      if (url.starts_with("http") || url.starts_with("mailto:")) continue;
      CAPTURE(file, url);
      const std::size_t hash = std::min(url.find('#'), url.size());
      const std::string target = hash == 0 ? file : (fs::path(file).parent_path() / url.substr(0, hash)).lexically_normal().string();
      CHECK(fs::exists(target));
      if (hash < url.size() && pages.contains(target)) CHECK_THAT(pages[target], Contains("id=\"" + url.substr(hash + 1) + "\""));
    }
  }
}

TEST_CASE("The documentation's pages are named on the command line", "[studies][pages][cli]") {
  const command_line::ScratchFolder folder;
  const command_line::Ending all = command_line::run(folder, {"docs"});
  CHECK(all.exit_code == 0);
  for (const NamedPage& named : documentation_pages) CHECK_THAT(all.out, Contains(std::string(named.file)));
  const command_line::Ending unknown = command_line::run(folder, {"docs", "kyes"});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Contains("docs = kyes: allowed is one of start, tutorial"));
}

}  // namespace flankwright::studies
