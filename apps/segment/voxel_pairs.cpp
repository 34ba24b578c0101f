// SPDX-License-Identifier: MIT
#include "voxel_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ph::segment {
namespace {

/// Voxels that differ in x alone, one after the other in the grid.
struct Row {
  double y, z;  // in voxels
  std::uint32_t begin, end;
};

std::vector<Row> rows_of(const VoxelGrid& grid) {
  std::vector<Row> rows;
  for (std::uint32_t v = 0; v < grid.cells.size(); ++v) {
    const auto& [x, y, z] = grid.cells[v];
    if (rows.empty() || rows.back().y != y || rows.back().z != z) rows.push_back({y, z, v, v});
    rows.back().end = v + 1;
  }
  return rows;
}

/// How far a row lies from the one that looks for pairs: before it, or itself. Rows look in the
/// order of the grid and meet those at one offset in that order: none is looked for again.
struct Offset {
  double y, z;
  double reach;          // how far along x a voxel of the other row can be near
  std::size_t next = 0;  // row
};

std::vector<Offset> offsets_within(double radius) {
  const double most = std::ceil(radius);
  // Centroids of voxels k rows apart may be as near as k - 1.
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

bool comes_before(const Row& row, double y, double z) { return row.z != z ? row.z < z : row.y < y; }

/// Pairs of a voxel of `row` and one of `other`, which is not behind it.
void add_pairs(const VoxelGrid& grid, const Row& row, const Row& other, double reach,
               double square_of_radius, VoxelPairs& pairs) {
  const auto x_of = [&](std::uint32_t v) { return grid.cells[v][0]; };
  std::uint32_t first = other.begin;
  for (std::uint32_t v = row.begin; v < row.end; ++v) {
    while (first < other.end && x_of(first) < x_of(v) - reach) ++first;
    const double* p = &grid.centroids(v, 0);
    for (std::uint32_t u = first; u < std::min(other.end, v) && x_of(u) <= x_of(v) + reach; ++u) {
      const double* q = &grid.centroids(u, 0);
      const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
      const double square = x * x + y * y + z * z;
      if (square < square_of_radius) pairs.push_back({u, v, std::sqrt(static_cast<float>(square))});
    }
  }
}

}  // namespace

VoxelPairs close_voxels(const VoxelGrid& grid, double voxel, double reach,
                        std::pmr::memory_resource* memory) {
  // Beyond, the row behind another one may be the same number: the search would not come to an end.
  require_exact_cells(grid, voxel);
  const std::vector<Row> rows = rows_of(grid);
  std::vector<Offset> offsets = offsets_within(reach);
  const double square_of_radius = std::pow(reach * voxel, 2);
  VoxelPairs pairs(memory);
  // Those of a flat surface, half of the disk around each voxel: growing would copy them all.
  const double disk = std::numbers::pi * reach * reach;
  pairs.reserve(static_cast<std::size_t>(disk / 2 * static_cast<double>(grid.cells.size())));
  for (const Row& row : rows) {
    for (Offset& offset : offsets) {
      const double y = row.y + offset.y, z = row.z + offset.z;
      while (offset.next < rows.size() && comes_before(rows[offset.next], y, z)) ++offset.next;
      if (offset.next == rows.size()) continue;
      const Row& other = rows[offset.next];
      if (other.y == y && other.z == z)
        add_pairs(grid, row, other, offset.reach, square_of_radius, pairs);
    }
  }
  return pairs;
}

}  // namespace ph::segment
