// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "ph/metric/metric.hpp"

namespace ph::segment {

/// The points of R^3 sorted into cubes a little larger than the reach, so that all neighbours of a
/// point lie in the 27 cubes around it. Coordinates of cubes are whole numbers kept as doubles:
/// they cannot overflow.
class CubeList {
 public:
  struct Cube {
    double x, y, z;
    std::uint32_t begin, end;  // range of the points in it
  };
  struct Point {
    double x, y, z;
    std::uint32_t number;
  };

  CubeList(const Points& points, double edge);

  const std::vector<Cube>& cubes() const { return cubes_; }  ///< by z, then y, then x
  std::span<const Point> points(const Cube& cube) const {
    return std::span(points_).subspan(cube.begin, cube.end - cube.begin);
  }

 private:
  std::vector<Cube> cubes_;
  std::vector<Point> points_;
};

/// Calls `visit(i, j, length)` once for each pair of points of R^3 at most `distance` apart, in an
/// order that depends on the points alone. O(points log points + pairs in adjacent cubes).
/// @param points one a row, finite. @param distance >= 0.
template <class Visit>
void for_each_near_pair(const Points& points, double distance, Visit&& visit) {
  const CubeList list(points, distance);
  const std::vector<CubeList::Cube>& cubes = list.cubes();
  const auto visit_if_near = [&](const CubeList::Point& p, const CubeList::Point& q) {
    const double dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z;
    const double square = dx * dx + dy * dy + dz * dz;
    if (const double length = std::sqrt(square); length <= distance) {
      visit(p.number, q.number, length);
    }
  };
  // Half of the neighbours: the next cube of the same row, and three cubes of each row after it.
  constexpr std::array<std::array<double, 2>, 4> rows_after = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  std::array<std::size_t, 4> first{};  // per row: cubes before this one lie behind for good
  for (std::size_t c = 0; c < cubes.size(); ++c) {
    const CubeList::Cube& cube = cubes[c];
    const auto here = list.points(cube);
    for (std::size_t i = 0; i < here.size(); ++i) {
      for (std::size_t j = i + 1; j < here.size(); ++j) visit_if_near(here[i], here[j]);
    }
    const auto visit_cube = [&](const CubeList::Cube& other) {
      for (const CubeList::Point& p : here) {
        for (const CubeList::Point& q : list.points(other)) visit_if_near(p, q);
      }
    };
    if (c + 1 < cubes.size()) {
      const CubeList::Cube& next = cubes[c + 1];
      if (next.z == cube.z && next.y == cube.y && next.x == cube.x + 1) visit_cube(next);
    }
    for (std::size_t r = 0; r < rows_after.size(); ++r) {
      const double y = cube.y + rows_after[r][0], z = cube.z + rows_after[r][1];
      std::size_t& at = first[r];
      while (at < cubes.size() &&
             std::tie(cubes[at].z, cubes[at].y, cubes[at].x) < std::tuple(z, y, cube.x - 1)) {
        ++at;
      }
      for (std::size_t k = at;
           k < cubes.size() && cubes[k].z == z && cubes[k].y == y && cubes[k].x <= cube.x + 1;
           ++k) {
        if (k != c) visit_cube(cubes[k]);
      }
    }
  }
}

}  // namespace ph::segment
