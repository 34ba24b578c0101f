// SPDX-License-Identifier: MIT
// The text of a message may contain marks. A mark consists of a name, and optionally a value,
// between control characters, which printable text does not contain: kBegin, name, kValue, value,
// kEnd. The name is the name of a setting, or kPlace or kFound.
#include "ph/error.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace ph {
namespace {

constexpr char kBegin = '\x1e', kValue = '\x1d', kEnd = '\x1f';
constexpr std::string_view kPlace = "@place", kFound = "@found", kClause = "; ";

std::string marked(std::string_view name, std::string_view value) {
  std::string text(1, kBegin);
  text += name;
  if (!value.empty()) (text += kValue) += value;
  return text += kEnd;
}

/// A part of a text: a mark, or the text between two marks.
struct MessagePart {
  std::string_view text;            // the raw text, including the characters of a mark
  std::string_view name = {};       // the name of a mark, otherwise empty
  std::string_view value = {};      // the value of a mark
  Setting setting = Setting::none;  // the setting that the mark names
};

/// Calls `use` for all parts of a text in order. A mark that has no end counts as text.
template <class Use>
void each_piece(std::string_view text, Use&& use) {
  while (!text.empty()) {
    const std::size_t begin = text.find(kBegin);
    const std::size_t end = begin == text.npos ? text.npos : text.find(kEnd, begin);
    if (end == text.npos) {
      use(MessagePart{text});
      return;
    }
    if (begin > 0) use(MessagePart{text.substr(0, begin)});
    const std::string_view inside = text.substr(begin + 1, end - begin - 1);
    const std::size_t value = std::min(inside.find(kValue), inside.size());
    const std::string_view name = inside.substr(0, value);
    use(MessagePart{text.substr(begin, end + 1 - begin), name,
                    inside.substr(std::min(value + 1, inside.size())),
                    value_named<Setting>(name).value_or(Setting::none)});
    text.remove_prefix(end + 1);
  }
}

/// The end of the first clause of a text, or npos if there is only one clause. A "; " inside a
/// mark, such as a file name, does not end a clause.
std::size_t end_of_clause(std::string_view text) {
  for (std::size_t at = 0;;) {
    const std::size_t clause = text.find(kClause, at), begin = text.find(kBegin, at);
    const std::size_t end = begin < clause ? text.find(kEnd, begin) : text.npos;
    if (end == text.npos) return clause;
    at = end + 1;
  }
}

/// Calls `use` for the clauses of a text, which are separated by "; ".
template <class Use>
void each_clause(std::string_view text, Use&& use) {
  for (bool is_first = true;; is_first = false) {
    const std::size_t end = end_of_clause(text);
    use(text.substr(0, end), is_first);
    if (end == text.npos) return;
    text.remove_prefix(end + kClause.size());
  }
}

std::string neutral(Setting setting, std::string_view value) {
  std::string text(name_of(setting));
  if (!value.empty()) (text += ' ') += alternatives(value);
  return text;
}

/// The text of all parts, where the words of a program replace the marks. @return nothing if the
/// text contains a setting for which the program has no name.
std::optional<std::string> rendered(std::string_view text, const Words& words) {
  std::string result;
  bool has_words = true;
  each_piece(text, [&](const MessagePart& piece) {
    if (piece.setting != Setting::none) {
      const std::string of_setting = words.setting(piece.setting, piece.value);
      has_words = has_words && !of_setting.empty();
      result += of_setting;
    } else if (piece.name == kPlace || piece.name == kFound) {
      result += piece.value;
    } else {
      result += piece.text;
    }
  });
  if (!has_words) return std::nullopt;
  return result;
}

std::string marked_value(std::string_view text, std::string_view name) {
  std::optional<std::string> value;
  each_piece(text, [&](const MessagePart& piece) {
    if (piece.name == name && !value) value = piece.value;
  });
  return value.value_or("");
}

}  // namespace

std::string alternatives(std::string_view values, std::string_view quote) {
  std::string text;
  for (bool is_first = true;; is_first = false) {
    const std::size_t end = values.find('|');
    if (!is_first) text += end == values.npos ? " or " : ", ";
    ((text += quote) += values.substr(0, end)) += quote;
    if (end == values.npos) return text;
    values.remove_prefix(end + 1);
  }
}

std::string mark(Setting setting, std::string_view value) {
  return marked(name_of(setting), value);
}
std::string mark_place(std::string_view place) { return marked(kPlace, place); }
std::string mark_found(std::string_view found) { return marked(kFound, found); }

std::string Message::str() const { return in_words({&neutral}); }

std::string Message::in_words(const Words& words) const {
  if (marked_.find(kBegin) == marked_.npos) return marked_;
  std::string text;
  each_clause(marked_, [&](std::string_view clause, bool is_first) {
    const std::optional<std::string> part = rendered(clause, words);
    if (is_first)
      text = part ? *part : rendered(clause, {&neutral}).value_or("");
    else if (part)
      (text += kClause) += *part;
  });
  return text;
}

Message Message::without(Setting setting) const {
  std::string text;
  each_clause(marked_, [&](std::string_view clause, bool is_first) {
    bool has_it = false;
    each_piece(clause, [&](const MessagePart& piece) { has_it |= piece.setting == setting; });
    if (is_first)
      text = clause;
    else if (!has_it)
      (text += kClause) += clause;
  });
  return text;
}

Message Message::without_place() const {
  std::string text;
  bool is_first = true, follows = false;
  each_piece(marked_, [&](const MessagePart& piece) {
    std::string_view part = piece.text;
    if (std::exchange(follows, false) && part.starts_with(": ")) part.remove_prefix(2);
    if (std::exchange(is_first, false) && piece.name == kPlace)
      follows = true;
    else
      text += part;
  });
  return text;
}

std::vector<Remedy> Message::remedies() const {
  std::vector<Remedy> all;
  each_clause(marked_, [&](std::string_view clause, bool is_first) {
    if (is_first) return;
    each_piece(clause, [&](const MessagePart& piece) {
      if (piece.setting == Setting::none) return;
      for (std::string_view rest = piece.value;;) {
        const std::size_t end = rest.find('|');
        all.push_back({piece.setting, std::string(rest.substr(0, end))});
        if (end == rest.npos) return;
        rest.remove_prefix(end + 1);
      }
    });
  });
  return all;
}

std::string Message::place() const { return marked_value(marked_, kPlace); }
std::string Message::found() const { return marked_value(marked_, kFound); }

bool Message::is_about(std::string_view name) const {
  const std::string where = place();
  return !name.empty() && where.starts_with(name) &&
         (where.size() == name.size() || where[name.size()] == ':');
}

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(Message(message).str()), kind_(kind) {
  if (message.find(kBegin) != message.npos) marked_ = std::make_shared<const std::string>(message);
}

Message Error::message() const { return marked_ ? Message(*marked_) : Message(what()); }

}  // namespace ph
