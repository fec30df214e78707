#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The flankwright executable as a user meets it.
namespace flankwright::studies::command_line {

/// What the environment variable FLANKWRIGHT_EXECUTABLE names, as every test has it; by hand the executable of the build that compiled this.
std::string program();

/// An empty folder of this process under the system's temporary one, removed with everything in it when this goes.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file into it and returns its path.
  std::string file(const std::string& name, const std::string& text) const;
  /// Names of what lies in a folder below it, sorted.
  std::vector<std::string> names(const std::filesystem::path& below = {}) const;

 private:
  std::filesystem::path path_;
};

/// What a run of the executable left.
struct Ending {
  int exit_code{-1};
  std::string out, err;
};

/// Runs flankwright with the arguments, the scratch folder as its working folder.
/// @param out  where stdout goes instead of Ending::out
Ending run(const ScratchFolder& folder, const std::vector<std::string>& arguments, const std::filesystem::path& out = {});

std::string text_of(const std::filesystem::path& file);

}  // namespace flankwright::studies::command_line
