// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/image/cubical_image.hpp"

namespace ph::cubical {

/// The axes of an image of any size in the stars' grid (GridFrame). Axes with one voxel are left
/// out. `PairSink` adds the bars that are missing because a periodic axis is left out. If at most
/// three axes are left, they count as the last of three axes. Directions in stars therefore have
/// the same numbers for one, two and three axes.
class GridShape {
 public:
  static constexpr int kMostAxes = 8;
  struct Axis {
    std::uint64_t extent = 1, stride = 1;
    bool exists = false, periodic = false;
    int of_input = 0;
  };

  /// True if an axis of the input is kept.
  static bool keeps_axis(const CubicalImage& image, std::size_t k) {
    return image.extents[k] > 1 || (!image.voxels_are_vertices && !image.periodic[k]);
  }
  /// The number of axes that are kept.
  static int count_axes(const CubicalImage& image);
  /// Precondition: count_axes(image) <= kMostAxes. Voxels are not read.
  explicit GridShape(const CubicalImage& image);

  int top_dim() const { return top_dim_; }  ///< top dimension of the stars' grid
  bool is_t_construction() const { return is_t_construction_; }
  /// The number of axes, counted as at least three.
  int axis_count() const { return std::max(top_dim_, 3); }
  /// The last axis is the fastest.
  const Axis& axis(int a) const { return axes_[static_cast<std::size_t>(a)]; }
  bool any_periodic() const { return std::ranges::any_of(axes_, &Axis::periodic); }
  /// The number of axes with two ends.
  int open_axes() const {
    return static_cast<int>(
        std::ranges::count_if(axes_, [](const Axis& a) { return a.exists && !a.periodic; }));
  }
  /// The slowest axis. A layer is the set of voxels at one position along this axis.
  int layer_axis() const { return axis_count() - top_dim_; }
  /// A bit for each periodic axis along which this is the first voxel; see StarTables.
  unsigned wrapped(std::uint64_t voxel) const {
    unsigned result = 0;
    for (std::size_t a = 0; a < axes_.size(); ++a)
      if (axes_[a].periodic && voxel / axes_[a].stride % axes_[a].extent == 0) result |= 1U << a;
    return result;
  }
  /// The number of periodic axes with one voxel. For each such axis, every cell has a copy one
  /// dimension higher that goes around the axis.
  std::size_t loop_count() const { return loops_.size(); }
  /// The number that the i-th periodic axis with one voxel has in the input; these numbers descend.
  std::size_t loop_axis(std::size_t i) const { return loops_[i]; }
  /// Appends the coordinates of a cell in the input's doubled grid. @param loops the periodic axes
  /// with one voxel that the copy of the cell goes around, as bits; 0 for the cell itself.
  /// @param direction the direction from the voxel to the cell, by axis; 0 along axes that are left
  /// out.
  void append_numbers(std::uint64_t voxel, std::span<const int> direction, unsigned loops,
                      std::vector<Index>& numbers) const;

 private:
  std::array<Axis, kMostAxes> axes_;
  std::vector<std::size_t> loops_;
  std::size_t input_axes_;
  int top_dim_ = 0;
  bool is_t_construction_;
};

}  // namespace ph::cubical
