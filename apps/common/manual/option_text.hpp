// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/manual/manual.hpp"
#include "apps/common/values/cli_names.hpp"

namespace ph::app {

/// The possible values of an option, as its placeholder states them. It is a list of alternatives,
/// separated by `|`:
///
/// * `auto`: a word, typed literally; `minkowski:P`: a word with a suffix,
/// * `FILE`: a path; `FILE.svg|.png`: a path with one of these endings,
/// * anything else (`N`, `LO,HI`): a value that cannot be completed.
struct Values {
  std::vector<std::string> words;       ///< "auto"; for `minkowski:P` "minkowski:"
  std::vector<std::string> extensions;  ///< ".svg"; none: any
  bool is_file = false;                 ///< it may be a path
};
Values values_of(std::string_view placeholder);

/// An option from the user's point of view.
struct OptionText {
  std::vector<std::string> names;     ///< "-o", "--output"; "INPUT" for the inputs
  std::string placeholder;            ///< placeholder of its value; empty: a flag
  std::string description;            ///< sentences, the last one without its full stop
  std::string topic;                  ///< name of a Topic
  Values values;                      ///< the alternatives that the placeholder states
  std::vector<std::string> excludes;  ///< related options, in alphabetical order
  bool is_input = false;
  bool is_repeatable = false;

  /// The first long name of the option, or the name of the inputs.
  const std::string& name() const;
  /// "-o,--output FILE"
  std::string head() const;
  /// The description, with the options that this option excludes.
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

/// The full description of a program; options without a group are left out.
/// @param command the name under which it was started, with or without a path.
Described described(const CLI::App& app, const Manual& manual, std::string_view command);

}  // namespace ph::app
