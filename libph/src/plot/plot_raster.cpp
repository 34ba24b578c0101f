// SPDX-License-Identifier: MIT
#include "libph/src/plot/plot_canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "libph/src/plot/plot_coverage.hpp"
#include "libph/src/plot/plot_font.hpp"

namespace ph::plot {
namespace {

constexpr double kBold = 0.045;  // how far bold type thickens outlines, as a share of the size

/// Width of a picture in pixels.
Index pixels_across(const Drawing& drawing) {
  return drawing.size ? drawing.size->width : std::lround(kPixels * drawing.width / kWidth);
}
/// Pixels per point.
double scale_of(const Drawing& drawing) {
  return static_cast<double>(pixels_across(drawing)) / drawing.width;
}
Index pixels_down(const Drawing& drawing) {
  return drawing.size ? drawing.size->height
                      : std::max<Index>(1, std::lround(scale_of(drawing) * drawing.height));
}

/// Fills `corners` with the corners of a circle with this centre and radius, in pixels.
void make_circle(std::vector<Place>& corners, Place middle, double radius) {
  const int count = std::clamp(static_cast<int>(6 + 4 * std::sqrt(radius)), 8, 128);
  corners.clear();
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    corners.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
  }
}

/// A connected part of an outline, in pixels.
struct Piece {
  std::vector<Place> corners;
  bool closed = false;
};

/// Calls visit(piece) for each part of an outline. All parts use the memory of `piece`.
template <class Visit>
void for_each_piece(const Outline& outline, double scale, Piece& piece, Visit&& visit) {
  using Verb = Outline::Verb;
  Place at;
  const auto go = [&](Place to) { piece.corners.push_back(at = to); };
  const auto finish = [&] {
    if (!piece.corners.empty()) visit(piece);
    piece.corners.clear();
    piece.closed = false;
  };
  piece.corners.clear();
  for (const auto& [verb, x_points, y_points] : outline.steps()) {
    const double x = scale * x_points, y = scale * y_points;
    switch (verb) {
      case Verb::move_to:
        finish();
        go({x, y});
        break;
      case Verb::line_to:
        go({x, y});
        break;
      case Verb::line_by:
        go({at.x + x, at.y + y});
        break;
      case Verb::horizontal_to:
        go({x, at.y});
        break;
      case Verb::horizontal_by:
        go({at.x + x, at.y});
        break;
      case Verb::vertical_to:
        go({at.x, y});
        break;
      case Verb::vertical_by:
        go({at.x, at.y + y});
        break;
      case Verb::circle_by:
        make_circle(piece.corners, {at.x + x / 2, at.y}, x / 2);
        piece.closed = true;
        break;
      case Verb::close:
        piece.closed = true;
    }
  }
  finish();
}

class Painter {
 public:
  explicit Painter(const Drawing& drawing)
      : scale_(scale_of(drawing)),
        raster_{pixels_across(drawing), pixels_down(drawing), 3, 8, {}},
        coverage_(static_cast<std::size_t>(raster_.width),
                  static_cast<std::size_t>(raster_.height)) {
    raster_.samples.assign(static_cast<std::size_t>(raster_.width * raster_.height * 3), 255);
    raster_.dots_per_inch = kDotsPerInch;
  }

