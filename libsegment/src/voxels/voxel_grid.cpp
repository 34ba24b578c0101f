// SPDX-License-Identifier: MIT
#include "libsegment/src/voxels/voxel_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

#include "ph/detail/core/radix_sort.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

// Offsets inside a voxel are counted in units of voxel * 2^-32, which are two picometres in a voxel
// of one centimetre. The sum of two billion offsets still fits into 63 bits.
constexpr double kUnits = 4294967296.0;

/// One occupied voxel. Grid coordinates are whole numbers stored as doubles, which cannot overflow.
struct Voxel {
  double x, y, z;
  std::int64_t sum_x = 0, sum_y = 0, sum_z = 0;
  Index count = 0;
  /// Compares the bits of all three coordinates at once, which works because no zero is negative. A
  /// branch for each coordinate would be unpredictable.
  bool is_at(double cx, double cy, double cz) const {
    const auto difference = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b);
    };
    return (difference(x, cx) | difference(y, cy) | difference(z, cz)) == 0;
  }
};

/// A hash table with open addressing and linear probing. Its load stays below a quarter, because
/// the branch at the second probe is unpredictable. A FlatMap would also store the key, which is
/// three doubles that the voxel already has. A slot of this table takes 4 bytes.
class VoxelTable {
 public:
  VoxelTable() : slots_(kFirstCapacity, kEmpty) {}

  /// The number of the voxel, in the order of first appearance.
  std::uint32_t at(double x, double y, double z) {
    std::size_t slot = slot_of(x, y, z);
    for (; slots_[slot] != kEmpty; slot = next(slot)) {
      if (voxels_[slots_[slot]].is_at(x, y, z)) return slots_[slot];
    }
    if (voxels_.size() >= kEmpty) throw Error(ErrorKind::resource, "more than 2^32 - 1 voxels");
    const auto number = static_cast<std::uint32_t>(voxels_.size());
    voxels_.push_back({x, y, z});
    slots_[slot] = number;
    if (kSlotsAVoxel * voxels_.size() > slots_.size()) grow();
    return number;
  }
  Voxel& operator[](std::uint32_t number) { return voxels_[number]; }
  const std::vector<Voxel>& voxels() const { return voxels_; }

 private:
  static constexpr std::uint32_t kEmpty = UINT32_MAX;
  static constexpr std::size_t kFirstCapacity = 1 << 16;
  static constexpr std::size_t kSlotsAVoxel = 4;  // at least

  std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  std::size_t slot_of(double x, double y, double z) const {
    std::uint64_t h = std::bit_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL;
    h = (std::rotl(h, 29) ^ std::bit_cast<std::uint64_t>(y)) * 0xbf58476d1ce4e5b9ULL;
    h = (std::rotl(h, 29) ^ std::bit_cast<std::uint64_t>(z)) * 0x94d049bb133111ebULL;
    return static_cast<std::size_t>((h ^ (h >> 32)) & (slots_.size() - 1));
  }
  void grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (std::uint32_t number = 0; number < voxels_.size(); ++number) {
      const Voxel& v = voxels_[number];
      std::size_t slot = slot_of(v.x, v.y, v.z);
      while (slots_[slot] != kEmpty) slot = next(slot);
      slots_[slot] = number;
    }
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Voxel> voxels_;
};

/// The grid coordinate of a number in units of voxels. Adding zero gives -0 and +0 the same bits.
double cell_of(double units) {
  constexpr double huge = 1ULL << 52;  // doubles of at least this size have no fraction
  if (!(std::abs(units) < huge)) return std::floor(units) + 0.0;
  // Calling floor for each coordinate would take a third of the time for the grid.
  const auto whole = static_cast<double>(static_cast<std::int64_t>(units));
  return (whole > units ? whole - 1 : whole) + 0.0;
}

bool comes_before(const Voxel& a, const Voxel& b) {
  return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
}

/// The numbers of the voxels in grid order.
std::vector<std::uint32_t> in_order_of_grid(const std::vector<Voxel>& voxels) {
  std::vector<std::uint32_t> order(voxels.size());
  std::iota(order.begin(), order.end(), 0U);
  if (voxels.empty()) return order;
  std::array<double, 3> low, size;
  std::size_t axis = 0;
  for (const auto member : {&Voxel::x, &Voxel::y, &Voxel::z}) {
    const auto [least, most] = std::ranges::minmax(voxels, {}, member);
    low[axis] = least.*member;
    size[axis++] = most.*member - least.*member + 1;
  }
  // The cells of the box around all voxels are numbered. When 2^52 is added to a number, the last
  // bits of the double are this number, as the radix sort requires.
  constexpr double whole = 1ULL << 52;
  if (size[0] * size[1] * size[2] < whole) {
    std::vector<double> place;
    place.reserve(voxels.size());
    for (const Voxel& v : voxels)
      place.push_back(((v.z - low[2]) * size[1] + (v.y - low[1])) * size[0] + (v.x - low[0]) +
                      whole);
    radix_sort_by_value(order, [&](std::uint32_t i) { return place[i]; });
  } else {
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      return comes_before(voxels[a], voxels[b]);
    });
  }
  return order;
}

