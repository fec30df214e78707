#include "tests/studies/command_line.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace flankwright::studies::command_line {

namespace fs = std::filesystem;

namespace {

/// For the shell: in single quotes, in which nothing but the quote itself is special.
std::string quoted(const std::string& text) {
  std::string result;
  result += '\'';
  for (char c : text) {
    if (c == '\'') result += "'\\'";
    result += c;
  }
  result += '\'';
  return result;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "flankwright-tests-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder " + name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string ScratchFolder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return (path_ / name).string();
}

std::vector<std::string> ScratchFolder::names(const fs::path& below) const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_ / below)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string program() {
  const char* given = std::getenv("FLANKWRIGHT_EXECUTABLE");
  return given != nullptr ? given : FLANKWRIGHT_EXECUTABLE;
}

Ending run(const ScratchFolder& folder, const std::vector<std::string>& arguments, const fs::path& elsewhere) {
  const ScratchFolder caught;
  const fs::path out = elsewhere.empty() ? caught.path() / "out" : elsewhere, err = caught.path() / "err";
  std::ostringstream command;
  command << "cd " << quoted(folder.path().string()) << " && " << quoted(program());
  for (const std::string& argument : arguments) command << ' ' << quoted(argument);
  command << " >" << quoted(out.string()) << " 2>" << quoted(err.string());
  const int status = std::system(command.str().c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, elsewhere.empty() ? text_of(out) : "", text_of(err)};
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace flankwright::studies::command_line
