// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "libph/src/plot/plot_intervals.hpp"
#include "ph/detail/core/lower_case.hpp"

namespace ph::plot {
namespace {

constexpr double kLeft = 34, kRight = 242;
constexpr double kInfinityRoom = 14;        // space between the infinity line and the finite values
constexpr std::size_t kMostMarkers = 1500;  // more markers cannot be distinguished
// The number of finite bars drawn as markers if there are too many bars to draw all of them.
constexpr std::size_t kCrispBars = 120;

/// Bars of one dimension that coincide in the picture.
struct Marker {
  double x = 0, y = 0;
  std::size_t count = 0;
};

using Places = std::map<std::tuple<int, long, long>, Marker>;

/// Merges the bars of a dimension that are in the same square. The sides of the squares are a
/// quarter of a point long. The marker is drawn at the mean position of its bars.
template <class PlaceOf>
Places gather(std::span<const Bar> bars, PlaceOf&& place_of) {
  constexpr double cell = 0.25;
  Places places;
  for (const Bar& bar : bars) {
    const auto [x, y] = place_of(bar);
    Marker& marker = places[{bar.dim, std::lround(x / cell), std::lround(y / cell)}];
    ++marker.count;
    marker.x += (x - marker.x) / static_cast<double>(marker.count);
    marker.y += (y - marker.y) / static_cast<double>(marker.count);
  }
  return places;
}

/// Bars that are drawn one by one, and bars that are drawn as a density.
struct Parts {
  std::vector<Bar> crisp, rest;
};

/// The longest bars of each dimension and all infinite bars are drawn one by one.
Parts parts_of(const Barcode& barcode) {
  Parts parts;
  const std::vector<int> dims = dims_of(barcode);
  for (const int dim : dims) {
    const std::span<const Bar> bars = barcode.bars(dim);
    const auto infinite = static_cast<std::size_t>(std::ranges::count_if(bars, &Bar::is_infinite));
    const Longest places = longest_of(bars.size(), infinite + kCrispBars / dims.size(),
                                      [&](std::size_t k) { return bars[k].persistence(); });
    for (const std::size_t k : places.crisp) parts.crisp.push_back(bars[k]);
    for (const std::size_t k : places.rest) parts.rest.push_back(bars[k]);
  }
  return parts;
}

double radius_of(std::size_t count) {
  return 1.7 * (1 + 0.45 * std::log10(static_cast<double>(count)));
}

/// Draws a different shape for each of four consecutive dimensions, because colours may be lost in
/// print.
void add_shape(Outline& to, int dim, double x, double y, double r) {
  switch (dim % 4) {
    case 1:  // a triangle
      to.move_to(x, y - 1.25 * r).line_by(1.15 * r, 2 * r).horizontal_by(-2.3 * r).close();
      break;
    case 2:  // a square
      to.move_to(x - 0.9 * r, y - 0.9 * r).horizontal_by(1.8 * r).vertical_by(1.8 * r);
      to.horizontal_by(-1.8 * r).close();
      break;
    case 3:  // a diamond
      to.move_to(x, y - 1.3 * r).line_by(1.1 * r, 1.3 * r).line_by(-1.1 * r, 1.3 * r);
      to.line_by(-1.1 * r, -1.3 * r).close();
      break;
    default:
      to.circle(x, y, r);
  }
}

/// Writes the first letter of "Filtration value" in lower case, for use inside a phrase. Words like
/// "XY" do not change.
std::string lower_first(std::string text) {
  const auto in = [](char c, char a, char b) { return c >= a && c <= b; };
  if (text.size() > 1 && in(text[0], 'A', 'Z') && in(text[1], 'a', 'z'))
    text[0] = to_lower(text[0]);
  return text;
}

/// Counts the bars in each square of a picture.
class Squares {
 public:
  /// @param side the side of a square in whole pixels of a PNG, so that adjacent squares show no
  /// seam.
  explicit Squares(int side) : side_(side * kWidth / static_cast<double>(kPixels)) {}

  void add(int dim, double x, double y) { ++counts_[{dim, number(y), number(x)}]; }
  std::size_t size() const { return counts_.size(); }

