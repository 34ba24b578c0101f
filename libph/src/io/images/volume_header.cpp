// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <charconv>

#include "libph/src/io/images/volume.hpp"
#include "ph/detail/core/floating.hpp"

namespace ph::detail {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return text.substr(0, 0);
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    words.push_back(text.substr(0, text.find_first_of(kBlanks)));
    text.remove_prefix(words.back().size());
  }
  return words;
}

}  // namespace

bool VolumeHeader::next_line() {
  std::string_view rest = input_.text().substr(offset_);
  if (rest.empty()) return false;
  line_ = rest.substr(0, rest.find('\n'));
  offset_ += std::min(line_.size() + 1, rest.size());
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  ++number_;
  return true;
}

const HeaderField& VolumeHeader::add(const std::string& key, std::size_t mark) {
  const std::string_view name = trimmed(line_.substr(0, mark));
  const std::string_view value = trimmed(line_.substr(mark + 1));
  const auto column = static_cast<std::size_t>(
      (value.empty() ? line_.data() + line_.size() : value.data()) - line_.data() + 1);
  const auto [place, is_new] = fields_.try_emplace(key, HeaderField{name, value, number_, column});
  if (!is_new) {
    input_.fail_at(number_, 1,
                   {"field of the header",
                    "a second " + printable(name, 40),
                    fmt::format("one; the first is on line {}", place->second.line),
                    {}});
  }
  return place->second;
}

const HeaderField* VolumeHeader::find(const std::string& key) const {
  const auto found = fields_.find(key);
  return found == fields_.end() ? nullptr : &found->second;
}

const HeaderField& VolumeHeader::need(const std::string& key) const {
  if (const HeaderField* const field = find(key)) return *field;
  input_.fail_at(std::max<std::size_t>(number_, 1), 1,
                 {"incomplete header", "no field " + key, "one", {}});
}

std::vector<std::string_view> VolumeHeader::words(const HeaderField& field) {
  return words_of(field.value);
}

std::vector<std::int64_t> VolumeHeader::integers(const HeaderField& field, std::int64_t least,
                                                 std::int64_t most) const {
  std::vector<std::int64_t> numbers;
  for (const std::string_view word : words(field)) {
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || stop != word.data() + word.size() || number < least ||
        number > most) {
      fail(field, fmt::format("whole numbers from {} to {}", least, most));
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::int64_t VolumeHeader::integer(const HeaderField& field, std::int64_t least,
                                   std::int64_t most) const {
  const std::vector<std::int64_t> all = integers(field, least, most);
  if (all.size() != 1) fail(field, "one whole number");
  return all[0];
}

std::vector<double> VolumeHeader::numbers(const HeaderField& field, std::string_view text) const {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(text)) {
    // The function from_chars accepts no plus sign.
    const char* const end = word.data() + word.size();
    double number = 0;
    const auto [stop, error] =
        floating_from_chars(word.data() + (word.starts_with('+') ? 1 : 0), end, number);
    if (error != std::errc{} || stop != end) fail(field, "numbers");
    numbers.push_back(number);
  }
  return numbers;
}

void VolumeHeader::fail(const HeaderField& field, std::string_view expected,
                        const Message& hint) const {
  input_.fail_at(
      field.line, field.column,
      {printable(field.name, 40), field.value.empty() ? "nothing" : printable(field.value, 80),
       std::string(expected), hint});
}

}  // namespace ph::detail
