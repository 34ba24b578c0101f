// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <tuple>
#include <vector>

#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The points of R^1, R^2 or R^3, sorted into cubes whose side is slightly larger than a radius.
/// All neighbours of a point within the radius are in its own cube or in the 26 adjacent cubes.
/// Coordinates of cubes are integers stored as doubles, which cannot overflow. This class exists in
/// addition to the k-d tree because a search with the tree takes 1.1 to 1.8 times as long
/// (docs/development/adr/0020).
class CubeList {
 public:
  struct Point {
    double x, y, z;
    std::uint32_t number;
  };

  /// Takes O(points log points) time.
  CubeList(PointsView points, double radius, const RunContext& context);

  /// Calls `visit(p, q)` for each pair of points in the same or in adjacent cubes. The order of the
  /// pairs depends only on the points. Let s be the number of points plus the number of pairs
  /// within the radius. The number of visits is at most a constant times s.
  template <class Visit>
  void for_each_candidate_pair(Visit&& visit, const RunContext& context) const;

 private:
  struct Cube {
    double x, y, z;
    std::uint32_t begin, end;  // range of points_
  };
  std::span<const Point> points(const Cube& cube) const {
    return std::span(points_).subspan(cube.begin, cube.end - cube.begin);
  }

  std::pmr::vector<Cube> cubes_;  // sorted by z, then y, then x
  std::pmr::vector<Point> points_;
};

template <class Visit>
void CubeList::for_each_candidate_pair(Visit&& visit, const RunContext& context) const {
  Ticker ticker(context, "near pairs", cubes_.size());
  // Each pair of adjacent cubes is visited once. A cube therefore visits half of its 26 neighbours,
  // which are the next cube of the same row, and three cubes in each of the rows listed here.
  constexpr std::array<std::array<double, 2>, 4> rows_after = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  std::array<std::size_t, 4> first{};  // for each row: the first cube that may still be adjacent
  for (std::size_t c = 0; c < cubes_.size(); ++c) {
    const Cube& cube = cubes_[c];
    const auto here = points(cube);
    for (std::size_t i = 0; i < here.size(); ++i) {
      for (std::size_t j = i + 1; j < here.size(); ++j) visit(here[i], here[j]);
      ticker.work(here.size() - i);
    }
    const auto visit_cube = [&](const Cube& other) {
      for (const Point& p : here) {
        for (const Point& q : points(other)) visit(p, q);
        ticker.work(other.end - other.begin);
      }
    };
    if (c + 1 < cubes_.size()) {
      const Cube& next = cubes_[c + 1];
      if (next.z == cube.z && next.y == cube.y && next.x == cube.x + 1) visit_cube(next);
    }
    for (std::size_t r = 0; r < rows_after.size(); ++r) {
      const double y = cube.y + rows_after[r][0], z = cube.z + rows_after[r][1];
      std::size_t& at = first[r];
      while (at < cubes_.size() &&
             std::tie(cubes_[at].z, cubes_[at].y, cubes_[at].x) < std::tuple(z, y, cube.x - 1)) {
        ++at;
      }
      for (std::size_t k = at;
           k < cubes_.size() && cubes_[k].z == z && cubes_[k].y == y && cubes_[k].x <= cube.x + 1;
           ++k) {
        if (k != c) visit_cube(cubes_[k]);
      }
    }
    ticker.tick();
  }
}

}  // namespace ph
