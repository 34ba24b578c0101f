// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "cubical/stars/grid_shape.hpp"
#include "cubical/stars/star_tables.hpp"
#include "ph/detail/image/cubical_image.hpp"

namespace ph::cubical {

/// A cell as the star that it is in sees it, with its value in the order of the stars.
struct StarCell {
  std::uint32_t voxel = 0;
  Direction direction{};
  double value = 0;
};

/// Divides by a number that is known beforehand (Lemire, Kaser, Kurz, Faster remainder by direct
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

/// Where the voxels of an image are, as GridShape counts its axes.
///
/// Both constructions are seen as one. The T-construction of f is the V-construction of -f turned
/// around: reversed in value, with all axes running backwards, a border of voxels that have always
/// been there around it, and dimension k in place of top - k; what has always been there is no cell
/// (homology relative to it).
class GridFrame {
 public:
  /// No more than about 2^31 voxels, and some.
  static bool can_hold(const CubicalImage& grid);
  /// Precondition: can_hold(grid).
  explicit GridFrame(const CubicalImage& grid);

  const GridShape& shape() const { return shape_; }
  int top_dim() const { return shape_.top_dim(); }  ///< of the stars' grid
  bool is_t_construction() const { return is_t_construction_; }
  std::uint32_t size() const { return size_; }  ///< voxels
  int axis_count() const { return shape_.axis_count(); }
  bool has_axis(int axis) const { return axes_[axis].exists; }
  bool is_periodic(int axis) const { return axes_[axis].periodic; }
  bool any_periodic() const { return any_periodic_; }
  /// Whether the voxels at a coordinate are the first ones of a periodic axis.
  bool is_wrapped(int axis, std::uint32_t x) const { return x == axes_[axis].wrapped; }
  std::uint32_t extent(int axis) const { return axes_[axis].extent; }
  std::uint32_t stride(int axis) const { return axes_[axis].stride; }
  /// Whether an axis has two ends.
  bool has_ends(int axis) const { return axes_[axis].has_ends; }
  /// How many do.
  int open_axes() const {
    return static_cast<int>(std::ranges::count(axes_, true, &Axis::has_ends));
  }
  /// The slowest axis. A layer is what lies at one place of it.
  int layer_axis() const { return shape_.layer_axis(); }
  std::uint32_t layer_size() const { return stride(layer_axis()); }

  /// The value in the order of the stars.
  double value(std::uint32_t v) const {
    return is_t_construction_ ? -grid_.value(size_ - 1 - v) : grid_.value(v);
  }
  // As PartStars has them: of a whole grid all voxels are here.
  static constexpr bool sees(std::uint64_t) { return true; }
  static constexpr bool sees_square(std::uint32_t, int) { return true; }
  static std::uint32_t here(std::uint64_t voxel) { return static_cast<std::uint32_t>(voxel); }
  static std::uint64_t in_whole(std::uint32_t v) { return v; }
  /// Where a voxel is in the input.
  std::uint32_t place(std::uint32_t v) const { return is_t_construction_ ? size_ - 1 - v : v; }
  std::uint32_t coordinate(std::uint32_t v, int axis) const {
    const Axis& a = axes_[axis];
    const std::uint32_t layer = a.by_stride.divide(v);
    return layer - a.by_extent.divide(layer) * a.extent;
  }
  /// The tables for a voxel's star.
  const StarTables& tables(std::uint32_t v) const {
    return any_periodic_ ? star_tables(wrapped(v)) : plain_tables_;
  }

  /// Voxels along the last axis.
  struct VoxelRow {
    std::uint32_t z, y, first;
    bool is_at_border;  ///< at an end of one of the other axes
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
  /// The same for a step along an edge of the star of v: without looking where v lies, if no step
  /// in such a direction leaves the grid.
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
    /// Whether the whole grid ends there.
    bool has_ends = false;
    /// Where the voxels are whose cells before them come last: the first ones of a periodic axis.
    std::uint32_t wrapped = UINT32_MAX;
  };
  /// Whether cells of a voxel at a coordinate are not as they are inside the grid.
  bool is_at_end(int a, std::uint32_t x) const {
    return axes_[a].exists && (x == 0 || x + 1 == axes_[a].extent || is_wrapped(a, x));
  }
  /// Of which periodic axes it is the first voxel, as bits.
  unsigned wrapped(std::uint32_t v) const {
    unsigned result = 0;
    for (int a = 0; a < 3; ++a)
      if (is_wrapped(a, coordinate(v, a))) result |= 1U << a;
    return result;
  }
  /// Takes note that this is a slab of a grid whose slowest axis is periodic. @param wrapped where
  /// the first layer of that grid is, if it is here.
  void be_part_of_ring(std::uint32_t wrapped);

  CubicalImage grid_;
  std::array<Axis, GridShape::kMostAxes> axes_;  // the last one is the fastest
  std::uint32_t size_ = 0;
  bool is_t_construction_ = false, any_periodic_ = false;

 private:
  GridShape shape_;
  const StarTables& plain_tables_ = star_tables(0);
};

}  // namespace ph::cubical
