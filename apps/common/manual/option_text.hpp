// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/manual/manual.hpp"
#include "apps/common/values/cli_names.hpp"

namespace ph::app {

/// The possible values of an option, as its placeholder states them. The placeholder is a list of
/// alternatives, separated by `|`. Each alternative has one of these forms:
///
/// * `auto` is a word, typed literally; `minkowski:P` is a word with a suffix,
/// * `FILE` is a path; `FILE.svg|.png` is a path with one of these endings,
/// * anything else (`N`, `LO,HI`) is a value that cannot be completed.
struct Values {
  /// Such as "auto"; for `minkowski:P`, the word is "minkowski:".
  std::vector<std::string> words;
  /// Such as ".svg"; if there are none, any extension is accepted.
  std::vector<std::string> extensions;
  bool is_file = false;  ///< true if the value may be a path
};
Values values_of(std::string_view placeholder);

/// An option from the user's point of view.
struct OptionText {
  /// Such as "-o" and "--output"; "INPUT" for the inputs.
  std::vector<std::string> names;
  /// The placeholder of the value; empty if the option is a flag.
  std::string placeholder;
  /// Sentences, of which the last has no full stop.
  std::string description;
  std::string topic;                  ///< the name of a Topic
  Values values;                      ///< the alternatives that the placeholder states
  std::vector<std::string> excludes;  ///< options that it cannot be combined with, sorted by name
  bool is_input = false;
  bool is_repeatable = false;

  /// The first long name of the option, or the name of the inputs.
  const std::string& name() const;
  /// Returns a text such as "-o,--output FILE".
  std::string head() const;
  /// The description, with the options that this option cannot be combined with.
  std::string text() const;
  /// The first part of the description, which does not state the default.
  std::string brief() const;
};

/// A program with its options.
struct Described {
  const Manual& manual;
  std::string command;              ///< the name under which it was started
  std::vector<OptionText> options;  ///< sorted by topic

  /// The options of a topic, in the order in which they were registered.
  std::vector<const OptionText*> of(const Topic& topic) const;
  /// @throws Error (internal) if there is no topic of this name.
  const OptionText& named(std::string_view name) const;
};

/// The full description of a program. Options without a group are left out.
/// @param command the name under which it was started, with or without a path.
Described described(const CLI::App& app, const Manual& manual, std::string_view command);

}  // namespace ph::app
