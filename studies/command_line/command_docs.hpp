#pragma once

#include <CLI/App.hpp>
#include <string>

/// What a shell and `man` know of the command line: texts made from the commands themselves, so that none is forgotten.
namespace flankwright::studies {

/// Completion for bash: commands, their options, the words an option is limited to, else files.
std::string bash_completion(const CLI::App& app);

/// The same for zsh.
std::string zsh_completion(const CLI::App& app);

/// flankwright(1), in roff.
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace flankwright::studies
