// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment {

/// The voxels as the sensor saw them. The view is a raster of directions with cells of about one
/// voxel, and with the nearest voxel in each cell. If there would be more than 1024 rows or columns,
/// the cells are larger. Voxels more than 78 degrees from the middle are left out.
class View {
 public:
  using Voxel = std::uint32_t;
  static constexpr Voxel kNone = UINT32_MAX;

  View(const Points& centroids, double voxel, const Vec3& viewpoint);

  /// True if a nearer voxel of another kind lies within two cells of a voxel.
  /// @param nearer the least difference in range that counts, metres. @param kind_of returns the
  /// kind of a voxel.
  template <class KindOf>
  bool is_at_occluder(Voxel v, double nearer, KindOf&& kind_of) const;
  /// The numbers of cells along the straight line between two voxels. Cells whose nearest voxel is
  /// of the same kind as one of the ends are ignored. `cells` counts all other cells, and `hidden`
  /// counts those of them with something nearer than the line.
  struct Cover {
    int hidden = 0, cells = 0;
  };
  template <class KindOf>
  Cover cover(Voxel a, Voxel b, double nearer, KindOf&& kind_of) const;

 private:
  static constexpr int kReach = 2;

  struct Place {
    double x, y;  // in cells
  };
  bool has(Voxel v) const { return places_[v].x >= 0; }
  std::size_t cell(double x, double y) const {
    return static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  }
  Voxel nearest(double x, double y) const { return nearest_[cell(x, y)]; }
  /// The cells within kReach of a cell, in a row or a column.
  struct Window {
    std::size_t begin, end;
  };
  static Window window(std::size_t at, std::size_t size) {
    constexpr auto reach = static_cast<std::size_t>(kReach);
    return {at - std::min(at, reach), std::min(size, at + reach + 1)};
  }
  void find_least_ranges();

  std::vector<double> ranges_;  // from the viewpoint, metres
  std::vector<Place> places_;   // negative for a voxel that is left out
  std::size_t width_ = 0, height_ = 0;
  std::vector<Voxel> nearest_;
  // For each cell, the range of its nearest voxel, or kInfinity if it has no voxel.
  std::vector<double> nearest_range_;
  // For each cell, the least range of the voxels within kReach cells.
  std::vector<double> least_range_;
};

template <class KindOf>
bool View::is_at_occluder(Voxel v, double nearer, KindOf&& kind_of) const {
  if (!has(v)) return false;
  const Place& p = places_[v];
  if (!(least_range_[cell(p.x, p.y)] + nearer < ranges_[v])) return false;
  const Window columns = window(static_cast<std::size_t>(p.x), width_);
  const Window rows = window(static_cast<std::size_t>(p.y), height_);
  for (std::size_t y = rows.begin; y < rows.end; ++y)
    for (std::size_t i = y * width_ + columns.begin; i < y * width_ + columns.end; ++i)
      if (nearest_range_[i] + nearer < ranges_[v] && kind_of(nearest_[i]) != kind_of(v))
        return true;
  return false;
}

template <class KindOf>
auto View::cover(Voxel a, Voxel b, double nearer, KindOf&& kind_of) const -> Cover {
  Cover cover;
  if (!has(a) || !has(b)) return cover;
  const Place &p = places_[a], &q = places_[b];
  const double steps = std::ceil(std::max(std::abs(q.x - p.x), std::abs(q.y - p.y)));
  for (double step = 1; step < steps; ++step) {
    const double t = step / steps;
    const Voxel between = nearest(p.x + t * (q.x - p.x), p.y + t * (q.y - p.y));
    if (between != kNone && (kind_of(between) == kind_of(a) || kind_of(between) == kind_of(b)))
      continue;
    const double line = ranges_[a] + t * (ranges_[b] - ranges_[a]);
    cover.hidden += static_cast<int>(between != kNone && ranges_[between] + nearer < line);
    ++cover.cells;
  }
  return cover;
}

}  // namespace ph::segment
