// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ph::app {

/// A group of options, which `--help NAME` shows.
struct Topic {
  std::string_view name;   ///< "rips"; an option says its topic by it
  std::string_view title;  ///< "Rips complexes"
};

/// Those that all programs have, the last ones of each.
inline constexpr Topic kLimitsTopic{"limits", "Threads and memory"};
inline constexpr Topic kMessagesTopic{"messages", "Messages, version, help"};

/// A command line that runs in the root of the repository.
struct Example {
  std::string_view command;  ///< whole, with the name of the program
  std::string_view what;     ///< it gives: a sentence without its full stop
};

/// A format of files.
struct FormatText {
  std::string_view name, what;
  std::string_view example;  ///< a line of it, or nothing
};
struct FormatList {
  std::string title;
  std::vector<FormatText> formats;
};

/// What a program says of itself beside its options. Help texts, manual page, reference page and
/// completions are made of it and of the options.
struct Manual {
  std::string_view program;
  std::string_view phrase;                     ///< "barcodes of points and images"
  std::string_view paragraph;                  ///< what it does, from what, to what
  std::span<const std::string_view> usages;    ///< what may follow its name, a line each
  std::span<const std::string_view> commands;  ///< words in place of the first input: "plot"
  std::span<const Topic> topics;               ///< in the order in which they are shown
  std::span<const std::string_view> usual;     ///< options used most, by long name, with dashes
  std::span<const Example> examples;
  std::vector<FormatList> (*formats)();
  std::string_view see_also;  ///< another program of libph
  std::string (*built_in)();  ///< lines that --version --verbose adds
};

}  // namespace ph::app
