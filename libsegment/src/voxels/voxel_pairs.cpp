// SPDX-License-Identifier: MIT
#include "libsegment/src/voxels/voxel_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ph::segment {
namespace {

/// Consecutive voxels of the grid that differ only in x.
struct VoxelRow {
  double y, z;  // in voxels
  std::uint32_t begin, end;
};

std::vector<VoxelRow> rows_of(const VoxelGrid& grid) {
  std::vector<VoxelRow> rows;
  for (std::uint32_t v = 0; v < grid.cells.size(); ++v) {
    const auto& [x, y, z] = grid.cells[v];
    if (rows.empty() || rows.back().y != y || rows.back().z != z) rows.push_back({y, z, v, v});
    rows.back().end = v + 1;
  }
  return rows;
}

/// The offset of a row from the row that searches for pairs. The offset leads to an earlier row or
/// to the row itself. The rows search in the order of the grid, and at each offset they meet the
/// other rows in the same order. It is therefore enough to move `next` forward.
struct Offset {
  double y, z;
  // The distance along x up to which a voxel of the other row can be near.
  double reach;
  std::size_t next = 0;  // the index of the next row at this offset
};

std::vector<Offset> offsets_within(double radius) {
  const double most = std::ceil(radius);
  // If two voxels are k rows apart, the distance of their centroids may be as small as k - 1.
  const auto square_of_gap = [&](double k) { return std::pow(std::max(0.0, std::abs(k) - 1), 2); };
  std::vector<Offset> offsets;
  for (double z = -most; z <= 0; ++z) {
    for (double y = -most; y <= (z < 0 ? most : 0); ++y) {
      double reach = most;
      while (reach >= 0 &&
             square_of_gap(reach) + square_of_gap(y) + square_of_gap(z) >= radius * radius)
        --reach;
      if (reach >= 0) offsets.push_back({y, z, reach});
    }
  }
  return offsets;
}

bool comes_before(const VoxelRow& row, double y, double z) {
  return row.z != z ? row.z < z : row.y < y;
}

/// The data of a voxel that the search reads, stored together.
struct Place {
  double x, y, z;  // the centroid
  double cell;     // the voxel's coordinate along x, in voxels
};

std::vector<Place> places_of(const VoxelGrid& grid) {
  std::vector<Place> places;
  places.reserve(grid.cells.size());
  for (Index v = 0; v < grid.centroids.rows(); ++v)
    places.push_back({grid.centroids(v, 0), grid.centroids(v, 1), grid.centroids(v, 2),
                      grid.cells[static_cast<std::size_t>(v)][0]});
  return places;
}

/// Finds the pairs of a voxel of `row` and a voxel of `other`, and writes them to `to`.
/// Preconditions: `other` does not come after `row`, and there is room for all pairs within reach
/// and one more.
/// @return the end of the pairs.
VoxelPair* write_pairs(const std::vector<Place>& places, const VoxelRow& row, const VoxelRow& other,
                       double reach, double square_of_radius, VoxelPair* to) {
  std::uint32_t first = other.begin;
  for (std::uint32_t v = row.begin; v < row.end; ++v) {
    const Place p = places[v];
    while (first < other.end && places[first].cell < p.cell - reach) ++first;
    if (first == other.end) break;
    const std::uint32_t end = std::min(other.end, v);
    for (std::uint32_t u = first; u < end && places[u].cell <= p.cell + reach; ++u) {
      const Place& q = places[u];
      const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
      const double square = x * x + y * y + z * z;
      // This avoids a branch, which would be unpredictable. The pair is always written, but the end
      // advances only if the pair is near.
      *to = {u, v, std::sqrt(static_cast<float>(square))};
      to += square < square_of_radius ? 1 : 0;
    }
  }
  return to;
}

}  // namespace

VoxelPairs close_voxels(const VoxelGrid& grid, double voxel, double reach,
                        const RunContext& context) {
  // Larger coordinates could give a row and the next row the same number, and the search would not
  // end.
  require_exact_cells(grid, voxel);
  const std::vector<VoxelRow> rows = rows_of(grid);
  const std::vector<Place> places = places_of(grid);
  std::vector<Offset> offsets = offsets_within(reach);
  const double square_of_radius = std::pow(reach * voxel, 2);
  VoxelPairs pairs(&context.memory);
  // On a flat surface, each voxel forms pairs with half of the disk around it. A third more is
  // reserved for curved surfaces. Growing the list would copy all pairs and use three times the
  // memory.
  const double disk = 4.0 / 3 * std::numbers::pi * reach * reach;
  pairs.reserve(static_cast<std::size_t>(disk / 2 * static_cast<double>(grid.cells.size())));
  const auto most_of_voxel = static_cast<std::size_t>(2 * std::ceil(reach) + 1);
  Ticker ticker(context, "neighbours", rows.size());
  for (const VoxelRow& row : rows) {
    ticker.tick();
    for (Offset& offset : offsets) {
      const double y = row.y + offset.y, z = row.z + offset.z;
      while (offset.next < rows.size() && comes_before(rows[offset.next], y, z)) ++offset.next;
      if (offset.next == rows.size()) continue;
      const VoxelRow& other = rows[offset.next];
      if (other.y != y || other.z != z) continue;
      const std::size_t size = pairs.size();
      pairs.resize(size + most_of_voxel * (row.end - row.begin) + 1);
      const VoxelPair* const end =
          write_pairs(places, row, other, offset.reach, square_of_radius, pairs.data() + size);
      pairs.resize(static_cast<std::size_t>(end - pairs.data()));
    }
  }
  return pairs;
}

}  // namespace ph::segment
