// SPDX-License-Identifier: MIT
#include "libph/src/io/bytes/yaml_words.hpp"
#include "ph/detail/core/lower_case.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ph::detail {
namespace {

constexpr std::size_t kShown = 40;
constexpr std::string_view kBlank = " \t";

std::string quoted(std::string_view text) { return '"' + printable(text, kShown) + '"'; }

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// The line without the comment at its end. A comment starts at a # that begins a word outside
/// quotes.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if ((c == '"' || c == '\'') && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '['))
      quote = c;
    else if (c == '#' && (i == 0 || kBlank.find(line[i - 1]) != kBlank.npos))
      return line.substr(0, i);
  }
  return line;
}

std::string_view unquoted(std::string_view word) {
  const bool has = word.size() >= 2 && word.front() == word.back() &&
                   (word.front() == '"' || word.front() == '\'');
  return has ? word.substr(1, word.size() - 2) : word;
}

}  // namespace

YamlWords::YamlWords(const Input& input) : input_(input) {
  const std::string_view text = input.text();
  if (const std::size_t nul = text.find('\0'); nul != text.npos)
    input.fail_at_byte(nul, {"not plain text", "a NUL byte", "YAML", {}});
  for (std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.starts_with("---") || line.starts_with("...")) {
      if (!values_.empty()) break;  // another document starts here
      continue;
    }
    if (!line.starts_with('%')) take_line(line);
  }
  if (list_ != nullptr)
    fail(1, {"list without an end", "the end of the file", "']'", "is the file truncated?"});
}

const YamlWords::Value* YamlWords::find(std::string_view path) const {
  const auto found = values_.find(path);
  return found == values_.end() ? nullptr : &found->second;
}

std::vector<std::string> YamlWords::owners_of(std::string_view key) const {
  std::vector<std::string> owners;
  for (const auto& [path, value] : values_)
    if (path == key || (path.ends_with(key) && path[path.size() - key.size() - 1] == '.'))
      owners.push_back(path.substr(0, path.size() - key.size()));
  return owners;
}

void YamlWords::fail(std::size_t column, const Fault& fault) const {
  input_.fail_at(number_, column, fault);
}

void YamlWords::take_line(std::string_view line) {
  const std::string_view content = without_comment(line);
  const std::size_t indent = content.find_first_not_of(' ');
  if (trimmed(content).empty()) return;
  if (list_ != nullptr) return take_list(*list_, content, 1);
  if (in_block_ && indent > block_indent_) return;
  in_block_ = false;
  if (content[indent] == '\t')
    fail(indent + 1, {"a tab before a key", {}, "blanks", "YAML is indented with blanks"});
  const std::string_view rest = content.substr(indent);
  // This line is an item of a list. It belongs to the last key that is not indented more than the
  // item.
  if (rest == "-" || rest.starts_with("- ")) {
    while (!open_.empty() && open_.back().indent > indent) open_.pop_back();
    if (open_.empty()) fail(indent + 1, {"list", quoted(rest), "a key before it", {}});
    const std::size_t first = std::min(rest.find_first_not_of(' ', 1), rest.size());
    const std::string_view word = trimmed(rest.substr(first));
    values_.at(open_.back().path).words.push_back({unquoted(word), number_, indent + first + 1});
    return;
  }
  take_key(content, indent);
}

void YamlWords::take_key(std::string_view line, std::size_t indent) {
  const std::string_view content = line.substr(indent);
  std::size_t colon = content.find(':');
  while (colon != content.npos && colon + 1 < content.size() &&
         kBlank.find(content[colon + 1]) == kBlank.npos)
    colon = content.find(':', colon + 1);
  if (colon == content.npos || colon == 0) {
    fail(indent + 1, {"not a key with a value", quoted(trimmed(content)), "KEY: VALUE", {}});
  }
  while (!open_.empty() && open_.back().indent >= indent) open_.pop_back();
  std::string path = open_.empty() ? std::string() : open_.back().path + ".";
  path += lower_case(unquoted(trimmed(content.substr(0, colon))));
  Value& value = add(path, indent + 1);
  open_.push_back({indent, std::move(path)});
  take_value(value, content.substr(colon + 1), indent + colon + 2);
}