  /// Squares with more bars are darker. One path per dimension and shade keeps the file small.
  void draw(Canvas& canvas) const {
    constexpr int shades = 12;
    std::map<int, std::size_t> most;
    for (const auto& [where, count] : counts_) {
      std::size_t& known = most[std::get<0>(where)];
      known = std::max(known, count);
    }
    std::map<std::pair<int, int>, Outline> outlines;
    for (const auto& [where, count] : counts_) {
      const auto [dim, row, column] = where;
      const double part = std::log1p(static_cast<double>(count)) /
                          std::log1p(static_cast<double>(std::max<std::size_t>(most[dim], 4)));
      outlines[{dim, static_cast<int>(shades * part)}]
          .move_to(side_ * static_cast<double>(column), side_ * static_cast<double>(row))
          .horizontal_by(side_)
          .vertical_by(side_)
          .horizontal_by(-side_)
          .close();
    }
    for (auto& [kind, outline] : outlines) {
      const double opacity = 0.2 + 0.7 * kind.second / shades;
      canvas.shape(std::move(outline),
                   {.fill = colour_of_dim(kind.first), .fill_opacity = opacity, .crisp = true});
    }
  }

 private:
  long number(double position) const { return static_cast<long>(std::floor(position / side_)); }

  double side_;
  std::map<std::tuple<int, long, long>, std::size_t> counts_;
};

/// The axes of a diagram, and the positions of bars in it.
class Frame {
 public:
  Frame(const Barcode& barcode, const PlotOptions& options, double top)
      : infinite_(std::ranges::any_of(barcode, &Bar::is_infinite)),
        from_minus_infinity_(
            std::ranges::any_of(barcode, [](const Bar& bar) { return bar.birth == -kInfinity; })),
        top_(top),
        left_(kLeft + (from_minus_infinity_ ? 1.5 * kInfinityRoom : 0)),
        finite_top_(top + (infinite_ ? kInfinityRoom : 0)),
        bottom_(finite_top_ + (kRight - left_)),
        range_(widened(finite_range(barcode, options), options.axis.logarithmic)),
        births_(range_, options, left_, kRight),
        deaths_(range_, options, bottom_, finite_top_) {}

  double left() const { return left_; }
  double bottom() const { return bottom_; }

  std::pair<double, double> place_of(const Bar& bar) const {
    return {bar.birth == -kInfinity ? kLeft + 5 : births_.at(bar.birth),
            bar.is_infinite() ? top_ + 4 : deaths_.at(bar.death)};
  }

  void draw(Canvas& canvas, const std::string& value_label) const {
    Outline below;  // the area below the diagonal, where no bar can be
    below.move_to(left_, bottom_).line_to(kRight, finite_top_).vertical_to(bottom_).close();
    canvas.shape(std::move(below), {.fill = 0xf3f3f3});
    const std::vector<Axis::Tick> ticks = deaths_.ticks(6);
    for (const Axis::Tick& tick : ticks)
      canvas.line(left_, tick.position, kRight, tick.position, kGrid, 0.5);
    births_.draw_below(canvas, finite_top_, bottom_, "Birth, " + lower_first(value_label));
    for (const Axis::Tick& tick : ticks) {
      canvas.line(kLeft - 2.5, tick.position, kLeft, tick.position, kInk, 0.6);
      canvas.text(kLeft - 4, tick.position + 2.5, tick.label, Anchor::end);
    }
    canvas.line(kLeft, top_, kLeft, bottom_, kInk, 0.6);
    const std::string unit = deaths_.unit().empty() ? "" : " (" + deaths_.unit() + ")";
    canvas.text(9, (finite_top_ + bottom_) / 2, "Death" + unit, Anchor::middle, 7.5, kInk,
                Look::upwards);
    canvas.line(left_, bottom_, kRight, finite_top_, kGrey, 0.7);
    const auto [infinity_x, infinity_y] = place_of({0, -kInfinity, kInfinity});
    if (infinite_) {
      canvas.line(kLeft, infinity_y, kRight, infinity_y, kGrey, 0.7, Stroke::dashed);
      canvas.text(kLeft - 4, infinity_y + 3.2, "∞", Anchor::end, 9);
    }
    if (from_minus_infinity_) {
      canvas.line(infinity_x, top_, infinity_x, bottom_, kGrey, 0.7, Stroke::dashed);
      canvas.text(infinity_x, bottom_ + 9.5, "−∞", Anchor::middle, 7);
    }
  }

 private:
  /// Widens a range by a margin, unless the result would not be finite. A lower end of 0 and a
  /// logarithmic range stay as they are.
  static Range widened(Range range, bool logarithmic) {
    if (logarithmic) return range;
    const double margin = 0.03 * (range.high / 2 - range.low / 2) * 2;
    if (std::isfinite(range.high + margin) && std::isfinite(range.low - margin)) {
      range.high += margin;
      range.low -= range.low == 0 ? 0 : margin;
    }
    return range;
  }

