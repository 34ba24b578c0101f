// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// A group of options, which `--help NAME` shows.
struct Topic {
  std::string_view name;   ///< such as "rips"; options refer to their topic by this name
  std::string_view title;  ///< such as "Rips complexes"
};

/// The topics that all programs have. They come last in each program.
inline constexpr Topic kLimitsTopic{"limits", "Threads and memory"};
inline constexpr Topic kMessagesTopic{"messages", "Messages, version, help"};

/// A command line that can be run in the root of the repository.
struct Example {
  std::string_view command;  ///< the whole command, with the name of the program
  std::string_view what;     ///< the effect of the command, as a sentence without its full stop
};

/// A format of files.
struct FormatText {
  std::string_view name, what;
  std::string_view example;  ///< a line in this format, or empty
};
struct FormatList {
  std::string title;
  std::vector<FormatText> formats;
};

/// The description of a program, without its options. Help texts, the manual page, the reference
/// page and completions are made from this description and the options.
struct Manual {
  std::string_view program;
  std::string_view phrase;  ///< such as "barcodes of points and images"
  /// What the program computes, from which input, to which output.
  std::string_view paragraph;
  /// The command lines that the program accepts, one per line.
  std::span<const std::string_view> usages;
  /// Words that may replace the first input, such as "plot".
  std::span<const std::string_view> commands;
  std::span<const Topic> topics;            ///< in the order in which they are shown
  std::span<const std::string_view> usual;  ///< the most common options, by long name, with dashes
  std::span<const Example> examples;
  std::vector<FormatList> (*formats)();
  std::string_view see_also;  ///< another program of libph
  std::string (*built_in)();  ///< lines that --version --verbose adds
};

}  // namespace ph::app
