// SPDX-License-Identifier: MIT
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/io/reader.hpp"

namespace ph::detail {

/// The words in the first document of a YAML file. The class reads the part of YAML that
/// calibration files use. This part consists of mappings by indentation, plain and quoted words,
/// lists as `[a, b]` or with one `- a` per line, flat mappings `{a: 1, b: 2}` in one line,
/// comments, and tags (which are ignored). Other mappings in braces and blocks of text are skipped.
/// Any other form is an error.
class YamlWords {
 public:
  struct Word {
    std::string_view text;
    std::size_t line = 0, column = 0;
  };
  struct Value {
    std::size_t line = 0, column = 0;  ///< the place of the key
    std::vector<Word> words;           ///< one word, or the words of a list
  };

  /// Reads the words of an input. @throws Error (bad_data) with a message that begins with
  /// "name:line:column: ".
  explicit YamlWords(const Input& input);

  /// Finds a value by its path in lower case, with dots between keys. Returns null if the value
  /// does not exist.
  const Value* find(std::string_view path) const;
  /// The beginnings of all paths that end in this key: "" and "color." for `fx` and `color.fx`.
  std::vector<std::string> owners_of(std::string_view key) const;
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
  void take_mapping(std::string_view content, std::size_t column);
  Value& add(const std::string& path, std::size_t column);
  [[noreturn]] void fail(std::size_t column, const Fault& fault) const;

  const Input& input_;
  std::map<std::string, Value, std::less<>> values_;
  // The keys whose values may continue in the next line. Each key is indented more than the key
  // before.
  std::vector<Open> open_;
  std::size_t number_ = 0;        // the number of the current line, from 1
  Value* list_ = nullptr;         // a list whose ']' has not been read yet
  std::size_t block_indent_ = 0;  // the indentation of the key whose value is a block of text
  bool in_block_ = false;
};

}  // namespace ph::detail