  void operator()(const Line& line) {
    const Place from{scale_ * line.x1, scale_ * line.y1}, to{scale_ * line.x2, scale_ * line.y2};
    const double width = scale_ * line.width;
    if (line.stroke == Stroke::solid) {
      add_stroke(from, to, width);
    } else {
      const double length = std::hypot(to.x - from.x, to.y - from.y);
      const auto at = [&](double part) {
        const double t = std::min(part / length, 1.0);
        return Place{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
      };
      for (double dash = 0; dash < length; dash += 5 * scale_)
        add_stroke(at(dash), at(dash + 3 * scale_), width);
    }
    paint(line.colour, 1);
  }

  /// Rounds the sides to whole pixels, so that adjacent rectangles show no seam.
  void operator()(const Rectangle& rect) {
    const auto whole = [this](double points) { return std::round(scale_ * points); };
    const double left = whole(rect.x), right = whole(rect.x + rect.width);
    const double top = whole(rect.y), bottom = whole(rect.y + rect.height);
    coverage_.add(
        std::array<Place, 4>{{{left, top}, {right, top}, {right, bottom}, {left, bottom}}});
    paint(rect.colour, rect.opacity);
  }

  void operator()(const Shape& shape) {
    const Style& style = shape.style;
    if (style.fill) {
      for_each_piece(shape.outline, scale_, piece_,
                     [&](const Piece& piece) { coverage_.add_turned(piece.corners); });
      paint(*style.fill, style.fill_opacity);
    }
    if (style.stroke) {
      for_each_piece(shape.outline, scale_, piece_,
                     [&](const Piece& piece) { add_stroke(piece, scale_ * style.stroke_width); });
      paint(*style.stroke, 1);
    }
  }

  void operator()(const Text& text) {
    if (text.look == Look::haloed) {
      add_text(text, scale_ * kHalo);
      paint(kWhite, 1);
    }
    add_text(text, 0);
    paint(text.colour, 1);
  }

  /// Copies the nearest pixel of the picture to each output pixel.
  void operator()(const Picture& picture) {
    const Raster& from = *picture.raster;
    const auto whole = [this](double points) { return std::lround(scale_ * points); };
    const Index left = whole(picture.x), width = whole(picture.width);
    const Index top = whole(picture.y), height = whole(picture.height);
    for (Index y = std::max<Index>(0, -top); y < std::min(height, raster_.height - top); ++y)
      for (Index x = std::max<Index>(0, -left); x < std::min(width, raster_.width - left); ++x)
        for (int c = 0; c < 3; ++c)
          raster_
              .samples[static_cast<std::size_t>(((top + y) * raster_.width + left + x) * 3 + c)] =
              sample(from, x * from.width / width, y * from.height / height, c);
  }

  Raster take() { return std::move(raster_); }

 private:
  /// A sample with 8 bits, from a raster in grey or RGB with 8 or 16 bits.
  static std::uint16_t sample(const Raster& raster, Index x, Index y, int channel) {
    const std::uint16_t value = raster.at(x, y, raster.channels < 3 ? 0 : channel);
    return raster.bits == 16 ? static_cast<std::uint16_t>(value >> 8) : value;
  }

  /// Adds the outlines of a text. @param halo width of a line along the outlines, in pixels.
  void add_text(const Text& text, double halo) {
    const std::vector<std::string> characters = characters_of(text.content);
    const double size = scale_ * text.size;
    const bool is_bold = text.look == Look::bold || text.look == Look::haloed;
    const double bold = is_bold ? kBold * size : 0;
    double length = 0;
    for (const std::string& c : characters) length += size * font_.glyph(c).advance + bold;
    double along = text.anchor == Anchor::start    ? 0
                   : text.anchor == Anchor::middle ? -length / 2
                                                   : -length;
    const Place origin{scale_ * text.x, scale_ * text.y};
    for (const std::string& c : characters) {
      const Font::Glyph& glyph = font_.glyph(c);
      for (const std::vector<Place>& outline : glyph.outlines) {
        piece_.corners.clear();
        piece_.closed = true;
        for (const Place& p : outline) {
          const double x = along + bold / 2 + size * p.x, y = size * p.y;
          piece_.corners.push_back(text.look == Look::upwards ? Place{origin.x + y, origin.y - x}
                                                              : Place{origin.x + x, origin.y + y});
        }
        coverage_.add(piece_.corners);
        if (bold + halo > 0) add_stroke(piece_, bold + halo);
      }
      along += size * glyph.advance + bold;
    }
  }

  void add_stroke(Place from, Place to, double width) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0)) return;
    const double x = -(to.y - from.y) / length * width / 2,
                 y = (to.x - from.x) / length * width / 2;
    coverage_.add_turned(std::array<Place, 4>{{{from.x + x, from.y + y},
                                               {from.x - x, from.y - y},
                                               {to.x - x, to.y - y},
                                               {to.x + x, to.y + y}}});
  }

  /// Adds a line along a piece. The parts of the line meet in round joints.
  void add_stroke(const Piece& piece, double width) {
    const std::vector<Place>& corners = piece.corners;
    for (std::size_t i = 1; i < corners.size(); ++i) add_stroke(corners[i - 1], corners[i], width);
    if (piece.closed && !corners.empty()) add_stroke(corners.back(), corners.front(), width);
    const std::size_t open = piece.closed ? 0 : 1;
    for (std::size_t i = open; i + open < corners.size(); ++i) {
      make_circle(circle_, corners[i], width / 2);
      coverage_.add(circle_);
    }
  }

  /// Paints the collected areas in a colour.
  void paint(Colour colour, double opacity) {
    coverage_.take([&](std::size_t pixel, double part) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint16_t& sample = raster_.samples[3 * pixel + c];
        const auto wanted = static_cast<double>(colour >> (16 - 8 * c) & 255U);
        const double mixed = sample + (wanted - sample) * part * opacity;
        sample = static_cast<std::uint16_t>(std::lround(mixed));
      }
    });
  }

  double scale_;  // pixels per point
  Raster raster_;
  Coverage coverage_;
  Piece piece_;                // the part that is being added
  std::vector<Place> circle_;  // a joint of that part
  Font font_;
};

}  // namespace

std::size_t raster_bytes(const Drawing& drawing) {
  constexpr std::size_t a_pixel = 3 * (sizeof(std::uint16_t) + 1) + sizeof(float);
  constexpr std::size_t font_and_deflate = 1 << 20;
  const auto rows = static_cast<std::size_t>(pixels_down(drawing)) + 1;
  return rows * static_cast<std::size_t>(pixels_across(drawing)) * a_pixel + font_and_deflate;
}

Raster to_raster(const Drawing& drawing) {
  Painter painter(drawing);
  for (const Element& element : drawing.elements) std::visit(painter, element);
  return painter.take();
}

}  // namespace ph::plot
