// SPDX-License-Identifier: MIT
#include "apps/common/manual/option_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "apps/common/manual/help_text.hpp"
#include "ph/error.hpp"

namespace ph::app {
namespace {

bool is_one_of(char c, std::string_view characters) {
  return characters.find(c) != std::string_view::npos;
}
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_word(std::string_view text) {
  const auto fits = [](char c) { return is_lower(c) || is_digit(c) || is_one_of(c, "-_:"); };
  return !text.empty() && text.front() != '-' && std::ranges::all_of(text, fits);
}

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  text.is_input = text.names.empty();
  if (text.is_input) text.names.push_back(option.get_name(true));
  if (!text.is_input && option.get_items_expected_max() > 0)
    text.placeholder = option.get_type_name();
  text.description = option.get_description();
  text.topic = option.get_group();
  text.values = values_of(text.placeholder);
  for (const CLI::Option* other : option.get_excludes())
    text.excludes.push_back("--" + other->get_lnames().front());
  std::ranges::sort(text.excludes);
  text.is_repeatable = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  return text;
}

/// The name of the program if shell scripts can contain it, otherwise the name in the manual.
std::string command_name(std::string_view started_as, const Manual& manual) {
  const std::string_view name = started_as.substr(started_as.rfind('/') + 1);
  const auto is_plain = [](char c) {
    return is_lower(c) || is_upper(c) || is_digit(c) || is_one_of(c, "-_.+");
  };
  const bool usable = !name.empty() && name[0] != '-' && std::ranges::all_of(name, is_plain);
  return std::string(usable ? name : manual.program);
}

}  // namespace

Values values_of(std::string_view placeholder) {
  constexpr std::string_view kFile = "FILE";
  Values values;
  while (!placeholder.empty()) {
    std::string_view part = placeholder.substr(0, placeholder.find('|'));
    placeholder.remove_prefix(std::min(part.size() + 1, placeholder.size()));
    if (part.starts_with(kFile)) {
      values.is_file = true;
      part.remove_prefix(kFile.size());
    }
    const std::size_t colon = part.find(':');
    if (part.starts_with('.'))
      values.extensions.emplace_back(part);
    else if (is_word(part))
      values.words.emplace_back(part);
    else if (colon != part.npos && is_word(part.substr(0, colon)))
      values.words.emplace_back(part.substr(0, colon + 1));  // mutant: completion-word
  }
  return values;
}

const std::string& OptionText::name() const {
  const auto is_long = [](const std::string& name) { return name.starts_with("--"); };
  const auto found = std::ranges::find_if(names, is_long);
  return found == names.end() ? names.front() : *found;
}

std::string OptionText::head() const {
  return fmt::format("{}{}{}{}", fmt::join(names, ","), is_input ? "..." : "",
                     placeholder.empty() ? "" : " ", placeholder);
}

std::string OptionText::text() const {
  if (excludes.empty()) return description;
  return fmt::format("{}; excludes {}", description, fmt::join(excludes, ", "));
}

std::string OptionText::brief() const {
  int open = 0;  // the number of open parentheses
  for (std::size_t i = 0; i < description.size(); ++i) {
    const std::string_view rest = std::string_view(description).substr(i);
    const bool ends = rest.starts_with("; ") || rest.starts_with(". ") ||
                      rest.starts_with(" (default ") || rest.starts_with(" (default:");
    if (ends && open == 0) return description.substr(0, i);
    open += rest[0] == '(' ? 1 : rest[0] == ')' ? -1 : 0;
  }
  return description;
}

std::vector<const OptionText*> Described::of(const Topic& topic) const {
  std::vector<const OptionText*> found;
  for (const OptionText& option : options)
    if (option.topic == topic.name) found.push_back(&option);
  return found;
}

const OptionText& Described::named(std::string_view name) const {
  const auto found =
      std::ranges::find_if(options, [&](const OptionText& o) { return o.name() == name; });
  if (found == options.end())
    throw Error(ErrorKind::internal, fmt::format("the manual names {}, which is no option", name));
  return *found;
}

Described described(const CLI::App& app, const Manual& manual, std::string_view command) {
  Described program{manual, command_name(command, manual), {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) program.options.push_back(text_of(*option));
  for (OptionText& option : program.options)
    if (option.name() == "--help")
      for (const std::string_view name : help_topics(manual))
        option.values.words.emplace_back(name);
  // Topics are in the order of the manual. Options within a topic are in the order of the program.
  const auto place = [&](const OptionText& option) {
    const auto found = std::ranges::find(manual.topics, option.topic, &Topic::name);
    if (found == manual.topics.end())
      throw Error(ErrorKind::internal,
                  fmt::format("{}: topic '{}' is not in the manual", option.name(), option.topic));
    return found;
  };
  std::ranges::stable_sort(program.options, {}, place);
  return program;
}

}  // namespace ph::app
