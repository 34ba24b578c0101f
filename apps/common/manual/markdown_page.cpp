// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/common/manual/lines.hpp"
#include "apps/common/manual/pages.hpp"

namespace ph::app {
namespace {

constexpr std::size_t kMarkdownWidth = 100;

/// The option that a word begins with, such as "--voxel" in "--voxel;".
std::string_view option_in(std::string_view word) {
  if (!word.starts_with("--") || word.size() < 3) return {};
  const auto is_part = [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; };
  const auto end = std::ranges::find_if_not(word, is_part);
  return word.substr(0, static_cast<std::size_t>(end - word.begin()));
}

/// A text, broken into lines, in which the names of options are references. Characters with a
/// meaning in Markdown are escaped.
std::string markdown_text(const Described& program, std::string_view text) {
  std::string marked;
  for (std::string_view word : words_of(text)) {
    if (!marked.empty()) marked += ' ';
    if (word.starts_with('(')) {
      marked += '(';
      word.remove_prefix(1);
    }
    if (const std::string_view option = option_in(word); !option.empty()) {
      marked += fmt::format("{{option}}`{0}<{1} {0}>`", option, program.manual.program);
      word.remove_prefix(option.size());
    }
    marked += with_backslashes(word, "\\*_[]<>#~^");
  }
  return fmt::format("{}", fmt::join(wrapped(marked, kMarkdownWidth), "\n"));
}

std::string option_entry(const Described& program, const OptionText& option) {
  std::string heads;
  for (const std::string& name : option.names) {
    if (!heads.empty()) heads += ", ";
    heads += name;
    if (!option.placeholder.empty()) heads += " " + option.placeholder;
  }
  return fmt::format("```{{option}} {}\n\n{}\n```\n\n", heads,
                     markdown_text(program, option.text() + "."));
}

}  // namespace

std::string markdown_page(const Described& program) {
  const Manual& manual = program.manual;
  std::string page = fmt::format("# Options of `{}`\n\n", manual.program);
  page += markdown_text(program, manual.paragraph) + "\n\n```text\n";
  for (const std::string_view usage : manual.usages)
    page += fmt::format("{} {}\n", manual.program, usage);
  page += fmt::format("```\n\n```{{program}} {}\n```\n\n", manual.program);
  for (const Topic& topic : manual.topics) {
    page += fmt::format("## {}\n\n", topic.title);
    for (const OptionText* option : program.of(topic))
      page += option->is_input ? fmt::format("`{}`: {}.\n\n", option->head(),
                                             markdown_text(program, option->text()))
                               : option_entry(program, *option);
  }
  page += "## Examples\n";
  for (const Example& example : manual.examples)
    page += fmt::format("\n{}:\n\n```sh\n{}\n```\n", example.what, example.command);
  return page;
}

}  // namespace ph::app