/// An offset inside a voxel, 0 <= units <= 1, as a whole number. Fractions of a unit are dropped.
std::int64_t fixed_point(double units) { return static_cast<std::int64_t>(units * kUnits); }

/// The position of a point, which consists of its cell and the offset inside the cell.
struct Located {
  double cx, cy, cz;
  double x, y, z;  // from 0 to 1
};

Located locate(const float* p, double voxel) {
  const double x = p[0] / voxel, y = p[1] / voxel, z = p[2] / voxel;
  const double cx = cell_of(x), cy = cell_of(y), cz = cell_of(z);
  return {cx, cy, cz, x - cx, y - cy, z - cz};
}

}  // namespace

VoxelGrid voxel_grid(const CloudView& cloud, const std::vector<Index>& points, double voxel) {
  VoxelGrid grid;
  grid.voxel_of.resize(points.size());
  VoxelTable table;
  std::uint32_t number = 0;  // neighbours in the list are often neighbours in space
  // The loop works in batches. The cells of the next points are computed while the unpredictable
  // lookup of the last point is still unresolved.
  std::array<Located, 64> located;
  for (std::size_t first = 0; first < points.size(); first += located.size()) {
    const std::size_t count = std::min(located.size(), points.size() - first);
    for (std::size_t k = 0; k < count; ++k)
      located[k] = locate(cloud.point(static_cast<std::size_t>(points[first + k])), voxel);
    for (std::size_t k = 0; k < count; ++k) {
      const Located& p = located[k];
      if (first + k == 0 || !table[number].is_at(p.cx, p.cy, p.cz)) {
        if (!std::isfinite(p.cx + p.cy + p.cz)) {
          const float* const at = cloud.point(static_cast<std::size_t>(points[first + k]));
          throw Error(ErrorKind::usage,
                      fmt::format("a voxel of {} is too small for point {} at ({}, {}, {})", voxel,
                                  points[first + k], at[0], at[1], at[2]));
        }
        number = table.at(p.cx, p.cy, p.cz);
      }
      Voxel& v = table[number];
      v.sum_x += fixed_point(p.x);
      v.sum_y += fixed_point(p.y);
      v.sum_z += fixed_point(p.z);
      ++v.count;
      grid.voxel_of[first + k] = number;
    }
  }

  const std::vector<Voxel>& voxels = table.voxels();
  const std::vector<std::uint32_t> order = in_order_of_grid(voxels);
  grid.centroids = Points(static_cast<Index>(voxels.size()), 3);
  grid.cells.resize(voxels.size());
  grid.counts.resize(voxels.size());
  std::vector<std::uint32_t> rank(voxels.size());
  for (std::uint32_t r = 0; r < order.size(); ++r) {
    const Voxel& v = voxels[order[r]];
    const double n = static_cast<double>(v.count) * kUnits;
    grid.centroids(r, 0) = (v.x + static_cast<double>(v.sum_x) / n) * voxel;
    grid.centroids(r, 1) = (v.y + static_cast<double>(v.sum_y) / n) * voxel;
    grid.centroids(r, 2) = (v.z + static_cast<double>(v.sum_z) / n) * voxel;
    grid.cells[r] = {v.x, v.y, v.z};
    grid.counts[r] = v.count;
    rank[order[r]] = r;
  }
  for (std::uint32_t& v : grid.voxel_of) v = rank[v];
  return grid;
}

void require_exact_cells(const VoxelGrid& grid, double voxel) {
  for (const Vec3& cell : grid.cells) {
    if (std::ranges::all_of(cell, [](double c) { return std::abs(c) <= kMostExactCell; })) continue;
    const double farthest = std::max({std::abs(cell[0]), std::abs(cell[1]), std::abs(cell[2])});
    throw Error(
        ErrorKind::usage,
        fmt::format(
            "{}: found {}, expected at least about {:.2g}, because points lie around ({}, {}, {})",
            mark(Setting::voxel), voxel, farthest / kMostExactCell * voxel, cell[0] * voxel,
            cell[1] * voxel, cell[2] * voxel));
  }
}

}  // namespace ph::segment
