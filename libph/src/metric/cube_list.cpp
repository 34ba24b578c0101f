// SPDX-License-Identifier: MIT
#include "cube_list.hpp"

#include <algorithm>
#include <numeric>

namespace ph {

CubeList::CubeList(const Points& points, double radius) {
  // A hair larger than the radius: rounding must not put two points in reach two cubes apart. There
  // are 10^9 cubes an axis at most, so that a coordinate in cubes is off by 10^-7 at most: less than
  // the hair. With no radius at all, any cubes will do in which equal points meet.
  const double edge = std::max(radius * (1 + 1e-6),
                               points.size() == 0 ? 1.0 : 1e-9 * points.cwiseAbs().maxCoeff());
  const double scale = edge > 0 ? 1 / edge : 1;
  const auto size = static_cast<std::size_t>(points.rows());
  std::vector<Point> given(size);
  std::vector<Cube> cube_of(size);
  for (std::size_t i = 0; i < size; ++i) {
    std::array<double, 3> p{};
    for (Index k = 0; k < points.cols(); ++k)
      p[static_cast<std::size_t>(k)] = points(static_cast<Index>(i), k);
    given[i] = {p[0], p[1], p[2], static_cast<std::uint32_t>(i)};
    const auto cell = [&](double x) { return std::floor(x * scale) + 0.0; };
    cube_of[i] = {cell(p[0]), cell(p[1]), cell(p[2]), 0, 0};
  }
  std::vector<std::uint32_t> order(size);
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    return std::tie(cube_of[i].z, cube_of[i].y, cube_of[i].x);
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple_cat(key(a), std::tie(a)) < std::tuple_cat(key(b), std::tie(b));
  });
  points_.reserve(size);
  for (const std::uint32_t i : order) {
    const auto position = static_cast<std::uint32_t>(points_.size());
    if (points_.empty() || key(i) != key(order[position - 1]))
      cubes_.push_back({cube_of[i].x, cube_of[i].y, cube_of[i].z, position, position});
    points_.push_back(given[i]);
    cubes_.back().end = position + 1;
  }
}

}  // namespace ph
