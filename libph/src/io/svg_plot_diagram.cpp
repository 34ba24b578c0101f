// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "svg_plot_canvas.hpp"

namespace ph::svg {
namespace {

constexpr double kLeft = 34, kRight = 242;
constexpr double kInfinityRoom = 14;        // between the infinity line and the finite values
constexpr std::size_t kMostMarkers = 6000;  // keeps the file below 1 MB

/// Bars of one dimension that cannot be told apart in the picture.
struct Marker {
  double x = 0, y = 0;
  std::size_t count = 0;
};

using Places = std::map<std::tuple<int, long, long>, Marker>;

/// Joins what lies in one square of side `cell`; a marker of several stands in their middle.
template <class PlaceOf>
Places gather(const Barcode& barcode, double cell, PlaceOf&& place_of) {
  Places places;
  for (const Bar& bar : barcode) {
    const auto [x, y] = place_of(bar);
    Marker& marker = places[{bar.dim, std::lround(x / cell), std::lround(y / cell)}];
    ++marker.count;
    marker.x += (x - marker.x) / static_cast<double>(marker.count);
    marker.y += (y - marker.y) / static_cast<double>(marker.count);
  }
  return places;
}

double radius_of(std::size_t count) {
  return 1.7 * (1 + 0.45 * std::log10(static_cast<double>(count)));
}

/// A shape of its own for each dimension: colours may be lost in print.
std::string shape_of(int dim, double x, double y, double r) {
  switch (dim % 4) {
    case 1:  // a triangle
      return fmt::format("M{} {}l{} {}h{}z", coordinate(x), coordinate(y - 1.25 * r),
                         coordinate(1.15 * r), coordinate(2 * r), coordinate(-2.3 * r));
    case 2:  // a square
      return fmt::format("M{} {}h{}v{}h{}z", coordinate(x - 0.9 * r), coordinate(y - 0.9 * r),
                         coordinate(1.8 * r), coordinate(1.8 * r), coordinate(-1.8 * r));
    case 3:  // a diamond
      return fmt::format("M{} {}l{} {}l{} {}l{} {}z", coordinate(x), coordinate(y - 1.3 * r),
                         coordinate(1.1 * r), coordinate(1.3 * r), coordinate(-1.1 * r),
                         coordinate(1.3 * r), coordinate(-1.1 * r), coordinate(-1.3 * r));
    default:  // a circle
      return fmt::format("M{} {}a{} {} 0 1 0 {} 0a{} {} 0 1 0 {} 0", coordinate(x - r),
                         coordinate(y), coordinate(r), coordinate(r), coordinate(2 * r),
                         coordinate(r), coordinate(r), coordinate(-2 * r));
  }
}

/// "Filtration value" in the middle of a phrase; words like "XY" stay.
std::string lower_first(std::string text) {
  const auto in = [](char c, char a, char b) { return c >= a && c <= b; };
  if (text.size() > 1 && in(text[0], 'A', 'Z') && in(text[1], 'a', 'z'))
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

void draw_legend(Canvas& canvas, const Barcode& barcode, double bottom, bool joined) {
  const std::vector<int> dims = dims_of(barcode);
  // Below the diagonal no bar can be: that is where the legend has room.
  double y = bottom - 6 - (joined ? 8 : 0);
  if (joined) canvas.text(kRight - 5, bottom - 5, "larger: several bars", Anchor::end, 5.5, kGrey);
  for (auto dim = dims.rbegin(); dim != dims.rend(); ++dim, y -= 9.5) {
    const double x = kRight - 48;
    canvas.path(shape_of(*dim, x, y - 2.4, 2.2), fmt::format("fill=\"{}\"", colour_of_dim(*dim)));
    canvas.text(x + 6, y, with_subscript("H", *dim), Anchor::start, 7);
    canvas.text(kRight - 5, y, grouped(barcode.bars(*dim).size()), Anchor::end, 7, kGrey);
  }
}

}  // namespace

std::string draw_diagram(const Barcode& barcode, const PlotOptions& options) {
  Canvas canvas;
  auto [low, high] = finite_range(barcode);
  const double margin = 0.03 * (high / 2 - low / 2) * 2;
  if (std::isfinite(high + margin) && std::isfinite(low - margin)) {
    high += margin;
    low -= low == 0 ? 0 : margin;
  }
  const bool from_minus_infinity =
      std::ranges::any_of(barcode, [](const Bar& bar) { return bar.birth == -kInfinity; });
  const bool infinite = std::ranges::any_of(barcode, [](const Bar& b) { return b.is_infinite(); });
  const double left = kLeft + (from_minus_infinity ? 1.5 * kInfinityRoom : 0);
  const double top = options.title.empty() ? 8 : 20;
  const double finite_top = top + (infinite ? kInfinityRoom : 0);
  const double bottom = finite_top + (kRight - left);
  const Axis births(low, high, left, kRight);
  const Axis deaths(low, high, bottom, finite_top);

  if (!options.title.empty()) canvas.title(options.title);
  canvas.path(fmt::format("M{0} {1}L{2} {3}V{1}z", coordinate(left), coordinate(bottom),
                          coordinate(kRight), coordinate(finite_top)),
              "fill=\"#f3f3f3\"");
  births.draw_below(canvas, finite_top, bottom, "Birth, " + lower_first(options.value_label));
  for (const Axis::Tick& tick : deaths.ticks(6)) {
    canvas.line(left, tick.position, kRight, tick.position, kGrid, 0.5);
    canvas.line(kLeft - 2.5, tick.position, kLeft, tick.position, kInk, 0.6);
    canvas.text(kLeft - 4, tick.position + 2.5, tick.label, Anchor::end);
  }
  canvas.line(kLeft, top, kLeft, bottom, kInk, 0.6);
  const double middle = (finite_top + bottom) / 2;
  const std::string unit = deaths.unit().empty() ? "" : " (" + deaths.unit() + ")";
  canvas.text(9, middle, "Death" + unit, Anchor::middle, 7.5, kInk,
              fmt::format("transform=\"rotate(-90 9 {})\"", coordinate(middle)));
  canvas.line(left, bottom, kRight, finite_top, kGrey, 0.7);
  const double infinity_y = top + 4, infinity_x = kLeft + 5;
  if (infinite) {
    canvas.line(kLeft, infinity_y, kRight, infinity_y, kGrey, 0.7, "stroke-dasharray=\"3 2\"");
    canvas.text(kLeft - 4, infinity_y + 3.2, "∞", Anchor::end, 9);
  }
  if (from_minus_infinity) {
    canvas.line(infinity_x, top, infinity_x, bottom, kGrey, 0.7, "stroke-dasharray=\"3 2\"");
    canvas.text(infinity_x, bottom + 9.5, "−∞", Anchor::middle, 7);
  }

  const auto place_of = [&](const Bar& bar) {
    return std::pair(bar.birth == -kInfinity ? infinity_x : births.at(bar.birth),
                     bar.is_infinite() ? infinity_y : deaths.at(bar.death));
  };
  double cell = 0.25;
  Places places = gather(barcode, cell, place_of);
  while (places.size() > kMostMarkers) places = gather(barcode, cell *= 1.5, place_of);

  const bool joined =
      std::ranges::any_of(places, [](const auto& place) { return place.second.count > 1; });
  std::map<int, std::string> shapes;
  for (const auto& [where, marker] : places)
    shapes[std::get<0>(where)] +=
        shape_of(std::get<0>(where), marker.x, marker.y, radius_of(marker.count));
  // White edges keep single markers apart; where there are many they would hide them.
  const std::string edge = places.size() <= 60 ? " stroke=\"#ffffff\" stroke-width=\"0.25\"" : "";
  for (const auto& [dim, data] : shapes)
    canvas.path(data, fmt::format("fill=\"{}\" fill-opacity=\"0.8\"{}", colour_of_dim(dim), edge));
  // Few markers have room for the number of bars that each stands for.
  if (places.size() <= 40)
    for (const auto& [where, marker] : places)
      if (marker.count > 1) {
        // To the upper left, away from the diagonal, but not over the axis.
        const bool near_axis = marker.x < left + 16;
        const double shift = radius_of(marker.count) + 0.8;
        canvas.text(near_axis ? marker.x + shift : marker.x - shift, marker.y - 1.5,
                    fmt::format("×{}", grouped(marker.count)),
                    near_axis ? Anchor::start : Anchor::end, 5.5,
                    colour_of_dim(std::get<0>(where)));
      }
  if (barcode.empty()) canvas.text(left + 50, middle - 50, "no bars", Anchor::middle, 7, kGrey);
  draw_legend(canvas, barcode, bottom, joined);
  return canvas.finish(bottom + 25, options.title.empty() ? "Persistence diagram" : options.title,
                       "Persistence diagram: " + description_of(barcode));
}

}  // namespace ph::svg
