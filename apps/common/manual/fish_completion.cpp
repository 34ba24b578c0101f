// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/common/manual/lines.hpp"
#include "apps/common/manual/pages.hpp"

namespace ph::app {
namespace {

/// The text in single quotes, as fish reads it.
std::string fish_quoted(std::string_view text) {
  return fmt::format("'{}'", with_backslashes(text, "\\'"));
}

std::string fish_line(std::string_view command, const OptionText& option) {
  std::string line = fmt::format("complete -c {}", command);
  for (const std::string_view name : option.names)
    line += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                   : fmt::format(" -s {}", name.substr(1));
  const Values& values = option.values;
  if (!option.placeholder.empty()) line += values.is_file ? " -r" : " -x";
  if (values.is_file && values.extensions.empty()) line += " -F";
  std::string choices = fmt::format("{}", fmt::join(values.words, " "));
  // All files are offered, and files with the right ending come first. Each call of
  // __fish_complete_suffix lists all files, so the first call also determines the order of the
  // remaining files.
  for (const std::string& extension : values.extensions)
    choices += fmt::format("{}(__fish_complete_suffix {})", choices.empty() ? "" : " ", extension);
  if (!values.extensions.empty()) line += " -k";
  if (!choices.empty()) line += " -a " + fish_quoted(choices);  // mutant: completion-fish
  return fmt::format("{} -d {}\n", line, fish_quoted(option.brief()));
}

}  // namespace

std::string fish_completion(const Described& program) {
  std::string script = fmt::format(
      "# SPDX-License-Identifier: MIT\n"
      "# fish completion of {0}: what {0} --help fish prints.\n",
      program.command);
  for (const std::string_view word : program.manual.commands)
    script += fmt::format("complete -c {} -n __fish_is_first_token -a {}\n", program.command, word);
  for (const OptionText& option : program.options)
    if (!option.is_input) script += fish_line(program.command, option);
  return script;
}

}  // namespace ph::app
