// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/common/manual/lines.hpp"
#include "apps/common/manual/pages.hpp"

namespace ph::app {
namespace {

constexpr std::string_view kZshFrame =
    R"(#compdef {command}
# SPDX-License-Identifier: MIT
# zsh completion of {command}: what {command} --help zsh prints.
_{command}() {{
  _arguments -s -S : \
{specs}
}}
if [[ $funcstack[1] == _{command} ]]; then
  _{command} "$@"
else
  compdef _{command} {command}
fi
)";

/// The completion of a value, which is the part after `message:` in a specification of _arguments.
std::string zsh_action(const Values& values) {
  std::string files = "_files";
  if (!values.extensions.empty()) {
    std::vector<std::string_view> endings;
    for (const std::string_view extension : values.extensions)
      endings.push_back(extension.substr(1));
    files = fmt::format("_files -g \"*.({})\"", fmt::join(endings, "|"));
  }
  if (values.words.empty()) return values.is_file ? files : " ";
  // A word such as `minkowski:` is only the beginning of a value.
  std::string whole, begun;
  for (const std::string& word : values.words)
    (word.ends_with(':') ? begun : whole) += " " + with_backslashes(word, ":");
  if (begun.empty() && !values.is_file) return fmt::format("({})", whole.substr(1));
  std::string action = fmt::format("compadd --{}", whole);
  if (!begun.empty()) action += fmt::format("; compadd -S \"\" --{}", begun);
  if (values.is_file) action += "; " + files;
  return fmt::format("{{{}}}", action);
}

std::string zsh_value(const OptionText& option) {
  if (option.placeholder.empty()) return "";
  const Values& values = option.values;
  std::string text;
  // A placeholder of several words represents several values.
  for (const std::string_view word : words_of(option.placeholder)) {
    const std::string_view message = values.is_file         ? "file"
                                     : values.words.empty() ? word
                                                            : "value";
    text += fmt::format(":{}:{}", with_backslashes(message, ":"), zsh_action(values));
  }
  return text;
}

/// Returns a specification such as "'(-o --output)'{-o+,--output=}'[where the barcode
/// goes]:file:_files'".
std::string zsh_spec(const OptionText& option) {
  if (option.is_input) return fmt::format("'*:{}:_files'", option.name());
  std::vector<std::string> excluded = option.excludes, typed;
  if (option.names.size() > 1)
    excluded.insert(excluded.end(), option.names.begin(), option.names.end());
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    typed.push_back(name + (option.placeholder.empty() ? "" : is_long ? "=" : "+"));
  }
  const std::string rest = shell_quoted(
      fmt::format("[{}]{}", with_backslashes(option.brief(), "[]:"), zsh_value(option)));
  // mutant: completion-zsh
  std::string spec = option.is_repeatable ? "'*'" : "";
  if (!option.is_repeatable && !excluded.empty())
    spec = fmt::format("'({})'", fmt::join(excluded, " "));
  if (typed.size() == 1) return fmt::format("{}{}{}", spec, typed.front(), rest);
  return fmt::format("{}{{{}}}{}", spec, fmt::join(typed, ","), rest);
}

}  // namespace

std::string zsh_completion(const Described& program) {
  std::vector<std::string> specs;
  for (const OptionText& option : program.options) specs.push_back("    " + zsh_spec(option));
  if (!program.manual.commands.empty())
    specs.push_back(fmt::format("    '1:command:{{compadd -- {}; _files}}'",
                                fmt::join(program.manual.commands, " ")));
  return fmt::format(kZshFrame, fmt::arg("command", program.command),
                     fmt::arg("specs", fmt::join(specs, " \\\n")));
}

}  // namespace ph::app
