// SPDX-License-Identifier: MIT
#include "libph/src/plot/plot_intervals.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ph::plot {
namespace {

constexpr double kStrip = 7;     // height of a density strip
constexpr double kColumn = 0.5;  // width of a part with constant darkness

}  // namespace

double pitch_of(std::size_t rows) {
  return std::clamp(190.0 / static_cast<double>(std::max<std::size_t>(rows, 1)), 2.0, 7.0);
}

Lines::Lines(const Axis& axis, double pitch)
    : axis_(axis), pitch_(pitch), half_(std::clamp(0.62 * pitch, 2.0, 2.6)) {}

double Lines::start(double birth) const {
  return std::isinf(birth) ? axis_.from() - 3 : axis_.at(birth);
}

void Lines::add(double birth, double death, double y) {
  const bool infinite = death == kInfinity;
  const double x = start(birth);
  const double end =
      infinite ? kLastValue + kTriangle - 1.7 * half_ : std::max(axis_.at(death), x + 0.5);
  lines_.move_to(x, y).horizontal_to(end);
  if (infinite)
    triangles_.move_to(end, y - half_).vertical_by(2 * half_).line_by(1.7 * half_, -half_).close();
}

void Lines::draw(Canvas& canvas, Colour colour) {
  canvas.shape(std::move(lines_),
               {.stroke = colour, .stroke_width = std::clamp(0.6 * pitch_, 0.7, 2.2)});
  canvas.shape(std::move(triangles_), {.fill = colour});
}

Density::Density(const Axis& axis)
    : axis_(axis),
      change_(static_cast<std::size_t>(std::ceil((kLastValue - kFirstValue) / kColumn)) + 2) {}

std::size_t Density::column_of(double value) const {
  return std::min(change_.size() - 2,
                  static_cast<std::size_t>((axis_.at(value) - kFirstValue) / kColumn));
}

void Density::add(double birth, double death) {
  ++all_;
  change_[column_of(birth)] += 1;
  change_[death == kInfinity ? change_.size() - 1 : column_of(death) + 1] -= 1;
}

void Density::draw(Canvas& canvas, double top, Colour colour) const {
  constexpr int shades = 24;
  canvas.text(kFirstValue, top + 6.5,
              fmt::format("and {} shorter ones, as a density:", grouped(all_)), Anchor::start, 5.5,
              kGrey);
  std::vector<double> count(change_.size());
  std::partial_sum(change_.begin(), change_.end(), count.begin());
  const double most = *std::ranges::max_element(count);
  const auto shade_of = [&](std::size_t column) {
    if (count[column] < 0.5) return 0;
    return 2 + static_cast<int>((shades - 2) * std::log1p(count[column]) / std::log1p(most));
  };
  const std::size_t columns = change_.size() - 1;
  for (std::size_t begin = 0; begin < columns;) {
    std::size_t end = begin + 1;
    while (end < columns && shade_of(end) == shade_of(begin)) ++end;
    const double x = kFirstValue + kColumn * static_cast<double>(begin);
    const double width = std::min(kColumn * static_cast<double>(end - begin), kLastValue - x);
    if (shade_of(begin) > 0 && width > 0)
      canvas.rect(x, top + 8.5, width, kStrip, colour,
                  static_cast<double>(shade_of(begin)) / shades);
    begin = end;
  }
}

void explain_triangles(Canvas& canvas, double bottom) {
  const double x = kLastValue + kTriangle, line = bottom + 20;
  Outline triangle;
  triangle.move_to(x - 3.8, line - 4.6).vertical_by(4.4).line_by(3.8, -2.2).close();
  canvas.shape(std::move(triangle), {.fill = kGrey});
  canvas.text(x - 5.5, line, "never dies", Anchor::end, 6, kGrey);
}

}  // namespace ph::plot
