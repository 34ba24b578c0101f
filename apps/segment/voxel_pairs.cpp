// SPDX-License-Identifier: MIT
#include "voxel_pairs.hpp"

#include <cmath>
#include <tuple>

namespace ph::segment {
namespace {

/// Walks through the rows of voxels that lie at one offset from those that ask. Who asks in the
/// order of the grid is answered in that order: a row is never looked for again.
struct RowCursor {
  double dy, dz;  // of the row, in voxels
  std::size_t at = 0;
};

auto by_row(const Vec3& cell) { return std::tuple(cell[2], cell[1], cell[0]); }

}  // namespace

std::vector<VoxelPair> close_voxels(const VoxelGrid& grid, double voxel, double radius) {
  const double reach = std::ceil(radius / voxel);
  std::vector<RowCursor> rows;  // those before a voxel's own, and its own
  for (double dz = -reach; dz <= 0; ++dz)
    for (double dy = -reach; dy <= (dz < 0 ? reach : 0); ++dy) {
      // Centroids of voxels k rows apart may be as near as k - 1.
      const double y = std::max(0.0, std::abs(dy) - 1), z = std::max(0.0, -dz - 1);
      if ((y * y + z * z) * voxel * voxel < radius * radius) rows.push_back({dy, dz});
    }
  std::vector<VoxelPair> pairs;
  for (std::uint32_t v = 0; v < grid.cells.size(); ++v) {
    const auto& [x, y, z] = grid.cells[v];
    for (RowCursor& row : rows) {
      const Vec3 first{x - reach, y + row.dy, z + row.dz}, last{x + reach, first[1], first[2]};
      while (by_row(grid.cells[row.at]) < by_row(first)) ++row.at;
      for (std::size_t u = row.at; u < v && by_row(grid.cells[u]) <= by_row(last); ++u) {
        const double distance =
            (grid.centroids.row(v) - grid.centroids.row(static_cast<Index>(u))).norm();
        if (distance < radius) pairs.push_back({static_cast<std::uint32_t>(u), v, distance});
      }
    }
  }
  return pairs;
}

}  // namespace ph::segment
