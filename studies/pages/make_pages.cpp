// Makes HTML of a tree of Markdown pages: the first one, all that links lead to from there, and what they show.
//
//   flankwright_pages ROOT OUTPUT
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/pages/page_html.hpp"

namespace {

namespace fs = std::filesystem;

class Pages {
 public:
  Pages(fs::path root, fs::path output) : root_(std::move(root)), output_(std::move(output)) {}

  /// @param first  page, from the root
  void make(const fs::path& first) {
    known_.insert(first);
    waiting_.push_back(first);
    while (!waiting_.empty()) {
      const fs::path page = waiting_.back();
      waiting_.pop_back();
      write(page);
    }
  }

 private:
  void write(const fs::path& page) {
    std::ifstream in(root_ / page, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in) throw std::runtime_error((root_ / page).string() + " cannot be read");
    const std::string to_root = fs::path(".").lexically_relative(page.parent_path() / "").generic_string();
    const auto link_target = [&](const std::string& link) { return found(page.parent_path(), link); };
    fs::path file = output_ / page;
    file.replace_extension("html");
    fs::create_directories(file.parent_path());
    std::ofstream out(file, std::ios::binary);
    out << flankwright::studies::page_html(text, to_root == "." ? "" : to_root + "/", link_target);
    if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
  }

  /// What a link of a page in `folder` becomes; its page or file is made too. Empty for a folder without a page.
  std::string found(const fs::path& folder, const std::string& link) {
    fs::path target = (folder / link).lexically_normal();
    std::string html = link;
    if (fs::is_directory(root_ / target)) {
      target = (target / "README.md").lexically_normal();
      html += html.ends_with('/') ? "README.md" : "/README.md";
    }
    if (!fs::exists(root_ / target)) return "";
    const bool is_page = target.extension() == ".md";
    if (known_.insert(target).second) {
      if (is_page)
        waiting_.push_back(target);
      else
        copy(target);
    }
    return is_page ? html.substr(0, html.size() - 3) + ".html" : html;
  }

  void copy(const fs::path& file) {
    fs::create_directories((output_ / file).parent_path());
    fs::copy_file(root_ / file, output_ / file, fs::copy_options::overwrite_existing);
  }

  fs::path root_, output_;
  std::set<fs::path> known_;
  std::vector<fs::path> waiting_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::runtime_error("usage: flankwright_pages ROOT OUTPUT");
    fs::remove_all(argv[2]);
    Pages(argv[1], argv[2]).make("README.md");
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 1;
  }
}
