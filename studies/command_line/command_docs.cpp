#include "studies/command_line/command_docs.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "studies/study/task.hpp"

namespace flankwright::studies {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// "--out --set ..." without --help's short form.
std::string options_of(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) words += (words.empty() ? "--" : " --") + name;
  }
  return words;
}

std::string names_of(const CLI::App& app) {
  std::string words;
  for (const CLI::App* command : commands_of(app)) words += (words.empty() ? "" : " ") + command->get_name();
  return words;
}

/// Completions that may follow a word, where that is neither a file nor a free text.
struct Choice {
  std::string word, values;
};

std::vector<Choice> all_choices() {
  std::string templates;
  for (const Task* task : registered_tasks()) templates += std::string(task->name) + " ";
  return {{"new", templates + "slurm"},
          {"completion", "bash zsh man"},
          {"docs", "start tutorial guide how-to keys results life accuracy gallery notation changes"},
          {"--helix-slope", "non-datum datum"},
          {"--rexs-version", "1.0 1.1 1.2 1.3 1.4 1.5 1.6 1.7 2.0"}};
}

/// Roff: backslashes, hyphens that are to stay hyphens, and no line that starts as a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += std::string("\\&") + c;
    else
      out += c;
  }
  return out;
}

std::string man_option(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "--" : ", --") + name;
  if (names.empty()) names = option.get_name();
  const bool takes_value = option.get_expected_max() > 0 && !option.get_lnames().empty() && option.get_items_expected_max() > 0;
  return fmt::format(".TP\n.B {}{}\n{}\n", roff(names), takes_value ? " VALUE" : "", roff(option.get_description()));
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string cases, values;
  for (const Choice& choice : all_choices()) {
    values += fmt::format("    {}) COMPREPLY=($(compgen -W \"{}\" -- \"$current\")); return ;;\n", choice.word, choice.values);
  }
  for (const CLI::App* command : commands_of(app)) {
    cases += fmt::format("    {}) options=\"{}\" ;;\n", command->get_name(), options_of(*command));
  }
  return fmt::format(R"(# bash completion for flankwright
_flankwright() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} options=""
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$current"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  case $previous in
{}  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -o bashdefault -F _flankwright flankwright
)",
                     names_of(app), cases, values);
}

std::string zsh_completion(const CLI::App& app) {
  std::string described, cases, values;
  for (const Choice& choice : all_choices()) values += fmt::format("    {}) compadd -- {}; return ;;\n", choice.word, choice.values);
  const auto quoted = [](std::string text) {
    for (std::size_t at = text.find('\''); at != std::string::npos; at = text.find('\'', at + 4)) text.replace(at, 1, "'\\''");
    return text;
  };
  for (const CLI::App* command : commands_of(app)) {
    described += fmt::format("    '{}:{}'\n", command->get_name(), quoted(command->get_description()));
    cases += fmt::format("    {}) options=({}) ;;\n", command->get_name(), options_of(*command));
  }
  return fmt::format(R"(#compdef flankwright
# zsh completion for flankwright
_flankwright() {{
  local -a commands options
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  case $words[2] in
{}  esac
  case $words[CURRENT-1] in
{}  esac
  if [[ $words[CURRENT] == -* ]]; then
    compadd -- $options
  else
    _files
  fi
}}
_flankwright "$@"
)",
                     described, cases, values);
}

std::string man_page(const CLI::App& app, const std::string& version) {
  std::string page = fmt::format(
      ".TH FLANKWRIGHT 1 \"\" \"flankwright {}\" \"User Commands\"\n.SH NAME\nflankwright \\- micro\\-geometry of involute gears\n"
      ".SH SYNOPSIS\n.B flankwright\n.I command\n[\n.I options\n]\n.SH DESCRIPTION\n.nf\n{}\n.fi\n.SH COMMANDS\n",
      version, roff(app.get_description()));
  for (const CLI::App* command : commands_of(app)) {
    page += fmt::format(".SS {}\n{}\n", roff(command->get_name()), roff(command->get_description()));
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_name() != "--help") page += man_option(*option);
    }
    if (!command->get_footer().empty()) page += ".PP\n.nf\n" + roff(command->get_footer()) + "\n.fi\n";
  }
  return page +
         ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 1\nthe study ran and a requirement was not met\n.TP\n.B 2\nthe input is wrong\n.TP\n.B 3\nan internal error\n"
         ".SH ENVIRONMENT\n.TP\n.B FLANKWRIGHT_CACHE\nfolder in which finite\\-element runs are kept; else XDG_CACHE_HOME/flankwright, else ~/.cache/flankwright\n";
}

}  // namespace flankwright::studies
