// SPDX-License-Identifier: MIT
#include "libsegment/src/voxels/base_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ph::segment {
namespace {

/// A table at z = 1, seen from the origin. Its squares are axis-aligned, because Eigen's
/// unitOrthogonal of (0, 0, -1) is an axis.
constexpr Plane kTable{{0, 0, -1}, 1, 1};

/// Walls, and a strip of table points. The function assign_base_points adds points of the strip to
/// voxels of the walls.
struct Bases {
  std::vector<float> xyz;
  std::vector<Index> walls, strip;

  void add(std::vector<Index>& to, double x, double y, double height) {
    to.push_back(static_cast<Index>(xyz.size() / 3));
    for (const double c : {x, y, 1 - height}) xyz.push_back(static_cast<float>(c));
  }
  /// For each point of the strip, the wall to whose voxel it is added, or -1.
  /// @param side the side of a square.
  std::vector<Index> assigned(double side) const {
    std::vector<Index> points = walls;
    VoxelGrid grid;
    for (std::size_t k = 0; k < walls.size(); ++k)  // one voxel per wall
      grid.voxel_of.push_back(static_cast<std::uint32_t>(k));
    assign_base_points({xyz, {}}, strip, kTable, {0.005, 0}, side, points, grid);
    std::vector<Index> of(strip.size(), -1);
    for (std::size_t k = walls.size(); k < points.size(); ++k)
      of[static_cast<std::size_t>(std::ranges::find(strip, points[k]) - strip.begin())] =
          grid.voxel_of[k];
    return of;
  }
};

TEST(AssignBasePoints, EachSquareAroundTheOriginHasWallsOfItsOwn) {
  const double side = 0.01;
  for (int wall_x = -3; wall_x < 3; ++wall_x) {
    for (int wall_y = -3; wall_y < 3; ++wall_y) {
      Bases bases;
      bases.add(bases.walls, (wall_x + 0.5) * side, (wall_y + 0.5) * side, 0.01);
      std::vector<Index> expected;
      for (int x = -3; x < 3; ++x) {
        for (int y = -3; y < 3; ++y) {
          bases.add(bases.strip, (x + 0.3) * side, (y + 0.6) * side, 0.003);
          expected.push_back(x == wall_x && y == wall_y ? 0 : -1);
        }
      }
      EXPECT_EQ(bases.assigned(side), expected) << wall_x << ' ' << wall_y;
    }
  }
}

TEST(AssignBasePoints, AWallOnEverySquare) {
  const double side = 0.01;
  Bases bases;
  std::vector<Index> expected;
  for (int x = -20; x < 20; ++x) {
    for (int y = -20; y < 20; ++y) {
      expected.push_back(static_cast<Index>(bases.walls.size()));
      bases.add(bases.walls, (x + 0.5) * side, (y + 0.5) * side, 0.01);
      bases.add(bases.strip, (x + 0.3) * side, (y + 0.6) * side, 0.003);
    }
  }
  EXPECT_EQ(bases.assigned(side), expected);
}

TEST(AssignBasePoints, SquaresFarFromTheOriginAreNotTakenForOneAnother) {
  // If the sides are 2^-33 … 2^-20, coordinates are 2^20 … 2^37 squares, with either sign.
  for (int log = -33; log <= -20; ++log) {
    const double side = std::ldexp(1, log);
    for (const double sign : {-1.0, 1.0}) {
      Bases bases;
      for (const double x : {1.0, 2.0, 4.0, 16.0}) {
        bases.add(bases.walls, sign * x, sign * x, 0.005 + side);
        bases.add(bases.strip, sign * x, sign * x, 0.003);
        bases.add(bases.strip, sign * x * 1.5, sign * x * 1.5, 0.003);
      }
      EXPECT_EQ(bases.assigned(side), (std::vector<Index>{0, -1, 1, -1, 2, -1, 3, -1})) << log;
    }
  }
}

}  // namespace
}  // namespace ph::segment
