// SPDX-License-Identifier: MIT
#include "ph/detail/segment/cloud_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ph::segment {
namespace {

constexpr std::size_t kMostListed = 16;
// The size of a digit in pixels. The width of a pixel is 88 mm / 1040.
constexpr double kDigitWidth = 17, kDigitHeight = 28;

/// Formats a number as "12,345".
std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), 1, ',');
  return text;
}

/// True if two numbers in the picture would cover each other.
bool collide(const ColouredPicture::Mark& a, const ColouredPicture::Mark& b) {
  const double width = kDigitWidth * static_cast<double>(a.text.size() + b.text.size()) / 2;
  return std::abs(a.x - b.x) < width && std::abs(a.y - b.y) < kDigitHeight;
}

}  // namespace

ColouredPicture with_legend(CloudPicture picture, std::span<const std::uint32_t> colours,
                            std::span<const std::uint32_t> numbers) {
  const auto points_of = [&](std::size_t segment) { return picture.points[segment + 1]; };
  std::vector<std::size_t> order(colours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), points_of);
  // If only one segment remains, it is listed itself instead of being counted as other.
  const std::size_t listed = order.size() <= kMostListed + 1 ? order.size() : kMostListed;

  ColouredPicture result;
  result.heading = "Segment, points";
  for (std::size_t k = 0; k < listed; ++k) {
    const std::size_t i = order[k];
    std::string name = std::to_string(numbers.empty() ? i + 1 : numbers[i]);
    if (const auto& middle = picture.middles[i]) {
      const auto [x, y] = *middle;
      ColouredPicture::Mark mark{x, y, name};
      const auto is_near = [&](const auto& other) { return collide(mark, other); };
      if (std::ranges::none_of(result.marks, is_near)) result.marks.push_back(std::move(mark));
    }
    result.legend.push_back(
        {colour_in_picture(colours[i]), std::move(name), grouped(points_of(i))});
  }
  if (listed < order.size()) {
    std::size_t others = 0;
    for (std::size_t k = listed; k < order.size(); ++k) others += points_of(order[k]);
    result.legend.push_back(
        {{}, fmt::format("and {} others", order.size() - listed), grouped(others)});
  }
  if (picture.points[0] > 0)
    result.legend.push_back({colour_in_picture({}), "none", grouped(picture.points[0])});
  result.description = fmt::format("Cloud: {} segments, {} points in none", order.size(),
                                   grouped(picture.points[0]));
  result.raster = std::move(picture.raster);
  return result;
}

}  // namespace ph::segment
