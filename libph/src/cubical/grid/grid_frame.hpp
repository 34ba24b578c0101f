// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "libph/src/cubical/grid/grid_shape.hpp"
#include "libph/src/cubical/grid/star_tables.hpp"
#include "ph/detail/image/cubical_image.hpp"

namespace ph::cubical {

/// A cell with its value in the order of the stars (GridFrame). It is given by the voxel whose star
/// contains it and by the direction from that voxel.
struct StarCell {
  std::uint32_t voxel = 0;
  Direction direction{};
  double value = 0;
};

/// Divides by a number that is known in advance (Lemire, Kaser, Kurz, Faster remainder by direct
/// computation, 2019).
class Divisor {
 public:
  Divisor() = default;
  explicit Divisor(std::uint32_t by) : factor_(by > 1 ? UINT64_MAX / by + 1 : 0) {}
  std::uint32_t divide(std::uint32_t a) const {
    __extension__ using Wide = unsigned __int128;
    return factor_ == 0 ? a : static_cast<std::uint32_t>((Wide{factor_} * a) >> 64);
  }

 private:
  std::uint64_t factor_ = 0;
};

/// The positions of the voxels of an image, with axes counted as in GridShape.
///
/// Both constructions are handled in the same way. The V-construction is used as it is. The
/// T-construction of f is treated as the V-construction of -f: values are negated, all axes run
/// backwards, a border of voxels that were always there surrounds the image, and dimension k
/// becomes top - k. The resulting grid and filtration are called the *stars' grid* and the *order
/// of the stars*. Voxels that were always there are not cells. Homology is relative to them.
class GridFrame {
 public:
  /// True if the image has at least one voxel and at most about 2^31, and at most
  /// GridShape::kMostAxes of its axes are kept.
  static bool can_hold(const CubicalImage& grid);
  /// Precondition: can_hold(grid).
  explicit GridFrame(const CubicalImage& grid);

  const GridShape& shape() const { return shape_; }
  int top_dim() const { return shape_.top_dim(); }  ///< top dimension of the stars' grid
  bool is_t_construction() const { return is_t_construction_; }
  std::uint32_t size() const { return size_; }  ///< number of voxels
  int axis_count() const { return shape_.axis_count(); }
  bool has_axis(int axis) const { return axes_[axis].exists; }
  bool is_periodic(int axis) const { return axes_[axis].periodic; }
  bool any_periodic() const { return any_periodic_; }
  /// True if `x` is the coordinate of the first voxels of a periodic axis.
  bool is_wrapped(int axis, std::uint32_t x) const { return x == axes_[axis].wrapped; }
  std::uint32_t extent(int axis) const { return axes_[axis].extent; }
  std::uint32_t stride(int axis) const { return axes_[axis].stride; }
  /// True if an axis has two ends.
  bool has_ends(int axis) const { return axes_[axis].has_ends; }
  /// The number of axes with two ends.
  int open_axes() const {
    return static_cast<int>(std::ranges::count(axes_, true, &Axis::has_ends));
  }
  /// The slowest axis. A layer is the set of voxels at one position along this axis.
  int layer_axis() const { return shape_.layer_axis(); }
  std::uint32_t layer_size() const { return stride(layer_axis()); }

  /// The value of a voxel in the order of the stars: negated in the T-construction.
  double value(std::uint32_t v) const {
    return is_t_construction_ ? -grid_.value(size_ - 1 - v) : grid_.value(v);
  }
  // These functions have the same meaning as in PartStars. The frame of an entire grid sees all
  // voxels.
  static constexpr bool sees(std::uint64_t) { return true; }
  static constexpr bool sees_square(std::uint32_t, int) { return true; }
  static std::uint32_t here(std::uint64_t voxel) { return static_cast<std::uint32_t>(voxel); }
  static std::uint64_t in_whole(std::uint32_t v) { return v; }
  /// The position of a voxel in the input.
  std::uint32_t place(std::uint32_t v) const { return is_t_construction_ ? size_ - 1 - v : v; }
  std::uint32_t coordinate(std::uint32_t v, int axis) const {
    const Axis& a = axes_[axis];
    const std::uint32_t layer = a.by_stride.divide(v);
    return layer - a.by_extent.divide(layer) * a.extent;
  }
  /// The tables for the star of a voxel.
  const StarTables& tables(std::uint32_t v) const {
    return any_periodic_ ? star_tables(wrapped(v)) : plain_tables_;
  }

  /// A row of voxels along the last axis.
  struct VoxelRow {
    std::uint32_t z, y, first;
    bool is_at_border;  ///< true at an end of one of the other axes
  };
  std::uint32_t row_count() const { return size_ / extent(2); }
  VoxelRow row(std::uint32_t number) const {
    const std::uint32_t z = number / extent(1), y = number % extent(1);
    return {z, y, number * extent(2), is_at_end(0, z) || is_at_end(1, y)};
  }
  static constexpr std::uint32_t kOutside = UINT32_MAX;
  /// The voxel one step away, or kOutside.
  std::uint32_t step(std::uint32_t v, int axis, int sign) const {
    const Axis& a = axes_[axis];
    const std::uint32_t x = coordinate(v, axis);
    if (sign > 0) {
      if (x + 1 < a.extent) return v + a.stride;
      return a.periodic ? v - x * a.stride : kOutside;
    }
    if (x > 0) return v - a.stride;
    return a.periodic ? v + (a.extent - 1) * a.stride : kOutside;
  }
  /// The voxel at the other end of an edge in the star of v, or kOutside. If no step in that
  /// direction can leave the grid, the position of v is not checked.
  std::uint32_t step_in_star(std::uint32_t v, int edge) const {
    const int axis = axis_of_edge(edge), sign = kEdges[edge][axis];
    if (is_t_construction_ || any_periodic_) return step(v, axis, sign);
    return sign > 0 ? v + axes_[axis].stride : v - axes_[axis].stride;
  }

 protected:
  struct Axis {
    std::uint32_t extent = 1, stride = 1;
    bool exists = false, periodic = false;
    Divisor by_extent, by_stride;
    /// True if the entire grid has two ends along this axis.
    bool has_ends = false;
    /// The coordinate of the first voxels of a periodic axis. The cells before these voxels come
    /// last in the grid.
    std::uint32_t wrapped = UINT32_MAX;
  };
  /// True if the cells of a voxel at this coordinate are arranged differently from the cells of
  /// voxels inside the grid.
  bool is_at_end(int a, std::uint32_t x) const {
    return axes_[a].exists && (x == 0 || x + 1 == axes_[a].extent || is_wrapped(a, x));
  }
  /// A bit for each periodic axis along which v is the first voxel.
  unsigned wrapped(std::uint32_t v) const {
    unsigned result = 0;
    for (int a = 0; a < 3; ++a)
      if (is_wrapped(a, coordinate(v, a))) result |= 1U << a;
    return result;
  }
  /// Makes this frame a slab of a grid whose slowest axis is periodic. @param wrapped the position
  /// in this slab of the first layer of the grid, if the slab has that layer.
  void be_part_of_ring(std::uint32_t wrapped);

  CubicalImage grid_;
  std::array<Axis, GridShape::kMostAxes> axes_;  // the last axis is the fastest
  std::uint32_t size_ = 0;
  bool is_t_construction_ = false, any_periodic_ = false;

 private:
  GridShape shape_;
  const StarTables& plain_tables_ = star_tables(0);
};

}  // namespace ph::cubical
