// SPDX-License-Identifier: MIT
#include "libph/src/io/images/markup.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ph::detail {
namespace {

// The end of a tag that begins at a place, which is the ">" outside quotes.
std::size_t close_of(std::string_view text, std::size_t at) {
  while (true) {
    at = text.find_first_of("\"'>", at);
    if (at == std::string_view::npos || text[at] == '>') return at;
    at = text.find(text[at], at + 1);
    if (at == std::string_view::npos) return at;
    ++at;
  }
}

}  // namespace

const HeaderField* XmlTag::find(std::string_view attribute) const {
  const auto found = std::ranges::find(attributes, attribute, &HeaderField::name);
  return found == attributes.end() ? nullptr : &*found;
}

void Markup::go_to(std::size_t offset) {
  const std::string_view passed = input_.text().substr(offset_, offset - offset_);
  if (const std::size_t last = passed.rfind('\n'); last != std::string_view::npos) {
    line_ += static_cast<std::size_t>(std::ranges::count(passed, '\n'));
    line_begin_ = offset_ + last + 1;
  }
  offset_ = offset;
}

std::size_t Markup::end_of(std::string_view mark, std::size_t from) const {
  const std::size_t at = input_.text().find(mark, from);
  if (at != std::string_view::npos) return at + mark.size();
  input_.fail_at(line_, offset_ - line_begin_ + 1,
                 {"truncated XML", "the end of the file", fmt::format("\"{}\"", mark), {}});
}

const XmlTag& Markup::next() {
  const std::string_view text = input_.text();
  const std::size_t begin = offset_;
  while (true) {
    go_to(end_of("<", offset_) - 1);
    if (text.substr(offset_).starts_with("<!--")) {
      go_to(end_of("-->", offset_ + 4));
    } else if (text.substr(offset_).starts_with("<?")) {
      go_to(end_of("?>", offset_ + 2));
    } else {
      break;
    }
  }
  text_ = text.substr(begin, offset_ - begin);
  tag_ = XmlTag{};
  tag_.line = line_;
  tag_.column = offset_ - line_begin_ + 1;
  const std::size_t close = close_of(text, offset_ + 1);
  if (close == std::string_view::npos) end_of(">", text.size());
  tag_.end = close + 1;
  read_tag(text.substr(offset_ + 1, close - offset_ - 1));
  go_to(tag_.end);
  nest();
  return tag_;
}

void Markup::read_tag(std::string_view inner) {
  tag_.closes = inner.starts_with('/') || inner.ends_with('/');
  tag_.opens = !inner.starts_with('/');
  if (!tag_.opens) inner.remove_prefix(1);
  if (tag_.opens && tag_.closes) inner.remove_suffix(1);
  tag_.name = inner.substr(0, inner.find_first_of(kXmlSpace));
  if (tag_.name.empty() || tag_.name.find_first_of("<!\"'=") != std::string_view::npos)
    fail(tag_, '<' + printable(inner, 40) + '>', "the tag of an element");
  for (std::size_t at = tag_.name.size();
       (at = inner.find_first_not_of(kXmlSpace, at)) != std::string_view::npos;)
    at = read_attribute(inner, at);
}

std::size_t Markup::read_attribute(std::string_view inner, std::size_t at) {
  const auto refuse = [&] {
    fail(tag_, printable(inner.substr(at), 40), "an attribute NAME=\"VALUE\"");
  };
  const std::size_t equals = inner.find('=', at);
  if (equals == std::string_view::npos || !tag_.opens) refuse();
  std::string_view name = inner.substr(at, equals - at);
  name = name.substr(0, name.find_last_not_of(kXmlSpace) + 1);
  const std::size_t begin = inner.find_first_not_of(kXmlSpace, equals + 1);
  if (name.empty() || name.find_first_of(" \t\r\n<\"'") != std::string_view::npos ||
      begin == std::string_view::npos || (inner[begin] != '"' && inner[begin] != '\''))
    refuse();
  const std::size_t end = inner.find(inner[begin], begin + 1);
  if (end == std::string_view::npos) refuse();
  if (tag_.find(name) != nullptr)
    fail(tag_, "a second attribute " + printable(name, 40), "one of each name");
  // The tag may extend over several lines.
  const std::string_view text = input_.text();
  const auto place = static_cast<std::size_t>(inner.data() - text.data()) + begin + 1;
  const std::string_view before = text.substr(offset_, place - offset_);
  const std::size_t last = before.rfind('\n');
  tag_.attributes.push_back(
      {name, inner.substr(begin + 1, end - begin - 1),
       line_ + static_cast<std::size_t>(std::ranges::count(before, '\n')),
       last == std::string_view::npos ? place - line_begin_ + 1 : before.size() - last});
  return end + 1;
}

void Markup::nest() {
  if (tag_.opens && tag_.closes) return;
  if (tag_.opens) {
    open_.push_back(tag_.name);
    return;
  }
  if (open_.empty() || open_.back() != tag_.name) {
    fail(tag_, fmt::format("</{}>", printable(tag_.name, 40)),
         open_.empty() ? "no end" : fmt::format("</{}>", printable(open_.back(), 40)));
  }
  open_.pop_back();
}

const HeaderField& Markup::need(const XmlTag& tag, std::string_view attribute) const {
  if (const HeaderField* const field = tag.find(attribute)) return *field;
  fail(tag, fmt::format("{} without {}", printable(tag.name, 40), attribute), "one");
}

void Markup::fail(const XmlTag& tag, std::string_view found, std::string_view expected,
                  const Message& hint) const {
  input_.fail_at(tag.line, tag.column, {"XML", std::string(found), std::string(expected), hint});
}

}  // namespace ph::detail
