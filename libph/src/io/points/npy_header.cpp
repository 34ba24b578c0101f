// SPDX-License-Identifier: MIT
#include "libph/src/io/points/npy_header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "libph/src/io/bytes/readers.hpp"

namespace ph::detail {
namespace {

// Reads a header, which is a Python dictionary with three known keys.
class HeaderParser {
 public:
  HeaderParser(const Input& input, std::size_t begin, std::size_t end)
      : input_(input), position_(begin), end_(end) {}

  NpyHeader parse() {
    NpyHeader header;
    bool descr = false, order = false, shape = false;
    expect('{');
    while (!accept('}')) {
      const std::size_t at = position_;
      const std::string key = string();
      expect(':');
      if (key == "descr" && !descr) {
        if (peek() == '[') {
          header.fields = fields(header.record);
        } else {
          header.descr = string();
        }
        descr = true;
      } else if (key == "fortran_order" && !order) {
        header.fortran_order = boolean();
        order = true;
      } else if (key == "shape" && !shape) {
        header.shape = tuple();
        shape = true;
      } else {
        fail(at, "unknown key", printable(key, 40), "descr, fortran_order and shape, once each");
      }
      if (!accept(',') && peek() != '}') fail(position_, "NPY header", found(), "',' or '}'");
    }
    if (!descr || !order || !shape) {
      fail(position_, "incomplete NPY header", "", "descr, fortran_order and shape");
    }
    skip();
    if (position_ != end_) fail(position_, "NPY header", found(), "its end");
    return header;
  }

 private:
  static constexpr std::size_t npos = std::string_view::npos;
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20;  // of a record

  [[noreturn]] void fail(std::size_t at, std::string what, std::string what_found,
                         std::string expected) const {
    input_.fail_at_byte(at, {std::move(what), std::move(what_found), std::move(expected), {}});
  }
  std::string found() const {
    return position_ < end_ ? printable(input_.text().substr(position_, 1)) : "its end";
  }
  void skip() {
    while (position_ < end_ &&
           std::string_view(" \t\r\n").find(input_.text()[position_]) != std::string_view::npos) {
      ++position_;
    }
  }
  char peek() {
    skip();
    return position_ < end_ ? input_.text()[position_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c || position_ == end_) return false;
    ++position_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(position_, "NPY header", found(), fmt::format("'{}'", c));
  }
  std::string string() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') {
      fail(position_, "NPY header", found(), "a quoted word");
    }
    const std::size_t begin = ++position_;
    while (position_ < end_ && input_.text()[position_] != quote) ++position_;
    if (position_ == end_) fail(begin, "NPY header", "no closing quote", "one");
    return std::string(input_.text().substr(begin, position_++ - begin));
  }
  // The fields of a structured array: a list of ('name', 'type') or ('name', 'type', (sizes)).
  // Adds up the bytes of a record.
  std::vector<NpyField> fields(std::size_t& offset) {
    std::vector<NpyField> fields;
    expect('[');
    while (!accept(']')) {
      expect('(');
      const std::size_t at = position_;
      NpyField field{string(), {}, 1, offset};
      expect(',');
      const std::size_t place = position_;
      if (peek() == '[') fail(position_, "NPY header", "a structure in a structure", "numbers");
      const std::string descr = string();
      if (accept(',') && peek() != ')')
        for (const Index extent : tuple()) field.count = times(place, field.count, extent);
      expect(')');
      const std::size_t width = width_of(descr, place);
      field.type = npy_type(descr);
      const bool is_again = std::ranges::any_of(
          fields, [&](const NpyField& other) { return other.name == field.name; });
      if (is_again && !field.name.empty())
        fail(at, "field named twice", printable(field.name, 40), "different names");
      offset += times(place, field.count, static_cast<Index>(width));
      if (offset > kMostBytes) fail(place, "record", "more than 2^20 bytes", "at most 2^20 bytes");
      fields.push_back(std::move(field));
      if (!accept(',') && peek() != ']') fail(position_, "NPY header", found(), "',' or ']'");
    }
    if (offset == 0) fail(position_, "a structured array", "records of 0 bytes", "fields");
    return fields;
  }
  std::size_t times(std::size_t at, std::size_t a, Index b) const {
    const auto product = checked_product(a, static_cast<std::size_t>(b));
    if (!product || *product > kMostBytes)
      fail(at, "record", "more than 2^20 bytes", "at most 2^20 bytes");
    return *product;
  }
  // The number of bytes of one element. Strings and padding, such as '|V4', are skipped later.
  std::size_t width_of(const std::string& descr, std::size_t at) const {
    std::size_t width = 0;
    const char* const end = descr.data() + descr.size();
    const auto [stop, error] = descr.size() > 2
                                   ? std::from_chars(descr.data() + 2, end, width)
                                   : std::from_chars_result{end, std::errc::invalid_argument};
    const bool has_order = !descr.empty() && std::string_view("<>|=").find(descr[0]) != npos;
    if (error != std::errc{} || stop != end || !has_order)
      fail(at, "type of a field", printable(descr, 40), "a type such as '<f4'");
    return times(at, descr[1] == 'U' ? 4 : 1, static_cast<Index>(width));
  }
  bool boolean() {
    skip();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (input_.text().substr(position_, std::min(word.size(), end_ - position_)) == word) {
        position_ += word.size();
        return value;
      }
    }
    fail(position_, "fortran_order", found(), "True or False");
  }
  std::vector<Index> tuple() {
    std::vector<Index> shape;
    expect('(');
    while (!accept(')')) {
      skip();
      Index extent = 0;
      const char* begin = input_.text().data() + position_;
      const auto [stop, error] = std::from_chars(begin, input_.text().data() + end_, extent);
      if (error != std::errc{} || extent < 0) {
        fail(position_, "shape",
             error == std::errc::result_out_of_range ? "a number out of the range of int64"
             : extent < 0                            ? fmt::format("{}", extent)
                                                     : found(),
             "sizes of 0 or more");
      }
      position_ += static_cast<std::size_t>(stop - begin);
      shape.push_back(extent);
      if (!accept(',') && peek() != ')') fail(position_, "shape", found(), "',' or ')'");
    }
    return shape;
  }

  const Input& input_;
  std::size_t position_;
  std::size_t end_;
};

}  // namespace

