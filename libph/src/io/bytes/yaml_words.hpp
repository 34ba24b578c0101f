// SPDX-License-Identifier: MIT
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/io/reader.hpp"

namespace ph::detail {

/// The first document of a YAML file in the part of YAML that programs write calibrations in:
/// mappings by indentation, plain and quoted words, lists as `[a, b]` or as `- a` a line, comments,
/// tags (not looked at). What has another form is an error, or left out where it stands for one
/// value.
class YamlWords {
 public:
  struct Word {
    std::string_view text;
    std::size_t line = 0, column = 0;
  };
  struct Value {
    std::size_t line = 0, column = 0;  ///< of its key
    std::vector<Word> words;           ///< one, or those of a list
  };

  /// @throws Error (bad_data) "name:line:column: …".
  explicit YamlWords(const Input& input);

  /// By path in lower case, the keys with dots between them; null if it is not there.
  const Value* find(std::string_view path) const;
  const Input& input() const { return input_; }

 private:
  struct Open {
    std::size_t indent;
    std::string path;
  };
  void take_line(std::string_view line);
  void take_key(std::string_view line, std::size_t indent);
  void take_value(Value& value, std::string_view rest, std::size_t column);
  void take_list(Value& value, std::string_view rest, std::size_t column);
  [[noreturn]] void fail(std::size_t column, const Fault& fault) const;

  const Input& input_;
  std::map<std::string, Value, std::less<>> values_;
  std::vector<Open> open_;        // keys whose lines may go on, each deeper than the last
  std::size_t number_ = 0;        // of the line at hand, from 1
  Value* list_ = nullptr;         // whose ']' is yet to come
  std::size_t block_indent_ = 0;  // of the key of a text of several lines
  bool in_block_ = false;
};

}  // namespace ph::detail
