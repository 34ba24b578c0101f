// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libph/src/plot/plot_canvas.hpp"

namespace ph::plot {
namespace {

constexpr double kLeft = 38, kRight = 242;
constexpr double kHeight = 52, kGap = 9;  // height of one curve, and the gap between curves
constexpr double kColumn = 0.25;  // width of a column, inside which steps are indistinguishable

/// A step of a curve: `living` bars are alive between position x and the next step.
struct Step {
  double x = 0;
  long living = 0;
};

/// The number of living bars as a function of the position, with a step at each change.
std::vector<Step> steps_of(std::span<const Bar> bars, const Axis& axis) {
  std::vector<std::pair<double, long>> events;
  events.reserve(2 * bars.size());
  for (const Bar& bar : bars) {
    events.emplace_back(bar.birth, 1);
    if (!bar.is_infinite()) events.emplace_back(bar.death, -1);
  }
  std::ranges::sort(events);
  std::vector<Step> steps;
  long living = 0;
  for (std::size_t i = 0; i < events.size();) {
    const double value = events[i].first;
    for (; i < events.size() && events[i].first == value; ++i) living += events[i].second;
    steps.push_back({axis.at(value), living});
  }
  return steps;
}

/// Keeps the first, lowest, highest and last step of each column of the picture.
std::vector<Step> thinned(const std::vector<Step>& steps) {
  std::vector<Step> kept;
  for (std::size_t begin = 0; begin < steps.size();) {
    const double column = std::floor(steps[begin].x / kColumn);
    std::size_t end = begin, low = begin, high = begin;
    for (; end < steps.size() && std::floor(steps[end].x / kColumn) == column; ++end) {
      if (steps[end].living < steps[low].living) low = end;
      if (steps[end].living > steps[high].living) high = end;
    }
    std::vector<std::size_t> chosen{begin, low, high, end - 1};
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const std::size_t i : chosen) kept.push_back(steps[i]);
    begin = end;
  }
  return kept;
}

/// The step between the ticks of the vertical axis, chosen so that at most three ticks are above 0.
long count_step(long most) {
  long step = 1;
  for (long power = 1; power <= most; power *= 10)
    for (const long factor : {1L, 2L, 5L})
      if (most / step > 3) step = factor * power;
  return most / step > 3 ? 10 * step : step;
}

/// Writes 20k for 20,000. This loses no digits, because the ticks are round numbers.
std::string count_label(long count) {
  if (count >= 1'000'000 && count % 100'000 == 0)
    return fmt::format("{}M", static_cast<double>(count) / 1e6);
  if (count >= 10'000 && count % 1000 == 0) return fmt::format("{}k", count / 1000);
  return grouped(static_cast<std::size_t>(count));
}

void draw_curve(Canvas& canvas, std::span<const Bar> bars, int dim, const Axis& axis, double top) {
  const std::vector<Step> steps = thinned(steps_of(bars, axis));
  const double bottom = top + kHeight;
  long most = 1;
  for (const Step& step : steps) most = std::max(most, step.living);
  const auto height_of = [&](long living) {
    return bottom - kHeight * static_cast<double>(living) / (1.06 * static_cast<double>(most));
  };
  for (long tick = 0; tick <= most; tick += count_step(most)) {
    const double y = height_of(tick);
    if (tick > 0) canvas.line(kLeft, y, kRight, y, kGrid, 0.5);
    canvas.line(kLeft - 2.5, y, kLeft, y, kInk, 0.6);
    canvas.text(kLeft - 4, y + 2.2, count_label(tick), Anchor::end, 6);
  }
  canvas.line(kLeft, top, kLeft, bottom, kInk, 0.6);

  Outline curve;
  double from = kRight;
  for (const Step& step : steps) {
    if (curve.empty()) {
      from = step.x;
      curve.move_to(step.x, bottom);
    } else {
      curve.horizontal_to(step.x);
    }
    curve.vertical_to(height_of(step.living));
  }
  if (!steps.empty()) {
    if (steps.back().living > 0) curve.horizontal_to(kRight);
    Outline closed = curve;
    closed.vertical_to(bottom).horizontal_to(from).close();
    canvas.shape(std::move(closed), {.fill = colour_of_dim(dim), .fill_opacity = 0.15});
    canvas.shape(std::move(curve), {.stroke = colour_of_dim(dim), .stroke_width = 0.9});
  }
  canvas.line(kLeft, bottom, kRight, bottom, kInk, 0.6);
  canvas.text(4, top + 8, with_subscript("β", dim), Anchor::start, 9, colour_of_dim(dim),
              Look::bold);
}

}  // namespace

Drawing draw_betti(const Barcode& barcode, std::size_t beyond, const PlotOptions& options) {
  Canvas canvas;
  const std::vector<int> dims = dims_of(barcode);
  const Axis axis(finite_range(barcode, options), options, kLeft, kRight);
  const double top = options.title.empty() ? 8 : 20;
  const auto panels = static_cast<double>(std::max<std::size_t>(dims.size(), 1));
  const double bottom = top + panels * (kHeight + kGap) - kGap;

  if (!options.title.empty()) canvas.title(options.title);
  axis.draw_below(canvas, top, bottom, options.value_label);
  if (dims.empty())
    canvas.text((kLeft + kRight) / 2, top + 18, "no bars", Anchor::middle, 7, kGrey);
  double y = top;
  for (const int dim : dims) {
    draw_curve(canvas, barcode.bars(dim), dim, axis, y);
    y += kHeight + kGap;
  }
  explain_beyond(canvas, beyond, bottom);
  return canvas.finish(bottom + 25, options.title.empty() ? "Betti curves" : options.title,
                       "Betti curves: " + description_of(barcode));
}

}  // namespace ph::plot