std::optional<NpyType> npy_type(std::string_view descr) {
  const char order = descr.empty() ? '\0' : descr[0];
  if (order != '<' && order != '>' && order != '|' && order != '=') return std::nullopt;
  const auto element = element_type(descr.substr(1));
  if (!element || (order == '|' && element->size != 1)) return std::nullopt;
  return NpyType{*element, order == '>' ? std::endian::big : std::endian::little, descr[1]};
}

std::string names_of_fields(const std::vector<NpyField>& fields) {
  std::vector<std::string> names;
  for (const NpyField& field : fields)
    if (!field.name.empty()) names.push_back(printable(field.name, 40));
  return fmt::format("{}", fmt::join(names, ", "));
}

NpyHeader read_npy_header(const Input& input) {
  BinaryCursor cursor(input, std::endian::little);
  const auto magic = cursor.take(kNpyMagic.size(), "NPY magic number");
  if (std::memcmp(magic.data(), kNpyMagic.data(), kNpyMagic.size()) != 0) {
    input.fail_at_byte(0, {"not an NPY file", "a different magic number", "\\x93NUMPY", {}});
  }
  const auto major = cursor.read<std::uint8_t>("NPY version");
  cursor.read<std::uint8_t>("NPY version");
  if (major < 1 || major > 3) {
    input.fail_at_byte(6, {"NPY version", fmt::format("{}", major), "1, 2 or 3", {}});
  }
  const std::size_t length = major == 1 ? cursor.read<std::uint16_t>("header length")
                                        : cursor.read<std::uint32_t>("header length");
  const std::size_t begin = cursor.offset();
  cursor.take(length, "NPY header");
  NpyHeader header = HeaderParser(input, begin, begin + length).parse();
  header.offset = begin + length;
  return header;
}

}  // namespace ph::detail
