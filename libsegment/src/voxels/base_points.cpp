// SPDX-License-Identifier: MIT
#include "libsegment/src/voxels/base_points.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory_resource>

#include "ph/detail/core/flat_map.hpp"

namespace ph::segment {
namespace {

/// The plane divided into squares. The coordinates of a square may be any whole numbers, and no two
/// squares may have the same name, even if they are far apart. Columns and rows are therefore
/// numbered in order of appearance.
class Squares {
 public:
  Squares(const Plane& plane, double side)
      : first_(Eigen::Vector3d(plane.normal[0], plane.normal[1], plane.normal[2]).unitOrthogonal() /
               side),
        second_(Eigen::Vector3d(plane.normal[0], plane.normal[1], plane.normal[2]).cross(first_)) {}

  /// The name of the square below a point.
  std::uint64_t operator()(const float* p) {
    const Eigen::Vector3d x(p[0], p[1], p[2]);
    return std::uint64_t{columns_(first_.dot(x))} << 32 | rows_(second_.dot(x));
  }

 private:
  class Numbers {
   public:
    std::uint32_t operator()(double units) {
      // Adding zero gives -0 and +0 the same bits.
      const auto bits = std::bit_cast<std::uint64_t>(std::floor(units) + 0.0);
      const auto [number, is_new] = numbers_.try_emplace(bits);
      if (is_new) *number = count_++;
      return *number;
    }

   private:
    FlatMap<std::uint32_t> numbers_{std::pmr::get_default_resource()};
    std::uint32_t count_ = 0;  // at most the number of points, which is below 2^32
  };

  Eigen::Vector3d first_, second_;
  Numbers columns_, rows_;
};

/// The lowest point over a square of the plane, and its voxel.
struct Wall {
  double height = kInfinity;
  std::uint32_t voxel = 0;
};

}  // namespace

void assign_base_points(const CloudView& cloud, const std::vector<Index>& strip, const Plane& plane,
                        const PlaneMargin& margin, double side, std::vector<Index>& points,
                        VoxelGrid& grid) {
  // The distance beyond the margin at which a wall may begin, in squares.
  constexpr double squares_up = 2;
  const auto point = [&](Index i) { return cloud.point(static_cast<std::size_t>(i)); };
  Squares square(plane, side);
  FlatMap<Wall> walls(std::pmr::get_default_resource());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const float* p = point(points[k]);
    const double height = plane.signed_distance(p[0], p[1], p[2]);
    if (height < 0 || height > margin(cloud, p) + squares_up * side) continue;
    Wall& wall = *walls.try_emplace(square(p)).first;
    if (height < wall.height || (height == wall.height && grid.voxel_of[k] < wall.voxel))
      wall = {height, grid.voxel_of[k]};
  }
  for (const Index i : strip) {
    const Wall* wall = walls.find(square(point(i)));
    if (wall == nullptr) continue;
    points.push_back(i);
    grid.voxel_of.push_back(wall->voxel);
  }
}

}  // namespace ph::segment
