// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>
#include <vector>

#include "libph/src/io/images/volume.hpp"

namespace ph::detail {

/// The blanks of XML.
constexpr std::string_view kXmlSpace = " \t\r\n";

/// A tag of an XML text.
struct XmlTag {
  std::string_view name;
  std::vector<HeaderField> attributes;
  std::size_t line = 0, column = 0;    ///< its place, from 1
  std::size_t end = 0;                 ///< the first byte after it
  bool opens = false, closes = false;  ///< both are true for <NAME/>

  /// The attribute with this name; null if there is none.
  const HeaderField* find(std::string_view attribute) const;
};

/// The tags of an XML text, one after another. Comments and declarations are skipped. The bytes
/// after the last tag that was read may be anything. Entities are not replaced. Unlike XML, names
/// in quotes may contain "<", because VTK writes them.
class Markup {
 public:
  explicit Markup(const Input& input) : input_(input) {}

  /// Goes to the next tag. @throws Error (bad_data) if the text ends before it, if the tag is
  /// damaged, or if it closes another element than the innermost open one.
  const XmlTag& next();
  /// The text between the tag before and the current one.
  std::string_view text() const { return text_; }
  /// The names of the open elements, the innermost last. An element that the current tag closes is
  /// not among them.
  const std::vector<std::string_view>& open() const { return open_; }
  std::size_t offset() const { return offset_; }  ///< the first byte after the current tag
  /// @throws Error (bad_data) if the tag has no such attribute.
  const HeaderField& need(const XmlTag& tag, std::string_view attribute) const;
  [[noreturn]] void fail(const XmlTag& tag, std::string_view found, std::string_view expected,
                         const Message& hint = {}) const;

 private:
  void go_to(std::size_t offset);
  std::size_t end_of(std::string_view mark, std::size_t from) const;
  void read_tag(std::string_view inner);
  std::size_t read_attribute(std::string_view inner, std::size_t at);
  void nest();

  const Input& input_;
  std::size_t offset_ = 0;
  std::size_t line_ = 1, line_begin_ = 0;  // the line of the byte at offset_
  XmlTag tag_;
  std::string_view text_;
  std::vector<std::string_view> open_;
};

}  // namespace ph::detail
