// SPDX-License-Identifier: MIT
#include "libph/src/plot/plot_coverage.hpp"

namespace ph::plot {
namespace {

/// The point of a line at a given height. The ends of the line have different heights.
Place at_height(Place from, Place to, double y) {
  return {from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y), y};
}
Place at_column(Place from, Place to, double x) {
  return {x, from.y + (to.y - from.y) * (x - from.x) / (to.x - from.x)};
}

}  // namespace

Coverage::Coverage(std::size_t width, std::size_t height)
    : width_(width),
      height_(height),
      change_((width + 1) * height),
      first_row_(height),
      end_row_(0) {}

void Coverage::add(Place from, Place to) {
  if (from.y == to.y) return;  // a horizontal edge does not change the coverage
  const auto bottom = static_cast<double>(height_);
  const double high = std::clamp(std::min(from.y, to.y), 0.0, bottom);
  const double low = std::clamp(std::max(from.y, to.y), 0.0, bottom);
  if (high == low) return;
  const auto first = static_cast<std::size_t>(high);
  const auto end = static_cast<std::size_t>(std::ceil(low));
  first_row_ = std::min(first_row_, first);
  end_row_ = std::max(end_row_, end);
  const bool down = from.y < to.y;
  for (std::size_t row = first; row < end; ++row) {
    const Place top = at_height(from, to, std::max(high, static_cast<double>(row)));
    const Place foot = at_height(from, to, std::min(low, static_cast<double>(row + 1)));
    add_within_row(row, down ? top : foot, down ? foot : top);
  }
}

void Coverage::add_within_row(std::size_t row, Place from, Place to) {
  // All pixels of the row are to the right of an edge that is left of the picture. No pixel is to
  // the right of an edge that is right of the picture.
  const auto right = static_cast<double>(width_);
  if (std::max(from.x, to.x) <= 0 || std::min(from.x, to.x) >= right || from.x == to.x) {
    from.x = to.x = std::clamp(from.x, 0.0, right);
    return add_within_pixel(row, from, to);
  }
  const bool rightwards = from.x < to.x;
  const Place ends[] = {rightwards ? from : to, rightwards ? to : from};
  Place last = ends[0];
  while (last.x < ends[1].x) {
    const double next = last.x < 0 ? 0 : last.x >= right ? ends[1].x : std::floor(last.x) + 1;
    const Place place = next < ends[1].x ? at_column(ends[0], ends[1], next) : ends[1];
    Place a = last, b = place;
    a.x = std::clamp(a.x, 0.0, right);
    b.x = std::clamp(b.x, 0.0, right);
    add_within_pixel(row, rightwards ? a : b, rightwards ? b : a);
    last = place;
  }
}

void Coverage::add_within_pixel(std::size_t row, Place from, Place to) {
  const auto column =
      std::min(width_, static_cast<std::size_t>(std::max(0.0, std::min(from.x, to.x))));
  if (column == width_) return;
  // Adds the part of this pixel that is to the right of the edge, and all pixels after it in the
  // row.
  const double height = to.y - from.y;
  const double middle = (from.x + to.x) / 2 - static_cast<double>(column);
  float* const change = change_.data() + row * (width_ + 1) + column;
  change[0] += static_cast<float>(height * (1 - middle));
  change[1] += static_cast<float>(height * middle);
}

void Coverage::add(std::span<const Place> corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    add(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]);
}

void Coverage::add_turned(std::span<const Place> corners) {
  if (signed_area(corners) >= 0) return add(corners);
  for (std::size_t i = corners.size(); i > 0; --i)
    add(corners[i - 1], corners[i > 1 ? i - 2 : corners.size() - 1]);
}

double signed_area(std::span<const Place> corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Place &a = corners[i], &b = corners[i + 1 < corners.size() ? i + 1 : 0];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

}  // namespace ph::plot
