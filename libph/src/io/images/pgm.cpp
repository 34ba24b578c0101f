// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/io/read.hpp"

namespace ph::detail {
namespace {

constexpr std::size_t kMostGrey = 65535;
// The number of pixels between two polls of the stop token, minus one.
constexpr std::size_t kPollMask = 0xFFFFF;

// Reads the numbers of a PGM as text. They are digits between blanks and comments.
class Numbers {
 public:
  Numbers(const Input& input, std::size_t offset) : input_(input), at_(offset) {}

  std::size_t offset() const { return at_; }

  /// Skips blanks, and comments if `comments` is true.
  void skip(bool comments) {
    const std::string_view text = input_.text();
    for (; at_ < text.size(); ++at_) {
      if (comments && text[at_] == '#') {
        at_ = std::min(text.find('\n', at_), text.size() - 1);
      } else if (!is_blank(text[at_])) {
        return;
      }
    }
  }
  std::size_t next(const char* what, std::size_t least, std::size_t most, bool comments) {
    skip(comments);
    const std::string_view text = input_.text();
    const std::size_t begin = at_;
    std::size_t value = 0;
    for (; at_ < text.size() && text[at_] >= '0' && text[at_] <= '9'; ++at_) {
      if (value <= most) value = 10 * value + static_cast<std::size_t>(text[at_] - '0');
    }
    const std::string expected = fmt::format("{} to {}", least, most);
    if (begin == text.size()) {
      input_.fail_at_byte(
          begin, {fmt::format("truncated: {} missing", what), "the end of the file", expected, {}});
    }
    if (begin == at_ || (at_ < text.size() && !is_blank(text[at_]))) {
      const std::size_t shown = std::min<std::size_t>(at_ - begin + 1, 40);
      input_.fail_at_byte(begin, {fmt::format("{} is not a number", what),
                                  '"' + printable(text.substr(begin, shown)) + '"',
                                  expected,
                                  {}});
    }
    if (value < least || value > most) {
      input_.fail_at_byte(begin, {fmt::format("{} out of range", what),
                                  printable(text.substr(begin, at_ - begin), 40),
                                  expected,
                                  {}});
    }
    return value;
  }

 private:
  static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
  }

  const Input& input_;
  std::size_t at_;
};

[[noreturn]] void fail_sample(const Input& input, std::size_t at, std::size_t value,
                              std::size_t most) {
  input.fail_at_byte(
      at, {"grey value out of range", fmt::format("{}", value), fmt::format("0 to {}", most), {}});
}

}  // namespace

bool is_pgm(const Input& input) {
  const std::string_view text = input.text();
  return text.size() > 2 && text[0] == 'P' && (text[1] == '2' || text[1] == '5') &&
         std::string_view(" \n\r\t#").find(text[2]) != std::string_view::npos;
}

Image read_pgm_image(const Input& input) {
  if (!is_pgm(input)) {
    input.fail_at_byte(0, {"not a PGM file", printable(input.text().substr(0, 2)), "P2 or P5", {}});
  }
  constexpr std::size_t kMostSide = std::size_t{1} << 31;
  const bool binary = input.text()[1] == '5';
  Numbers numbers(input, 2);
  const std::size_t width = numbers.next("width", 1, kMostSide, true);
  const std::size_t height = numbers.next("height", 1, kMostSide, true);
  const std::size_t most = numbers.next("largest grey value", 1, kMostGrey, true);
  const std::size_t bytes_each = most > 255 ? 2 : 1;
  // One blank ends the header of P5. In P2, a pixel takes at least a digit and a blank.
  const std::size_t begin = std::min(numbers.offset() + 1, input.size());
  const std::size_t count = width * height;  // the product is at most 2^62
  const std::size_t there = input.size() - begin;
  const std::size_t hold = binary ? there / bytes_each : (there + 1) / 2;
  if (numbers.offset() == input.size() || count > hold) {
    input.fail_at_byte(begin, {"truncated",
                               fmt::format("{} bytes", there),
                               fmt::format("{} x {} pixels", width, height),
                               {}});
  }
  input.require_memory(count * bytes_each);
  std::vector<std::uint8_t> bytes(bytes_each == 1 ? count : 0);
  std::vector<std::uint16_t> words(bytes_each == 2 ? count : 0);
  const auto set = [&](std::size_t k, std::size_t value) {
    if (bytes_each == 1)
      bytes[k] = static_cast<std::uint8_t>(value);
    else
      words[k] = static_cast<std::uint16_t>(value);
  };
  for (std::size_t k = 0; k < count; ++k) {
    if ((k & kPollMask) == 0) input.poll();
    if (!binary) {
      set(k, numbers.next("grey value", 0, most, true));
      continue;
    }
    const std::byte* from = input.bytes().data() + begin + k * bytes_each;
    const std::size_t value = bytes_each == 2 ? load<std::uint16_t>(from, std::endian::big)
                                              : std::to_integer<std::size_t>(*from);
    if (value > most) fail_sample(input, begin + k * bytes_each, value, most);
    set(k, value);
  }
  std::size_t end = begin + count * bytes_each;
  if (!binary) {
    numbers.skip(true);
    end = numbers.offset();
  }
  if (end != input.size()) {
    input.fail_at_byte(
        end, {"trailing data", fmt::format("{} more bytes", input.size() - end),
              "the end of the file", binary ? "files with several pictures are not read" : ""});
  }
  const std::vector<Index> extents{static_cast<Index>(height), static_cast<Index>(width)};
  if (bytes_each == 1) return {extents, std::move(bytes)};
  return {extents, std::move(words)};
}

}  // namespace ph::detail
