// SPDX-License-Identifier: MIT
#include "libph/src/plot/plot_canvas.hpp"

#include <array>
#include <utility>

namespace ph::plot {
namespace {

// The replacement character U+FFFD.
constexpr std::string_view kReplacement = "\xef\xbf\xbd";

/// The number of bytes of the UTF-8 character at the start of `text`. It is 0 for malformed UTF-8
/// and for the characters that a picture does not show: the control characters of ASCII, U+FFFE and
/// U+FFFF.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const std::uint32_t two = static_cast<std::uint32_t>(first << 8 | byte(1));
  if (two < 0xe0a0 && first == 0xe0) return 0;                        // overlong
  if (two >= 0xeda0 && first == 0xed) return 0;                       // surrogates
  if (first == 0xef && byte(1) == 0xbf && byte(2) >= 0xbe) return 0;  // U+FFFE, U+FFFF
  if ((two < 0xf090 && first == 0xf0) || two > 0xf48f) return 0;      // overlong or too large
  return length;
}

}  // namespace

std::vector<std::string> characters_of(std::string_view text) {
  std::vector<std::string> characters;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    characters.emplace_back(length == 0 ? kReplacement : text.substr(0, length));
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return characters;
}

Colour colour_of_dim(int dim) {
  constexpr std::array<Colour, 7> colours{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                          0xe69f00, 0x56b4e9, 0x000000};
  return colours[static_cast<std::size_t>(dim) % colours.size()];
}

std::string with_subscript(std::string_view letter, int number) {
  std::string text(letter);
  for (const char digit : std::to_string(number)) {
    text += "\xe2\x82";  // the characters are U+2080 … U+2089
    text += static_cast<char>(0x80 + (digit - '0'));
  }
  return text;
}

std::string grouped(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

void Canvas::line(double x1, double y1, double x2, double y2, Colour colour, double width,
                  Stroke stroke) {
  elements_.emplace_back(Line{x1, y1, x2, y2, colour, width, stroke});
}

void Canvas::rect(double x, double y, double width, double height, Colour colour, double opacity) {
  elements_.emplace_back(Rectangle{x, y, width, height, colour, opacity});
}

void Canvas::shape(Outline outline, const Style& style) {
  if (!outline.empty()) elements_.emplace_back(Shape{std::move(outline), style});
}

void Canvas::text(double x, double y, std::string_view content, Anchor anchor, double size,
                  Colour colour, Look look) {
  elements_.emplace_back(Text{x, y, std::string(content), anchor, size, colour, look});
}

void Canvas::picture(double x, double y, double width, double height, const Raster& raster) {
  elements_.emplace_back(Picture{x, y, width, height, &raster});
}

void Canvas::title(const std::string& title) {
  constexpr std::size_t fits = 52;  // characters of 8 points that fit the width of the picture
  const std::vector<std::string> characters = characters_of(title);
  std::string shown;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    const bool cut = characters.size() > fits && i >= fits / 2 && i < characters.size() - fits / 2;
    if (!cut) shown += characters[i];
    if (cut && i == fits / 2) shown += "\xe2\x80\xa6";  // the ellipsis …
  }
  text(kWidth / 2, 11, shown, Anchor::middle, 8, kInk, Look::bold);
}

Drawing Canvas::finish(double height, std::string_view title, std::string_view description) {
  Drawing drawing;
  drawing.height = height;
  drawing.title = title;
  drawing.description = description;
  drawing.elements = std::exchange(elements_, {});
  return drawing;
}

}  // namespace ph::plot
