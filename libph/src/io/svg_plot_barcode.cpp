// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "svg_plot_canvas.hpp"

namespace ph::svg {
namespace {

constexpr double kLeft = 30, kRight = 242;  // of the values
constexpr double kTriangle = 4.5;           // room behind the last value
constexpr std::size_t kRows = 96;           // bars drawn one by one, in all dimensions together
constexpr double kGap = 7;                  // between dimensions
constexpr double kStrip = 7;                // height of the density of the other bars

/// What is drawn of one dimension.
struct Panel {
  int dim = 0;
  std::span<const Bar> bars;
  std::vector<std::size_t> crisp;  // positions of the longest bars, in the barcode's order
  std::vector<std::size_t> rest;
};

/// The rows of each dimension: as many as it has bars, as far as all get the same at least.
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

void choose_longest(Panel& panel, std::size_t rows) {
  std::vector<std::size_t> order(panel.bars.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(rows);
  const auto longer = [&](std::size_t a, std::size_t b) {
    const double x = panel.bars[a].persistence(), y = panel.bars[b].persistence();
    return x != y ? x > y : a < b;
  };
  if (rows < order.size()) std::nth_element(order.begin(), middle, order.end(), longer);
  panel.crisp.assign(order.begin(), middle);
  panel.rest.assign(middle, order.end());
  std::ranges::sort(panel.crisp);
}

std::vector<Panel> panels_of(const Barcode& barcode) {
  std::vector<Panel> panels;
  for (const int dim : dims_of(barcode)) panels.push_back({dim, barcode.bars(dim), {}, {}});
  const std::vector<std::size_t> rows = share_rows(panels);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    // A strip for a handful takes more room than the handful.
    constexpr std::size_t kHandful = 8;
    const std::size_t all = panels[i].bars.size();
    choose_longest(panels[i], all - rows[i] <= kHandful ? all : rows[i]);
  }
  return panels;
}

/// Lines and triangles of the bars that have a row each.
void draw_crisp(Canvas& canvas, const Panel& panel, const Axis& axis, double top, double pitch) {
  const double half = std::clamp(0.62 * pitch, 2.0, 2.6);
  std::string lines, triangles;
  for (std::size_t i = 0; i < panel.crisp.size(); ++i) {
    const Bar& bar = panel.bars[panel.crisp[i]];
    const double y = top + (static_cast<double>(i) + 0.5) * pitch;
    const double x = std::isinf(bar.birth) ? axis.from() - 3 : axis.at(bar.birth);
    const double end =
        bar.is_infinite() ? kRight + kTriangle - 1.7 * half : std::max(axis.at(bar.death), x + 0.5);
    lines += fmt::format("M{} {}H{}", coordinate(x), coordinate(y), coordinate(end));
    if (bar.is_infinite())
      triangles += fmt::format("M{} {}v{}l{} {}z", coordinate(end), coordinate(y - half),
                               coordinate(2 * half), coordinate(1.7 * half), coordinate(-half));
  }
  const std::string_view colour = colour_of_dim(panel.dim);
  canvas.path(lines, fmt::format("stroke=\"{}\" stroke-width=\"{}\" fill=\"none\"", colour,
                                 coordinate(std::clamp(0.6 * pitch, 0.7, 2.2))));
  canvas.path(triangles, fmt::format("fill=\"{}\"", colour));
}

/// How many of the other bars live at each value, as the darkness of a strip.
void draw_density(Canvas& canvas, const Panel& panel, const Axis& axis, double top) {
  constexpr double kColumn = 0.5;
  constexpr int kShades = 24;
  const auto columns = static_cast<std::size_t>(std::ceil((kRight - kLeft) / kColumn)) + 1;
  const auto column_of = [&](double x) {
    return std::min(columns - 1, static_cast<std::size_t>((x - kLeft) / kColumn));
  };
  std::vector<double> count(columns + 1, 0);
  for (const std::size_t i : panel.rest) {
    const Bar& bar = panel.bars[i];
    count[column_of(axis.at(bar.birth))] += 1;
    count[bar.is_infinite() ? columns : column_of(axis.at(bar.death)) + 1] -= 1;
  }
  std::partial_sum(count.begin(), count.end(), count.begin());
  const double most = *std::ranges::max_element(count);
  const auto shade_of = [&](std::size_t column) {
    if (count[column] < 0.5) return 0;
    return 2 + static_cast<int>((kShades - 2) * std::log1p(count[column]) / std::log1p(most));
  };
  for (std::size_t begin = 0; begin < columns;) {
    std::size_t end = begin + 1;
    while (end < columns && shade_of(end) == shade_of(begin)) ++end;
    const double x = kLeft + kColumn * static_cast<double>(begin);
    const double width = std::min(kColumn * static_cast<double>(end - begin), kRight - x);
    if (shade_of(begin) > 0 && width > 0)
      canvas.rect(x, top, width, kStrip, colour_of_dim(panel.dim),
                  static_cast<double>(shade_of(begin)) / kShades);
    begin = end;
  }
}

}  // namespace

std::string draw_barcode(const Barcode& barcode, const PlotOptions& options) {
  Canvas canvas;
  const std::vector<Panel> panels = panels_of(barcode);
  const auto [low, high] = finite_range(barcode);
  const Axis axis(low, high, kLeft, kRight);
  std::size_t rows = 0;
  for (const Panel& panel : panels) rows += panel.crisp.size();
  const double pitch =
      std::clamp(190.0 / static_cast<double>(std::max<std::size_t>(rows, 1)), 2.0, 7.0);

  const double top = options.title.empty() ? 8 : 20;
  double bottom = top;
  for (const Panel& panel : panels) {
    const double lines = pitch * static_cast<double>(panel.crisp.size());
    bottom += std::max(lines, 14.0) + (panel.rest.empty() ? 0 : kStrip + 9) + kGap;
  }
  bottom = std::max(bottom, top + 30);

  if (!options.title.empty()) canvas.title(options.title);
  axis.draw_below(canvas, top, bottom, options.value_label);
  if (panels.empty())
    canvas.text((kLeft + kRight) / 2, top + 18, "no bars", Anchor::middle, 7, kGrey);
  double y = top;
  bool any_infinite = false;
  for (const Panel& panel : panels) {
    if (y > top) canvas.line(6, y - kGap / 2, kRight + kTriangle, y - kGap / 2, kGrid, 0.5);
    const double lines = pitch * static_cast<double>(panel.crisp.size());
    const double height = std::max(lines, 14.0);
    canvas.text(6, y + 8, with_subscript("H", panel.dim), Anchor::start, 9,
                colour_of_dim(panel.dim), "font-weight=\"bold\"");
    canvas.text(6, y + 15.5, grouped(panel.bars.size()), Anchor::start, 6, kGrey);
    draw_crisp(canvas, panel, axis, y + (height - lines) / 2, pitch);
    y += height;
    if (!panel.rest.empty()) {
      canvas.text(kLeft, y + 6.5,
                  fmt::format("and {} shorter ones, as a density:", grouped(panel.rest.size())),
                  Anchor::start, 5.5, kGrey);
      draw_density(canvas, panel, axis, y + 8.5);
      y += kStrip + 9;
    }
    y += kGap;
    any_infinite = any_infinite || std::ranges::any_of(panel.bars, [](const Bar& bar) {
                     return bar.is_infinite();
                   });
  }
  if (any_infinite) {
    const double x = kRight + kTriangle, line = bottom + 20;
    canvas.path(fmt::format("M{} {}v4.4l3.8 -2.2z", coordinate(x - 3.8), coordinate(line - 4.6)),
                fmt::format("fill=\"{}\"", kGrey));
    canvas.text(x - 5.5, line, "never dies", Anchor::end, 6, kGrey);
  }
  return canvas.finish(bottom + 25, options.title.empty() ? "Barcode" : options.title,
                       "Barcode: " + description_of(barcode));
}

}  // namespace ph::svg
