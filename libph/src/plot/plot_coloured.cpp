// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "libph/src/plot/plot_canvas.hpp"
#include "ph/error.hpp"

namespace ph::plot {
namespace {

constexpr std::size_t kColumns = 3;
constexpr double kLeft = 6, kRight = kWidth - 6;
constexpr double kGap = 12;   // gap between columns
constexpr double kRow = 9.5;  // height of a row
constexpr double kSquare = 6;

/// Draws the legend column by column. @return the top of the free space below it.
double draw_legend(Canvas& canvas, const ColouredPicture& picture, double top) {
  if (!picture.heading.empty()) {
    canvas.text(kLeft, top + 6, picture.heading, Anchor::start, 6, kGrey);
    top += 9;
  }
  constexpr double width = (kRight - kLeft - (kColumns - 1) * kGap) / kColumns;
  const std::size_t rows = (picture.legend.size() + kColumns - 1) / kColumns;
  for (std::size_t i = 0; i < picture.legend.size(); ++i) {
    const auto& [colour, name, value] = picture.legend[i];
    const std::size_t column = i / rows;
    const double x = kLeft + static_cast<double>(column) * (width + kGap);
    const double y = top + kRow * static_cast<double>(i % rows);
    if (colour) canvas.rect(x, y + 0.5, kSquare, kSquare, *colour);
    canvas.text(colour ? x + kSquare + 3 : x, y + 6, name);
    canvas.text(x + width, y + 6, value, Anchor::end, 7, kGrey);
  }
  return top + kRow * static_cast<double>(rows);
}

}  // namespace

Drawing draw_coloured(const ColouredPicture& picture, const PlotOptions& options) {
  Canvas canvas;
  const double top = options.title.empty() ? 0 : 16;
  if (!options.title.empty()) canvas.title(options.title);
  const Raster& raster = picture.raster;
  raster.check();
  if (raster.samples.empty())
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: found {} x {} pixels, expected at least 1 x 1", raster.name,
                            raster.width, raster.height));
  // Each pixel of the raster becomes one pixel of a PNG, unless the raster has too many pixels.
  const double pixel = kWidth / static_cast<double>(std::max(kPixels, raster.width));
  const double width = pixel * static_cast<double>(raster.width);
  const double height = pixel * static_cast<double>(raster.height);
  canvas.picture((kWidth - width) / 2, top, width, height, raster);
  for (const auto& [x, y, text] : picture.marks) {
    constexpr double size = 6.5, half = 0.36 * size;  // size of a digit
    canvas.text((kWidth - width) / 2 + pixel * x, top + pixel * y + half, text, Anchor::middle,
                size, kInk, Look::haloed);
  }
  double bottom = top + height;
  if (!picture.legend.empty()) bottom = draw_legend(canvas, picture, bottom + 4) + 2;
  return canvas.finish(bottom, options.title.empty() ? "Picture" : options.title,
                       picture.description);
}

}  // namespace ph::plot
