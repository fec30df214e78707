#pragma once

#include <CLI/App.hpp>
#include <string>

/// Shell completions and manual page, made from the commands themselves, so that they are complete.
namespace flankwright::studies {

/// Completion for bash: commands, their options, the words an option is limited to, else files.
std::string bash_completion(const CLI::App& app);

/// The same for zsh.
std::string zsh_completion(const CLI::App& app);

/// flankwright(1), in roff.
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace flankwright::studies
