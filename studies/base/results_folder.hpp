#pragma once

#include <filesystem>
#include <string>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// A file of the results folder: its name and its whole content.
struct NamedText {
  std::string name, text;
};

/// Writes a file so that it appears whole or not at all: a temporary file in the same folder is synced to disk and renamed.
/// @throws InvalidInput ("output folder") with the system's reason where it cannot be written
void write_whole(const std::filesystem::path& file, const std::string& text);

/// Makes the folder with its parents. @throws InvalidInput as write_whole().
void make_folder(const std::filesystem::path& folder);

/// A whole file as text. @throws InvalidInput ("file") where it cannot be read.
std::string read_whole(const std::filesystem::path& file);

/// What messages say of a results.json that cannot be used, and of what is asked for instead.
inline constexpr const char* damaged_results = "a damaged or incomplete file";
inline constexpr const char* results_of_a_run = "results.json as `flankwright run` writes it";

/// results.json of a results folder. Throws InvalidInput where the folder has none, and where it is damaged or not of a run.
Json whole_results(const std::filesystem::path& folder);

}  // namespace flankwright::studies
