#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "studies/command_line/commands.hpp"
#include "studies/command_line/compare_command.hpp"
#include "studies/command_line/exchange_commands.hpp"

namespace flankwright::studies {

/// Exit codes for bad input and for faults of the program. The others are 0 and 1, where a requirement is not met.
inline constexpr int bad_input = 2, internal_error = 3;

/// The commands of the program with their options. A new one is a function here, called by the constructor.
class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;  // the options are stored here

  /// @returns the exit code of the command that the arguments name
  /// @throws InvalidInput  for an unknown command, and what the command throws
  int run(int argc, const char* const* argv);

 private:
  struct Command {
    CLI::App* parsed;
    std::function<int()> action;
  };
  CLI::App* add(const char* name, const char* what, const char* examples, std::function<int()> action);
  void add_run();
  void add_merge();
  void add_check();
  void add_new();
  void add_keys();
  void add_report();
  void add_compare();
  void add_test();
  void add_library();
  void add_import();
  void add_export();
  void add_docs();
  void add_completion();

  CLI::App app_;
  std::vector<Command> commands_;
  RunOptions options_;
  CompareCommand comparison_;
  ImportCommand import_;
  ExportCommand export_;
  std::vector<std::string> settings_, paths_;
  std::string study_, kind_, folder_, page_, shell_;
  bool accept_{false}, open_page_{false};
  int threads_{0};
};

}  // namespace flankwright::studies
