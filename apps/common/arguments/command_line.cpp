// SPDX-License-Identifier: MIT
#include "apps/common/arguments/command_line.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "apps/common/arguments/foreign_options.hpp"
#include "apps/common/arguments/options.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/manual/help_text.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/words.hpp"
#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/io/output_file.hpp"

namespace ph::app {
namespace {

/// All long names of a program's options, with their dashes.
std::vector<std::string> long_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

[[noreturn]] void reject_unknown(const CLI::App& app, const std::string& typed) {
  const std::string name = typed.substr(0, typed.find('='));
  const std::vector<std::string> known = long_names(app);
  const std::vector<std::string_view> views(known.begin(), known.end());
  // A name that was typed with one dash instead of two is also looked up.
  const std::string dashed = name.starts_with("--") ? name : "-" + name;
  std::string hint = hint_for_foreign_option(dashed, views);
  if (const auto near = nearest_name(dashed, views); hint.empty() && near)
    hint = fmt::format("did you mean '{}'?", *near);
  throw Error(ErrorKind::usage, fmt::format("unknown option '{}'; {}", name,
                                            hint.empty() ? "--help all lists the options" : hint));
}

/// Puts the message of CLI11 on one line.
std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// The message for a missing or repeated value, in the words of libph and with all names of the
/// option, such as "--threshold, --max-scale: the value is missing".
std::string about_values(const CLI::App& app, const std::string& text) {
  std::string names = text.substr(0, text.find(':'));
  if (const CLI::Option* option = app.get_option_no_throw(names)) {
    names.clear();
    for (const std::string& name : option->get_lnames())
      names += (names.empty() ? "--" : ", --") + name;
  }
  if (text.find("missing") != text.npos) return names + ": the value is missing";
  if (text.find("received") != text.npos) return names + ": found more than once, expected once";
  return one_line(text);
}

/// Returns a name such as "--output" or "INPUT".
std::string name_of(const CLI::Option& option) {
  const std::vector<std::string>& names = option.get_lnames();
  return names.empty() ? option.get_name() : "--" + names.front();
}

/// True if an option does not affect the result, but only how it is computed and which messages
/// appear.
bool is_common(const CLI::Option& option) {
  return option.get_group() == kLimitsTopic.name || option.get_group() == kMessagesTopic.name;
}

}  // namespace

void add_common_options(Options& options, CommonOptions& common) {
  // The effect of CLI11's own flag would depend on the order of the options. The flag is therefore
  // removed.
  options.cli().set_help_flag();
  options.topic(kLimitsTopic.name);
  options.value("--threads", "N", "threads to use (default: one for each core)",
                [&common](const std::string& text) {
                  common.threads = static_cast<int>(parse_integer("--threads", text, 1, 4096));
                });
  options.value("--memory-limit", "SIZE",
                "bytes the computation may take, such as 4GiB, 500MB or 1e9 (default: 90 % of the "
                "memory of the machine)",
                [&common](const std::string& text) {
                  common.memory_limit = parse_size("--memory-limit", text);
                });
  options.topic(kMessagesTopic.name);
  options.choice("--progress",
                 "progress on stderr (default auto: a bar on a terminal, else silent)",
                 common.progress);
  options.flag("--quiet", "no messages but errors", common.quiet);
  options.flag("--verbose", "say what was chosen and why", common.verbose);
  options.flag("--force", "write over an input, which is otherwise refused", common.force);
  options.flag("--version", "print the version and exit; with --verbose also what was built in",
               common.version);
  options
      .value("-h,--help", "[TOPIC]",
             "print the options of a topic, or those used most, and exit; all: all of them; man, "
             "markdown, bash, zsh, fish: a manual page, a reference page, completions for a shell",
             [&common](const std::string& topic) { common.help = topic; })
      ->expected(0, 1)
      ->default_str(std::string(kUsual))
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

std::vector<std::string> typed_command(std::string_view program, int argc,
                                       const char* const* argv) {
  std::vector<std::string> words{std::string(program)};
  words.insert(words.end(), argv + 1, argv + argc);
  return words;
}

std::vector<std::string> given_options(const Options& options,
                                       std::span<const std::string_view> without) {
  std::vector<std::string> words;
  for (const CLI::Option* option : options.cli().get_options()) {
    if (option->count() == 0 || option->get_lnames().empty() || is_common(*option)) continue;
    const std::string& name = option->get_lnames().front();
    if (std::ranges::find(without, name) != without.end()) continue;
    words.push_back("--" + name);
    if (option->get_items_expected_max() > 0)  // otherwise the option is a flag
      words.insert(words.end(), option->results().begin(), option->results().end());
  }
  return words;
}

std::optional<std::string> parse_command_line(Options& options, const CommonOptions& common,
                                              int argc, const char* const* argv,
                                              const Manual& manual) {
  CLI::App& app = options.cli();
  set_known_options(long_names(app));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    const std::vector<std::string> extras = app.remaining();
    for (const std::string& word : extras)
      if (word.starts_with('-')) reject_unknown(app, word);
    throw Error(ErrorKind::usage,
                fmt::format("unexpected argument '{}'", extras.empty() ? "" : extras.front()));
  } catch (const CLI::ArgumentMismatch& error) {
    throw Error(ErrorKind::usage, about_values(app, error.what()));
  } catch (const CLI::Error& error) {
    throw Error(ErrorKind::usage, one_line(error.what()));
  }
  if (common.help) return help_text(described(app, manual, argc > 0 ? argv[0] : ""), *common.help);
  if (common.quiet && common.verbose)
    throw Error(ErrorKind::usage,
                "--quiet: cannot be combined with --verbose; leave out one of them");
  if (common.version) {
    return program_and_version(app.get_name()) + "\n" +
           (common.verbose ? build_information() + manual.built_in() : "");
  }
  // The values of all options are checked, because a path such as /dev/fd/4 must not refer to a
  // descriptor that was not open at the start.
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results()) require_given(name_of(*option), value);
  return std::nullopt;
}

int answer_command_line(const std::string& answer) {
  write_file("-", answer);
  return kOk;
}

}  // namespace ph::app
