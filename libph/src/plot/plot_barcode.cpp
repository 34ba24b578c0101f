// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "libph/src/plot/plot_intervals.hpp"

namespace ph::plot {
namespace {

constexpr double kGap = 7;  // gap between dimensions

/// The drawing of one dimension.
struct Panel {
  int dim = 0;
  std::span<const Bar> bars;
  Longest places;  // positions in `bars`, in the barcode's order
};

/// The number of rows for each dimension. A dimension gets one row per bar if possible, otherwise a
/// fair share of the rows.
std::vector<std::size_t> share_rows(const std::vector<Panel>& panels) {
  std::vector<std::size_t> rows(panels.size(), 0);
  std::size_t free = std::max(kRows, 4 * panels.size());
  for (bool given = true; given && free > 0;) {
    given = false;
    for (std::size_t i = 0; i < panels.size() && free > 0; ++i) {
      if (rows[i] == panels[i].bars.size()) continue;
      ++rows[i];
      --free;
      given = true;
    }
  }
  return rows;
}

std::vector<Panel> panels_of(const Barcode& barcode) {
  std::vector<Panel> panels;
  for (const int dim : dims_of(barcode)) panels.push_back({dim, barcode.bars(dim), {}});
  const std::vector<std::size_t> rows = share_rows(panels);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::span<const Bar> bars = panels[i].bars;
    panels[i].places =
        longest_of(bars.size(), rows[i], [&](std::size_t k) { return bars[k].persistence(); });
  }
  return panels;
}

}  // namespace

Drawing draw_barcode(const Barcode& barcode, std::size_t beyond, const PlotOptions& options) {
  Canvas canvas;
  const std::vector<Panel> panels = panels_of(barcode);
  const Axis axis(finite_range(barcode, options), options, kFirstValue, kLastValue);
  std::size_t rows = 0;
  for (const Panel& panel : panels) rows += panel.places.crisp.size();
  const double pitch = pitch_of(rows);
  const auto lines_height = [&](const Panel& panel) {
    return pitch * static_cast<double>(panel.places.crisp.size());
  };

  const double top = options.title.empty() ? 8 : 20;
  double bottom = top;
  for (const Panel& panel : panels)
    bottom += std::max(lines_height(panel), 14.0) +
              (panel.places.rest.empty() ? 0 : kDensityHeight) + kGap;
  bottom = std::max(bottom, top + 30);

  if (!options.title.empty()) canvas.title(options.title);
  axis.draw_below(canvas, top, bottom, options.value_label);
  if (panels.empty())
    canvas.text((kFirstValue + kLastValue) / 2, top + 18, "no bars", Anchor::middle, 7, kGrey);
  double y = top;
  bool any_infinite = false;
  for (const Panel& panel : panels) {
    if (y > top) canvas.line(6, y - kGap / 2, kLastValue + kTriangle, y - kGap / 2, kGrid, 0.5);
    const Colour colour = colour_of_dim(panel.dim);
    const double height = std::max(lines_height(panel), 14.0);
    canvas.text(6, y + 8, with_subscript("H", panel.dim), Anchor::start, 9, colour, Look::bold);
    canvas.text(6, y + 15.5, grouped(panel.bars.size()), Anchor::start, 6, kGrey);
    Lines lines(axis, pitch);
    double row = y + (height - lines_height(panel)) / 2 + 0.5 * pitch;
    for (const std::size_t i : panel.places.crisp) {
      lines.add(panel.bars[i].birth, panel.bars[i].death, row);
      row += pitch;
    }
    lines.draw(canvas, colour);
    y += height;
    if (!panel.places.rest.empty()) {
      Density density(axis);
      for (const std::size_t i : panel.places.rest)
        density.add(panel.bars[i].birth, panel.bars[i].death);
      density.draw(canvas, y, colour);
      y += kDensityHeight;
    }
    y += kGap;
    any_infinite = any_infinite || std::ranges::any_of(panel.bars, &Bar::is_infinite);
  }
  if (any_infinite) explain_triangles(canvas, bottom);
  explain_beyond(canvas, beyond, bottom);
  return canvas.finish(bottom + 25, options.title.empty() ? "Barcode" : options.title,
                       "Barcode: " + description_of(barcode));
}

}  // namespace ph::plot
