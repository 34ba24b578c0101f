// SPDX-License-Identifier: MIT
#include "libph/src/metric/cube_list.hpp"

#include "ph/detail/core/polled_sort.hpp"

namespace ph {

CubeList::CubeList(PointsView points, double radius, const RunContext& context)
    : cubes_(&context.memory), points_(&context.memory) {
  // The side of a cube is slightly larger than the radius. Otherwise rounding could put two points
  // within the radius of each other into cubes that are not adjacent. Coordinates in units of cubes
  // are at most 10^9 and therefore have an error of at most 3 * 10^-7. The errors of two points
  // together are less than the extra length of 10^-6. If the radius is 0, cubes of any size are
  // suitable, because equal points are always in the same cube.
  const double reach = largest_coordinate(points);
  const double edge = std::max(radius * (1 + 1e-6), 1e-9 * reach);
  const double scale = reach > 0 ? 1 / edge : 0;
  const auto size = static_cast<std::size_t>(points.rows());
  struct Placed {
    double x, y, z;  // coordinates of the cube
    std::uint32_t number;
    bool same_cube(const Placed& o) const { return x == o.x && y == o.y && z == o.z; }
  };
  std::pmr::vector<Placed> placed(size, &context.memory);
  const auto coordinate = [&](std::uint32_t i, Index k) {
    return k < points.cols() ? points(static_cast<Index>(i), k) : 0.0;
  };
  const auto cube = [&](double x) { return std::floor(x * scale) + 0.0; };
  for (std::uint32_t i = 0; i < size; ++i)
    placed[i] = {cube(coordinate(i, 0)), cube(coordinate(i, 1)), cube(coordinate(i, 2)), i};
  const auto before = [](const Placed& a, const Placed& b) {
    if (a.z != b.z) return a.z < b.z;
    if (a.y != b.y) return a.y < b.y;
    return a.x != b.x ? a.x < b.x : a.number < b.number;
  };
  Ticker ticker(context, "cubes", size);
  polled_sort(placed, before, ticker);
  points_.reserve(size);
  for (std::uint32_t at = 0; at < size; ++at) {
    const Placed& p = placed[at];
    if (at == 0 || !p.same_cube(placed[at - 1])) cubes_.push_back({p.x, p.y, p.z, at, at});
    points_.push_back(
        {coordinate(p.number, 0), coordinate(p.number, 1), coordinate(p.number, 2), p.number});
    cubes_.back().end = at + 1;
    ticker.tick();
  }
}

}  // namespace ph
