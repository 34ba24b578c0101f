// SPDX-License-Identifier: MIT
#include "svg_plot_canvas.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace ph::svg {
namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

/// Bytes of the UTF-8 character at the start of `text` if XML may hold it, else 0.
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
  if ((two < 0xf090 && first == 0xf0) || two > 0xf48f) return 0;      // overlong, too large
  return length;
}

/// Splits text into characters, those that XML cannot hold replaced.
std::vector<std::string> characters_of(std::string_view text) {
  std::vector<std::string> characters;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    characters.emplace_back(length == 0 ? kReplacement : text.substr(0, length));
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return characters;
}

}  // namespace

std::string_view colour_of_dim(int dim) {
  constexpr std::array<std::string_view, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#000000"};
  return kColours[static_cast<std::size_t>(dim) % kColours.size()];
}

std::string with_subscript(std::string_view letter, int number) {
  std::string text(letter);
  for (const char digit : std::to_string(number)) {
    text += "\xe2\x82";  // U+2080 … U+2089
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

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const std::string& c : characters_of(text)) {
    if (c == "&") {
      out += "&amp;";
    } else if (c == "<") {
      out += "&lt;";
    } else if (c == ">") {
      out += "&gt;";
    } else if (c == "\"") {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

void Canvas::line(double x1, double y1, double x2, double y2, std::string_view colour, double width,
                  std::string_view more) {
  elements_ += fmt::format(
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}{}/>\n",
      coordinate(x1), coordinate(y1), coordinate(x2), coordinate(y2), colour, coordinate(width),
      more.empty() ? "" : " ", more);
}

void Canvas::rect(double x, double y, double width, double height, std::string_view colour,
                  double opacity) {
  elements_ +=
      fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"", coordinate(x),
                  coordinate(y), coordinate(width), coordinate(height), colour);
  if (opacity < 1) elements_ += fmt::format(" fill-opacity=\"{}\"", coordinate(opacity));
  elements_ += "/>\n";
}

void Canvas::path(const std::string& data, const std::string& style) {
  if (!data.empty()) elements_ += fmt::format("<path d=\"{}\" {}/>\n", data, style);
}

void Canvas::text(double x, double y, std::string_view content, Anchor anchor, double size,
                  std::string_view colour, std::string_view more) {
  constexpr std::array<std::string_view, 3> kAnchors{"start", "middle", "end"};
  elements_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\"{}{}>{}</text>\n",
      coordinate(x), coordinate(y), kAnchors[static_cast<std::size_t>(anchor)], coordinate(size),
      colour, more.empty() ? "" : " ", more, xml_escaped(content));
}

void Canvas::title(const std::string& title) {
  constexpr std::size_t kFits = 52;  // characters of 8 points across the picture
  const std::vector<std::string> characters = characters_of(title);
  std::string shown;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    const bool cut =
        characters.size() > kFits && i >= kFits / 2 && i < characters.size() - kFits / 2;
    if (!cut) shown += characters[i];
    if (cut && i == kFits / 2) shown += "\xe2\x80\xa6";  // …
  }
  text(kWidth / 2, 11, shown, Anchor::middle, 8, kInk, "font-weight=\"bold\"");
}

std::string Canvas::finish(double height, const std::string& title,
                           const std::string& description) const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"88mm\" height=\"{}mm\" "
      "viewBox=\"0 0 {} {}\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', "
      "sans-serif\" role=\"img\">\n"
      "<title>{}</title>\n<desc>{}</desc>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{}</svg>\n",
      coordinate(88 * height / kWidth), coordinate(kWidth), coordinate(height), xml_escaped(title),
      xml_escaped(description), elements_);
}

}  // namespace ph::svg