YamlWords::Value& YamlWords::add(const std::string& path, std::size_t column) {
  const auto [entry, is_new] = values_.emplace(path, Value{number_, column, {}});
  if (!is_new) {
    fail(column, {"a repeated key",
                  printable(path, kShown),
                  fmt::format("it only in line {}", entry->second.line),
                  {}});
  }
  return entry->second;
}

void YamlWords::take_value(Value& value, std::string_view rest, std::size_t column) {
  const auto skip_blanks = [&] {
    const std::size_t first = std::min(rest.find_first_not_of(kBlank), rest.size());
    rest.remove_prefix(first);
    column += first;
  };
  skip_blanks();
  if (rest.starts_with('!')) {  // a tag gives the type of the value
    const std::size_t length = std::min(rest.find_first_of(kBlank), rest.size());
    rest.remove_prefix(length);
    column += length;
    skip_blanks();
  }
  if (rest.empty()) return;  // the value is in the next lines
  if (rest.front() == '[') return take_list(value, rest.substr(1), column + 1);
  if (rest.front() == '|' || rest.front() == '>') {
    in_block_ = true;
    block_indent_ = open_.back().indent;
    return;
  }
  if (rest.front() == '{') {
    if (trimmed(rest).back() != '}')
      fail(column, {"mapping in braces", quoted(rest), "'}' at the end of the line", {}});
    rest = trimmed(rest);
    return take_mapping(rest.substr(1, rest.size() - 2), column + 1);
  }
  if (rest.front() == '&' || rest.front() == '*')
    fail(column, {"anchor or alias", quoted(trimmed(rest)), "a value", "write the value itself"});
  value.words.push_back({unquoted(trimmed(rest)), number_, column});
}

/// Takes the keys and the values of a mapping in braces, unless it contains lists, mappings or
/// quotes.
void YamlWords::take_mapping(std::string_view content, std::size_t column) {
  if (content.find_first_of("{}[]\"'") != content.npos) return;
  for (std::size_t at = 0; at <= content.size();) {
    const std::size_t length = std::min(content.find(',', at), content.size()) - at;
    const std::string_view part = content.substr(at, length);
    const std::size_t colon = part.find(": ");
    if (colon != part.npos && !trimmed(part.substr(0, colon)).empty()) {
      const std::size_t place = column + at + part.find_first_not_of(kBlank);
      Value& value =
          add(open_.back().path + "." + lower_case(trimmed(part.substr(0, colon))), place);
      value.words.push_back({trimmed(part.substr(colon + 1)), number_, place});
    }
    at += length + 1;
  }
}

/// Takes the words of a list up to the end of the list or of the line.
void YamlWords::take_list(Value& value, std::string_view rest, std::size_t column) {
  list_ = &value;
  while (true) {
    const std::size_t first = std::min(rest.find_first_not_of(kBlank), rest.size());
    rest.remove_prefix(first);
    column += first;
    if (rest.empty()) return;  // the list continues
    const std::size_t length = std::min(rest.find_first_of(",]"), rest.size());
    const std::string_view word = trimmed(rest.substr(0, length));
    const bool ends = length < rest.size() && rest[length] == ']';
    if (!word.empty())
      value.words.push_back({unquoted(word), number_, column});
    else if (!ends)
      fail(column, {"empty element of a list", quoted(rest), "a value", {}});
    rest.remove_prefix(std::min(length + 1, rest.size()));
    column += length + 1;
    if (!ends) continue;
    list_ = nullptr;
    if (!trimmed(rest).empty())
      fail(column, {"text after a list", quoted(trimmed(rest)), "the end of the line", {}});
    return;
  }
}

}  // namespace ph::detail
