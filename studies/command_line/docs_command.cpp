#include "studies/command_line/docs_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/base/error.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/pages/page_list.hpp"

namespace flankwright::studies {

namespace {

namespace fs = std::filesystem;

/// Beside the installed program, or in the build folder.
fs::path pages_folder() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* from_program : {FLANKWRIGHT_PAGES, "../docs/html"}) {
    const fs::path folder = (program / from_program).lexically_normal();
    if (fs::exists(folder / documentation_pages.front().file)) return folder;
  }
  throw InvalidInput("docs", "no pages beside " + program.string(), "a program that was installed, or built with the target flankwright_docs");
}

void open_in_browser(const fs::path& file) {
  std::string opener = "xdg-open", path = file.string();
  char* const arguments[] = {opener.data(), path.data(), nullptr};
  pid_t child = 0;
  int status = 0;
  const bool is_open =
      posix_spawnp(&child, opener.c_str(), nullptr, nullptr, arguments, environ) == 0 && waitpid(child, &status, 0) == child && status == 0;
  if (!is_open) throw InvalidInput("--open", path, "a desktop whose xdg-open opens it; any browser shows this file");
}

}  // namespace

int docs_command(const std::string& page, bool open) {
  const fs::path folder = pages_folder();
  if (page.empty() && !open) {
    for (const NamedPage& named : documentation_pages) {
      print(fmt::format("{:<9}  {}\n           {}\n", named.name, (folder / named.file).string(), named.meaning));
    }
    return 0;
  }
  const auto found = page.empty() ? documentation_pages.begin() : std::ranges::find(documentation_pages, page, &NamedPage::name);
  if (found == documentation_pages.end()) {
    std::vector<std::string_view> names;
    for (const NamedPage& named : documentation_pages) names.push_back(named.name);
    throw InvalidInput("docs", page, fmt::format("one of {}", fmt::join(names, ", ")));
  }
  const fs::path file = folder / found->file;
  if (open)
    open_in_browser(file);
  else
    print(file.string() + "\n");
  return 0;
}

}  // namespace flankwright::studies
