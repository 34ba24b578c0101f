// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libsegment/src/plane/squares.hpp"
#include "ph/detail/core/flat_map.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The part of a plane in which a surface is seen, as squares, and what is near the surface there.
class Extent {
 public:
  /// @param side the side of a square, in metres.
  Extent(const Plane& plane, double side) : plane_(plane), squares_(plane, side), side_(side) {}

  /// Adds a point of the scene. @param margin the margin of the plane at this point, in metres.
  void add(const Eigen::Vector3d& p, double margin);

  /// The area of the squares in which the plane is seen, in square metres.
  double area() const { return static_cast<double>(seen_) * side_ * side_; }
  /// The area, in square metres, of the convex hull around the largest group of adjacent squares
  /// in which the plane is seen, but nothing that crosses it. Things on a table hide parts of it,
  /// but not its hull.
  double area_of_hull() const;
  /// True if the plane is a face of something: the surface goes on just behind the plane, where the
  /// plane is seen. Behind a large plane, the edge of a board does not count.
  bool goes_on_behind() const;
  /// As before, also next to the squares in which the plane is seen, as below the top of a box.
  bool goes_on_beside() const;
  /// True if something is in front of the plane while the plane is seen on all four sides of it.
  bool has_things_on_it() const;
  /// True if the plane is seen, and nothing crosses it, in the square of a point or next to it.
  bool is_over(const float* p) const;

 private:
  using Square = std::array<double, 2>;
  /// The numbers of points in a square.
  struct Count {
    Index on = 0, in_front = 0, behind = 0, deep = 0;
    /// True if the plane is seen, and nothing crosses it.
    bool is_clear() const { return on > 0 && on >= kLeastRatio * deep; }
  };
  /// Where the points behind a plane are fewer, they may be noise.
  static constexpr Index kLeastRatio = 4;

  static std::uint64_t key_of(const Square& square);
  const Count* find(const Square& square) const { return counts_.find(key_of(square)); }
  bool is_clear_near(const Square& square) const;
  std::vector<Square> largest_group() const;

  Plane plane_;
  Squares squares_;
  double side_;
  std::size_t seen_ = 0;     ///< the number of squares in which the plane is seen
  std::vector<Square> all_;  ///< in order of appearance
  FlatMap<Count> counts_{std::pmr::get_default_resource()};
};

}  // namespace ph::segment
