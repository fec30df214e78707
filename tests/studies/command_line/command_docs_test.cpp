#include <catch2/catch.hpp>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "studies/study/task.hpp"
#include "tests/studies/command_line.hpp"

namespace flankwright::studies {

using Catch::Contains;
using command_line::Ending;
using command_line::run;
using command_line::ScratchFolder;
using command_line::text_of;

namespace {

/// First words of the lines of --help below "Subcommands:", or options below "Options:".
std::vector<std::string> listed(const std::string& help, const std::string& heading, const std::string& start) {
  std::vector<std::string> words;
  std::istringstream lines(help.substr(help.find(heading) + heading.size()));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream text(line);
    std::string word;
    if (!(text >> word)) {
      if (!words.empty()) break;
      continue;
    }
    if (const std::size_t comma = word.find(','); comma != std::string::npos) word = word.substr(comma + 1);
    if (word.starts_with(start) && line.starts_with("  ") && !line.starts_with("       ")) words.push_back(word);
  }
  return words;
}

}  // namespace

TEST_CASE("Every command has examples, and completions and manual are complete", "[studies][cli]") {
  const ScratchFolder folder;
  const std::vector<std::string> commands = listed(run(folder, {"--help"}).out, "Subcommands:", "");
  REQUIRE(commands.size() >= 9);
  const std::string bash = run(folder, {"completion", "bash"}).out, zsh = run(folder, {"completion", "zsh"}).out,
                    man = run(folder, {"completion", "man"}).out;
  for (const std::string& command : commands) {
    CAPTURE(command);
    const std::string help = run(folder, {command, "--help"}).out;
    CHECK_THAT(help, Contains("Example") && Contains("flankwright " + command + " "));
    CHECK_THAT(bash, Contains("    " + command + ") options="));
    CHECK_THAT(zsh, Contains("    '" + command + ":"));
    CHECK_THAT(man, Contains(".SS " + command + "\n"));
    for (const std::string& option : listed(help, "Options:", "--")) {
      CAPTURE(option);
      CHECK_THAT(bash, Contains(option));
      CHECK_THAT(zsh, Contains(option));
      std::string hyphens;
      for (const char c : option) hyphens += c == '-' ? std::string("\\-") : std::string(1, c);
      if (option != "--help") CHECK_THAT(man, Contains(hyphens));
    }
  }
}

TEST_CASE("The completion completes in bash", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("flankwright.bash", run(folder, {"completion", "bash"}).out);
  const auto completed = [&](const std::string& words, int index) {
    const std::string script =
        "source flankwright.bash; COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(index) + "; _flankwright; echo ${COMPREPLY[@]} > said";
    REQUIRE(std::system(("cd '" + folder.path().string() + "' && bash -c '" + script + "'").c_str()) == 0);
    return text_of(folder.path() / "said");
  };
  CHECK(completed("flankwright exp", 1) == "export\n");
  CHECK(completed("flankwright export r --vt", 3) == "--vtk\n");
  CHECK(completed("flankwright new opt", 2) == "optimise\n");
  for (const Task* task : registered_tasks()) {
    CHECK(completed("flankwright new " + std::string(task->name), 2) == std::string(task->name) + "\n");
  }
  CHECK(completed("flankwright completion z", 2) == "zsh\n");
  CHECK(completed("flankwright check flank", 2) == "flankwright.bash\n");
}

}  // namespace flankwright::studies
