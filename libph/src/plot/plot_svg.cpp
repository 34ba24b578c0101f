// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <span>
#include <sstream>

#include "libph/src/plot/plot_canvas.hpp"
#include "ph/detail/io/base64.hpp"

namespace ph::plot {
namespace {

/// Escapes text for XML content or attributes. See characters_of for the characters that become
/// U+FFFD.
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

/// Formats a coordinate with at most two decimals.
std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string hex(Colour colour) { return fmt::format("#{:06x}", colour); }

std::string path_data(const Outline& outline) {
  using Verb = Outline::Verb;
  std::string data;
  for (const auto& [verb, x, y] : outline.steps()) {
    const auto two = [&](char letter) {
      data += letter;
      data += coordinate(x) + ' ' + coordinate(y);
    };
    const auto one = [&](char letter, double to) {
      data += letter;
      data += coordinate(to);
    };
    switch (verb) {
      case Verb::move_to:
        two('M');
        break;
      case Verb::line_to:
        two('L');
        break;
      case Verb::line_by:
        two('l');
        break;
      case Verb::horizontal_to:
        one('H', x);
        break;
      case Verb::horizontal_by:
        one('h', x);
        break;
      case Verb::vertical_to:
        one('V', y);
        break;
      case Verb::vertical_by:
        one('v', y);
        break;
      case Verb::circle_by:
        for (const double width : {x, -x})
          data += fmt::format("a{0} {0} 0 1 0 {1} 0", coordinate(x / 2), coordinate(width));
        break;
      case Verb::close:
        data += 'z';
    }
  }
  return data;
}

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  detail::Base64 digits;
  digits.append(std::as_bytes(std::span(bytes)), text);
  digits.finish(text);
  return text;
}

std::string element(const Line& line) {
  return fmt::format(
      "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n",
      coordinate(line.x1), coordinate(line.y1), coordinate(line.x2), coordinate(line.y2),
      hex(line.colour), coordinate(line.width),
      line.stroke == Stroke::dashed ? " stroke-dasharray=\"3 2\"" : "");
}

std::string opacity_attribute(double opacity) {
  return opacity < 1 ? fmt::format(" fill-opacity=\"{}\"", coordinate(opacity)) : "";
}

std::string element(const Rectangle& rect) {
  return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"{}/>\n",
                     coordinate(rect.x), coordinate(rect.y), coordinate(rect.width),
                     coordinate(rect.height), hex(rect.colour), opacity_attribute(rect.opacity));
}

std::string element(const Shape& shape) {
  const Style& style = shape.style;
  std::string attributes = fmt::format("fill=\"{}\"{}", style.fill ? hex(*style.fill) : "none",
                                       opacity_attribute(style.fill_opacity));
  if (style.stroke)
    attributes += fmt::format(" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                              hex(*style.stroke), coordinate(style.stroke_width));
  if (style.crisp) attributes += " shape-rendering=\"crispEdges\"";
  return fmt::format("<path d=\"{}\" {}/>\n", path_data(shape.outline), attributes);
}

std::string element(const Text& text) {
  constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
  const std::string x = coordinate(text.x), y = coordinate(text.y);
  std::string look;
  if (text.look == Look::bold || text.look == Look::haloed) look = " font-weight=\"bold\"";
  if (text.look == Look::upwards) look = fmt::format(" transform=\"rotate(-90 {} {})\"", x, y);
  if (text.look == Look::haloed)
    look += fmt::format(" stroke=\"#ffffff\" stroke-width=\"{}\" paint-order=\"stroke\"",
                        coordinate(kHalo));
  return fmt::format(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n", x, y,
      anchors[static_cast<std::size_t>(text.anchor)], coordinate(text.size), hex(text.colour), look,
      xml_escaped(text.content));
}

std::string element(const Picture& picture) {
  std::ostringstream png;
  png.exceptions(std::ios::badbit);  // otherwise the stream would hide a lack of memory
  write_png(png, *picture.raster);
  return fmt::format(
      "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
      "href=\"data:image/png;base64,{}\"/>\n",
      coordinate(picture.x), coordinate(picture.y), coordinate(picture.width),
      coordinate(picture.height), base64(png.view()));
}

}  // namespace

std::string to_svg(const Drawing& drawing) {
  const double points = drawing.size ? 1.0 * drawing.size->width / drawing.width : 88 / kWidth;
  const std::string_view unit = drawing.size ? "" : "mm";
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}{2}\" height=\"{1}{2}\" "
      "viewBox=\"0 0 {3} {4}\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', "
      "sans-serif\" role=\"img\">\n"
      "<title>{5}</title>\n<desc>{6}</desc>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      coordinate(points * drawing.width), coordinate(points * drawing.height), unit,
      coordinate(drawing.width), coordinate(drawing.height), xml_escaped(drawing.title),
      xml_escaped(drawing.description));
  for (const Element& one : drawing.elements)
    text += std::visit([](const auto& kind) { return element(kind); }, one);
  return text += "</svg>\n";
}

}  // namespace ph::plot
