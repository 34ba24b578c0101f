// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/common/manual/lines.hpp"
#include "apps/common/manual/pages.hpp"

namespace ph::app {
namespace {

// mutant: completion-bash
constexpr std::string_view kFrame =
    R"(# SPDX-License-Identifier: MIT
# bash completion of {command}: what {command} --help bash prints.
{function}()
{{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
  local words= files= endings= ending
  # --option=value is three words of bash.
  if [[ $word == = ]]; then
    word=
  elif [[ $before == = ]]; then
    before=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  COMPREPLY=()
  case $before in
{cases}    *)
      if [[ $word == -* ]]; then
        words={options}
{commands}      fi
      ;;
  esac
  # Without an answer bash completes the names of files.
  [[ $files || $endings ]] && compopt -o filenames 2>/dev/null
  if [[ $files ]]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  elif [[ $endings ]]; then
    mapfile -t COMPREPLY < <(
      for ending in $endings; do compgen -f -X "!*$ending" -- "$word"; done
      compgen -d -- "$word")
  fi
  [[ $words ]] && mapfile -t -O ${{#COMPREPLY[@]}} COMPREPLY < <(compgen -W "$words" -- "$word")
  [[ ${{#COMPREPLY[@]}} == 1 && ${{COMPREPLY[0]}} == *: ]] && compopt -o nospace 2>/dev/null
  return 0
}}
complete -o bashdefault -o default -F {function} {command}
)";

/// The words that may follow an option with a value.
std::string bash_case(const OptionText& option) {
  const Values& values = option.values;
  std::string body;
  if (!values.words.empty())
    body += fmt::format("      words={}\n",
                        shell_quoted(fmt::format("{}", fmt::join(values.words, " "))));
  if (!values.extensions.empty())
    body += fmt::format("      endings={}\n",
                        shell_quoted(fmt::format("{}", fmt::join(values.extensions, " "))));
  if (!values.words.empty() && values.is_file && values.extensions.empty())
    body += "      files=yes\n";
  if (values.words.empty() && !values.is_file)
    body += "      compopt +o default +o bashdefault 2>/dev/null\n";
  return fmt::format("    {})\n{}      ;;\n", fmt::join(option.names, "|"), body);
}

std::string function_name(std::string name) {
  for (char& c : name)
    if (c == '-' || c == '.' || c == '+') c = '_';
  return "_" + name;
}

}  // namespace

std::string bash_completion(const Described& program) {
  std::string cases;
  std::vector<std::string_view> names;
  for (const OptionText& option : program.options) {
    if (option.is_input) continue;
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (!option.placeholder.empty()) cases += bash_case(option);
  }
  std::string commands;
  if (!program.manual.commands.empty())
    commands = fmt::format(
        "      elif [[ $COMP_CWORD == 1 ]]; then\n"
        "        files=yes\n"
        "        words={}\n",
        shell_quoted(fmt::format("{}", fmt::join(program.manual.commands, " "))));
  return fmt::format(kFrame, fmt::arg("command", program.command),
                     fmt::arg("function", function_name(program.command)), fmt::arg("cases", cases),
                     fmt::arg("commands", commands),
                     fmt::arg("options", shell_quoted(fmt::format("{}", fmt::join(names, " ")))));
}

}  // namespace ph::app
