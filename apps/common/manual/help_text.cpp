// SPDX-License-Identifier: MIT
#include "apps/common/manual/help_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "apps/common/manual/lines.hpp"
#include "apps/common/manual/pages.hpp"
#include "apps/common/values/choices.hpp"

namespace ph::app {
namespace {

constexpr std::size_t kWidth = 80;  // the number of columns of a terminal
constexpr std::size_t kText = 27;   // the column of the text next to a name
constexpr std::string_view kAll = "all";

/// A topic whose text is for other programs instead of people.
struct Page {
  std::string_view name;
  std::string (*text)(const Described& program);
};
constexpr std::array kPages{Page{"man", man_page}, Page{"markdown", markdown_page},
                            Page{"bash", bash_completion}, Page{"zsh", zsh_completion},
                            Page{"fish", fish_completion}};

/// A name with a text next to it. The text is below the name if the name is long or has several
/// lines.
std::string entry(std::string_view name, std::string_view text) {
  std::string lines = fmt::format("  {}", name);
  std::size_t column = name.find('\n') == name.npos ? columns_of(lines) : kWidth;
  for (const std::string& line : wrapped(text, kWidth - kText)) {
    if (column + 2 > kText) {
      lines += '\n';
      column = 0;
    }
    lines += fmt::format("{:{}}{}\n", "", kText - column, line);
    column = 0;
  }
  return lines;
}

/// The names of an option and its placeholder, broken into lines if they are long.
std::string head_in_lines(const OptionText& option) {
  constexpr std::size_t kIndent = 8;
  const std::vector<std::string> lines = wrapped_list(option.head(), kWidth - kIndent);
  return fmt::format("{}", fmt::join(lines, fmt::format("\n{:{}}", "", kIndent)));
}

/// The names of an option and its placeholder on one line. Alternatives that do not fit are left
/// out.
std::string short_head(const OptionText& option) {
  constexpr std::size_t kEnough = 40;
  const std::vector<std::string> lines = wrapped_list(option.head(), kEnough);
  return lines.size() == 1 ? lines.front() : lines.front() + "…";
}

std::string usage(const Manual& manual) {
  std::string text;
  for (const std::string_view line : manual.usages)
    text += fmt::format("{:<7}{} {}\n", text.empty() ? "Usage:" : "", manual.program, line);
  return text + fmt::format("\n{}\n", fmt::join(wrapped(manual.paragraph, kWidth), "\n"));
}

std::string topic_text(const Described& program, const Topic& topic) {
  std::string text = fmt::format("{}\n", topic.title);
  for (const OptionText* option : program.of(topic))
    text += entry(head_in_lines(*option), option->text());
  return text;
}

std::string all_text(const Described& program) {
  std::string text = usage(program.manual);
  // mutant: help-topics
  for (const Topic& topic : program.manual.topics) text += "\n" + topic_text(program, topic);
  return text;
}

std::string usual_text(const Described& program) {
  const Manual& manual = program.manual;
  std::string text = usage(manual) + "\nOptions used most:\n";
  for (const std::string_view name : manual.usual) {
    const OptionText& option = program.named(name);
    text += entry(short_head(option), option.brief());
  }
  text += fmt::format("\nTopics: {} --help TOPIC lists the options of one, with their defaults.\n",
                      manual.program);
  for (const Topic& topic : manual.topics) text += entry(topic.name, topic.title);
  text += entry(kAll, fmt::format("all {} options", program.options.size()));
  text += entry("man, markdown", "the same as a manual page, as Markdown");
  text += entry("bash, zsh, fish", "completions for a shell");
  text += "\nExamples, to be tried in the folder of the source:\n";
  for (const Example& example : manual.examples)
    text += fmt::format("  {}\n      {}\n", example.command, example.what);
  return text;
}

}  // namespace

std::vector<std::string_view> help_topics(const Manual& manual) {
  std::vector<std::string_view> names;
  for (const Topic& topic : manual.topics) names.push_back(topic.name);
  names.push_back(kAll);
  for (const Page& page : kPages) names.push_back(page.name);
  return names;
}

std::string help_text(const Described& program, std::string_view topic) {
  if (topic == kUsual) return usual_text(program);
  const std::vector<std::string_view> names = help_topics(program.manual);
  const std::size_t place = choose("--help", topic, names);
  if (place < program.manual.topics.size())
    return topic_text(program, program.manual.topics[place]);
  if (topic == kAll) return all_text(program);
  return std::ranges::find(kPages, topic, &Page::name)->text(program);
}

}  // namespace ph::app
