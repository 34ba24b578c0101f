// SPDX-License-Identifier: MIT
// Chooses the bars that are drawn, and the size of the picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libph/src/plot/plot_canvas.hpp"
#include "ph/error.hpp"

namespace ph::plot {
namespace {

Outline shifted(const Outline& outline, double dx, double dy) {
  using Verb = Outline::Verb;
  Outline result;
  for (auto [verb, x, y] : outline.steps()) {
    const bool is_place = verb == Verb::move_to || verb == Verb::line_to;
    if (is_place || verb == Verb::horizontal_to) x += dx;
    if (is_place || verb == Verb::vertical_to) y += dy;
    result.add({verb, x, y});
  }
  return result;
}

/// Moves the elements of a drawing.
struct Shift {
  double dx, dy;

  void operator()(Line& line) const {
    line.x1 += dx;
    line.x2 += dx;
    line.y1 += dy;
    line.y2 += dy;
  }
  void operator()(Shape& shape) const { shape.outline = shifted(shape.outline, dx, dy); }
  template <class Placed>
  void operator()(Placed& placed) const {
    placed.x += dx;
    placed.y += dy;
  }
};

}  // namespace

bool is_shown(double birth, double death, const PlotAxis& limits) {
  return !(limits.high && birth > *limits.high) && !(limits.low && death < *limits.low);
}

Barcode shown_of(const Barcode& barcode, const PlotOptions& options, std::size_t& beyond) {
  const PlotAxis axis = limits_of(options);
  const auto is_off = [&](double value) {
    return std::isfinite(value) &&
           ((axis.low && value < *axis.low) || (axis.high && value > *axis.high));
  };
  Barcode shown;
  beyond = 0;
  for (const Bar& bar : barcode) {
    if (!options.dims.empty() && std::ranges::find(options.dims, bar.dim) == options.dims.end())
      continue;
    // A point of a diagram is either on the axis or not, but a line may be partly on the axis.
    const bool drawn = options.kind == PlotKind::diagram ? !is_off(bar.birth) && !is_off(bar.death)
                                                         : is_shown(bar.birth, bar.death, axis);
    if (drawn)
      shown.add(bar, {}, {});
    else
      ++beyond;  // mutant: plot-beyond
  }
  return shown;
}

void explain_beyond(Canvas& canvas, std::size_t beyond, double bottom) {
  if (beyond > 0) canvas.text(6, bottom + 20, grouped(beyond) + " beyond", Anchor::start, 6, kGrey);
}

Drawing fitted(Drawing drawing, const PlotOptions& options) {
  if (!options.size) return drawing;
  const auto width = static_cast<double>(options.size->width),
             height = static_cast<double>(options.size->height);
  if (!(width >= 1 && height >= 1 && width <= kMostPlotPixels && height <= kMostPlotPixels))
    throw Error(ErrorKind::usage, fmt::format("plot: found {} x {} pixels, expected 1 to {}", width,
                                              height, kMostPlotPixels));
  drawing.size = options.size;
  const double wide = std::max(drawing.width, drawing.height * width / height),
               high = wide * height / width;
  const Shift shift{(wide - drawing.width) / 2, (high - drawing.height) / 2};
  for (Element& element : drawing.elements) std::visit(shift, element);
  drawing.width = wide;
  drawing.height = high;
  return drawing;
}

}  // namespace ph::plot
