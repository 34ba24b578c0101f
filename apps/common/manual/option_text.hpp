// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "common/arguments/cli_names.hpp"
#include "common/manual/manual.hpp"

namespace ph::app {

/// What the value of an option may be, as its placeholder tells. That is a list of alternatives,
/// separated by `|`:
///
/// * `auto`: a word, typed as it stands; `minkowski:P`: a word with something behind it,
/// * `FILE`: a path; of `FILE.svg|.png` one that ends so,
/// * anything else (`N`, `LO,HI`): what nobody can guess.
struct Values {
  std::vector<std::string> words;       ///< "auto"; of `minkowski:P` "minkowski:"
  std::vector<std::string> extensions;  ///< ".svg"; none: any
  bool is_file = false;                 ///< it may be a path
};
Values values_of(std::string_view placeholder);

/// An option as its users see it.
struct OptionText {
  std::vector<std::string> names;     ///< "-o", "--output"; of the inputs "INPUT"
  std::string placeholder;            ///< of its value; empty: a flag
  std::string description;            ///< sentences, the last one without its full stop
  std::string topic;                  ///< name of a Topic
  Values values;                      ///< what the placeholder says
  std::vector<std::string> excludes;  ///< other options, in the order of the alphabet
  bool is_input = false;
  bool is_repeatable = false;

  /// Its first long name, or that of the inputs.
  const std::string& name() const;
  /// "-o,--output FILE"
  std::string head() const;
  /// The description, with what it excludes.
  std::string text() const;
  /// The first part of the description, without its default.
  std::string brief() const;
};

/// A program with its options.
struct Described {
  const Manual& manual;
  std::string command;              ///< the name under which it was started
  std::vector<OptionText> options;  ///< by topic

  /// The options of a topic, in the order in which they were registered.
  std::vector<const OptionText*> of(const Topic& topic) const;
  /// @throws Error (internal) if there is none of this name.
  const OptionText& named(std::string_view name) const;
};

/// All that is known of a program; options without a group are left out.
/// @param command what it was started as, with or without a path.
Described described(const CLI::App& app, const Manual& manual, std::string_view command);

}  // namespace ph::app