  bool infinite_, from_minus_infinity_;
  double top_, left_, finite_top_, bottom_;
  Range range_;
  Axis births_, deaths_;
};

void draw_markers(Canvas& canvas, const Places& places, double left) {
  std::map<int, Outline> shapes;
  for (const auto& [where, marker] : places)
    add_shape(shapes[std::get<0>(where)], std::get<0>(where), marker.x, marker.y,
              radius_of(marker.count));
  // White edges separate the markers. If there are many markers, the edges would hide them.
  const auto edge = places.size() <= 60 ? std::optional(kWhite) : std::nullopt;
  for (auto& [dim, outline] : shapes)
    canvas.shape(
        std::move(outline),
        {.fill = colour_of_dim(dim), .stroke = edge, .stroke_width = 0.25, .fill_opacity = 0.8});
  // If there are few markers, there is room for the number of bars that each marker represents.
  if (places.size() > 40) return;
  for (const auto& [where, marker] : places) {
    if (marker.count == 1) continue;
    // Puts the number at the upper left, away from the diagonal, but not over the axis.
    const bool near_axis = marker.x < left + 16;
    const double shift = radius_of(marker.count) + 0.8;
    canvas.text(near_axis ? marker.x + shift : marker.x - shift, marker.y - 1.5,
                fmt::format("×{}", grouped(marker.count)), near_axis ? Anchor::start : Anchor::end,
                5.5, colour_of_dim(std::get<0>(where)));
  }
}

void draw_density(Canvas& canvas, const std::vector<Bar>& bars, const Frame& frame) {
  constexpr std::size_t most = 15000;  // with this many squares, the file stays below 1 MB
  std::optional<Squares> squares;
  for (int side = 6; !squares || squares->size() > most; ++side) {
    squares.emplace(side);
    for (const Bar& bar : bars) {
      const auto [x, y] = frame.place_of(bar);
      squares->add(bar.dim, x, y);
    }
  }
  squares->draw(canvas);
}

/// Draws the legend below the diagonal, where no bar can be.
void draw_legend(Canvas& canvas, const Barcode& barcode, double bottom, bool joined,
                 std::size_t shaded) {
  double y = bottom - 5;
  const auto remark = [&](const std::string& text) {
    canvas.text(kRight - 5, y, text, Anchor::end, 5.5, kGrey);
    y -= 7;
  };
  if (joined) remark("larger: several bars");
  if (shaded > 0) remark(fmt::format("shaded: {} shorter ones", grouped(shaded)));
  y -= 1;
  const std::vector<int> dims = dims_of(barcode);
  for (auto dim = dims.rbegin(); dim != dims.rend(); ++dim, y -= 9.5) {
    const double x = kRight - 48;
    Outline shape;
    add_shape(shape, *dim, x, y - 2.4, 2.2);
    canvas.shape(std::move(shape), {.fill = colour_of_dim(*dim)});
    canvas.text(x + 6, y, with_subscript("H", *dim), Anchor::start, 7);
    canvas.text(kRight - 5, y, grouped(barcode.bars(*dim).size()), Anchor::end, 7, kGrey);
  }
}

}  // namespace

Drawing draw_diagram(const Barcode& barcode, std::size_t beyond, const PlotOptions& options) {
  Canvas canvas;
  const Frame frame(barcode, options, options.title.empty() ? 8 : 20);
  if (!options.title.empty()) canvas.title(options.title);
  frame.draw(canvas, options.value_label);

  const auto place_of = [&](const Bar& bar) { return frame.place_of(bar); };
  Parts parts{{barcode.begin(), barcode.end()}, {}};
  Places places = gather(parts.crisp, place_of);
  if (places.size() > kMostMarkers) {
    parts = parts_of(barcode);
    places = gather(parts.crisp, place_of);
    draw_density(canvas, parts.rest, frame);
  }
  draw_markers(canvas, places, frame.left());
  const bool joined =
      std::ranges::any_of(places, [](const auto& place) { return place.second.count > 1; });
  if (barcode.empty())
    canvas.text(frame.left() + 50, frame.bottom() - 150, "no bars", Anchor::middle, 7, kGrey);
  draw_legend(canvas, barcode, frame.bottom(), joined, parts.rest.size());
  explain_beyond(canvas, beyond, frame.bottom());
  return canvas.finish(frame.bottom() + 25,
                       options.title.empty() ? "Persistence diagram" : options.title,
                       "Persistence diagram: " + description_of(barcode));
}

}  // namespace ph::plot
