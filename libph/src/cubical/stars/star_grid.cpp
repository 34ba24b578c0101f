// SPDX-License-Identifier: MIT
#include "libph/src/cubical/stars/star_grid.hpp"

#include <algorithm>
#include <limits>
#include <mutex>

#include "ph/detail/core/parallel.hpp"

namespace ph::cubical {
namespace {

constexpr std::uint32_t kBlock = 4096;  // the number of voxels of a row that are processed together
// The approximate number of voxels that a thread takes at a time.
constexpr std::uint32_t kPiece = 1 << 16;

// Compares the age of u with the age of v. Precondition: v is not absent. There are two versions,
// without and with equality, because the order of the grid decides between equal voxels. An absent
// voxel has the value NaN. It is younger than all others in the V-construction. It is older than
// all others in the T-construction, where a voxel that never enters was always there.
template <bool descending, bool absent_is_older>
struct VoxelAges {
  template <class T>
  static bool is_older(T u, T v) {
    // mutant: star-absent
    if constexpr (absent_is_older) return descending ? !(u <= v) : !(u >= v);
    return descending ? u > v : u < v;
  }
  template <class T>
  static bool is_not_younger(T u, T v) {
    if constexpr (absent_is_older) return descending ? !(u < v) : !(u > v);
    return descending ? u >= v : u <= v;
  }
};

}  // namespace

StarGrid::StarGrid(const CubicalImage& grid, const RunContext& context, const SlabPlace& slab)
    : SlabFrame(grid, slab),
      context_(context),
      stars_(&context.memory),
      cube_pairs_(slab.cube_pairs),
      critical_(&context.memory) {
  if (cube_pairs_ == nullptr) cube_pairs_ = cube_pair_memos(shape(), slab.is_in_ring, context);
  stars_.resize(size_);
  with_voxels(grid.type, grid.voxels, [&]<class T>(const T* voxels) {
    // In the T-construction, values are negated.
    if (is_t_construction_)
      grid.superlevel ? find_stars<VoxelAges<false, true>>(voxels)
                      : find_stars<VoxelAges<true, true>>(voxels);
    else
      grid.superlevel ? find_stars<VoxelAges<true, false>>(voxels)
                      : find_stars<VoxelAges<false, false>>(voxels);
  });
}

CubePairMemos cube_pair_memos(const GridShape& grid, bool is_in_ring, const RunContext& context) {
  auto memos = std::make_shared<std::pmr::vector<CubePairMemo>>(&context.memory);
  if (grid.top_dim() != 3) return memos;
  unsigned may_wrap = is_in_ring ? 1U << grid.layer_axis() : 0;
  for (int a = 0; a < 3; ++a)
    if (grid.axis(a).periodic) may_wrap |= 1U << a;
  for (unsigned wraps = 0; wraps <= may_wrap; ++wraps)
    memos->emplace_back(star_tables(wraps), (wraps & ~may_wrap) == 0, &context.memory);
  return memos;
}

template <class Ages, class T>
std::uint32_t StarGrid::find_one(const T* voxels, std::uint32_t v) const {
  const auto at = [&](std::uint32_t u) { return voxels[is_t_construction_ ? size_ - 1 - u : u]; };
  std::uint32_t star = 0;
  const T value = at(v);
  const auto look = [&](const Direction& d) {
    std::uint32_t u = v;
    for (int a = 0; a < 3; ++a) {
      if (d[a] == 0) continue;
      if (!axes_[a].exists) return;
      if (u != kOutside) u = step(u, a, d[a]);
    }
    const bool older = u == kOutside        ? is_t_construction_
                       : comes_before(u, v) ? Ages::is_not_younger(at(u), value)
                                            : Ages::is_older(at(u), value);
    if (older) star |= star_bit(d);
  };
  for (const Direction& d : kEdges) look(d);
  for (const Direction& d : kSquares) look(d);
  for (const Direction& d : kCubes) look(d);
  return star;
}

// Finds the stars of a part of a row. Inside the row, neighbours are at fixed distances in memory.
// Each neighbour therefore needs only one comparison and no further tests. Compilers vectorise
// these comparisons.
template <class Ages, class T>
void StarGrid::find_block(const T* voxels, const Block& block, std::uint32_t* stars) const {
  const Axis &deep = axes_[0], &high = axes_[1];
  const std::uint32_t n = axes_[2].extent, first = block.z * deep.stride + block.y * high.stride;
  const std::uint32_t count = block.end - block.begin;
  std::fill_n(stars, count, 0U);
  // From here on, x runs in the order of memory, which is backwards in the T-construction.
  const auto block_at = [&](std::uint32_t row) {
    return is_t_construction_ ? voxels + (size_ - row - block.end) : voxels + (row + block.begin);
  };
  const T* center = block_at(first);
  const bool from_border = (is_t_construction_ ? block.end == n : block.begin == 0);
  const bool to_border = (is_t_construction_ ? block.begin == 0 : block.end == n);
  const std::uint32_t x_begin = from_border ? 1 : 0, x_end = count - (to_border ? 1 : 0);
  const int forward = is_t_construction_ ? -1 : 1;
  for (int dz = -1; dz <= 1; ++dz) {
    if (dz != 0 && !deep.exists) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      if (dy != 0 && !high.exists) continue;
      // The bits of the neighbours at x - 1, x and x + 1 in memory.
      std::array<std::uint32_t, 3> bits{};
      for (int dx = -1; dx <= 1; ++dx)
        if (const Direction d{dz, dy, dx * forward}; dimension_of(d) != 0)
          bits[dx + 1] = star_bit(d);
      std::uint32_t row = first;
      bool outside = false;
      const auto move = [&](const Axis& axis, std::uint32_t x, int by) {
        if (by == 0) return;
        const bool leaves = by > 0 ? x + 1 == axis.extent : x == 0;
        outside = outside || (leaves && !axis.periodic);
        const std::uint32_t to = by > 0 ? (leaves ? 0 : x + 1) : (leaves ? axis.extent : x) - 1;
        row += (to - x) * axis.stride;  // modulo 2^32 if the row decreases
      };
      move(deep, block.z, dz);
      move(high, block.y, dy);
      if (outside) {
        if (is_t_construction_)
          for (std::uint32_t x = 0; x < count; ++x) stars[x] |= bits[0] | bits[1] | bits[2];
        continue;
      }
      const T* other = block_at(row);
      const auto compare = [&](auto&& is_older_below, auto&& is_older_above) {
        const std::uint32_t below = bits[0], beside = bits[1], above = bits[2];
        for (std::uint32_t x = x_begin; x < x_end; ++x) {
          const T v = center[x];
          stars[x] |= (is_older_below(other[static_cast<std::ptrdiff_t>(x) - 1], v) ? below : 0U) |
                      (is_older_above(other[x], v) ? beside : 0U) |
                      (is_older_above(other[x + 1], v) ? above : 0U);
        }
      };
      // Voxels that come before v are older if they have the same value.
      const auto older = [](T u, T v) { return Ages::is_older(u, v); };
      const auto not_younger = [](T u, T v) { return Ages::is_not_younger(u, v); };
      if (row == first) {
        is_t_construction_ ? compare(older, not_younger) : compare(not_younger, older);
      } else {
        comes_before(row, first) ? compare(not_younger, not_younger) : compare(older, older);
      }
    }
  }
  if (is_t_construction_) std::reverse(stars, stars + count);
  const auto find = [&](std::uint32_t x) {
    if (block.begin <= x && x < block.end)
      stars[x - block.begin] = find_one<Ages>(voxels, first + x);
  };
  find(0);
  find(n - 1);
  // With one axis, ghosts are in the row itself, and may come from the other end of a ring.
  if (layer_size() == 1 && slab().is_in_ring && n > 2) {  // mutant: slab-one-axis
    find(1);
    find(n - 2);
  }
}

// Removes cells that cannot be in the stars of the voxels from `begin` up to `end`, and lists the
// voxels with a critical cell. @return the number of voxels listed.
std::size_t StarGrid::close_stars(std::uint32_t begin, std::uint32_t end, std::uint32_t* list) {
  const auto close = [&](auto&& tables_of) {
    std::size_t count = 0;
    for (std::uint32_t v = begin; v < end; ++v) {
      if (stars_[v] == kAbsent) continue;
      const auto [star, critical] = tables_of(v).closed(stars_[v]);
      stars_[v] = star;
      // A branch would be unpredictable here. The code therefore always writes v, but advances
      // `count` only if `critical` is not 0.
      list[count] = v;
      count += (critical | (0U - critical)) >> 31;
    }
    return count;
  };
  const StarTables& plain = star_tables(0);
  return any_periodic_ ? close([&](std::uint32_t v) -> const StarTables& { return tables(v); })
                       : close([&](std::uint32_t) -> const StarTables& { return plain; });
}

template <class Ages, class T>
void StarGrid::find_stars(const T* voxels) {
  const std::uint32_t n = axes_[2].extent, high = axes_[1].extent;
  const std::uint32_t blocks_a_row = (n - 1) / kBlock + 1;
  const std::size_t blocks = std::size_t{size_ / n} * blocks_a_row;
  const std::size_t blocks_a_piece = std::max<std::size_t>(1, kPiece / std::min(n, kBlock));
  // A voxel enters if value <= limit, where values are negated for superlevel sets.
  const bool superlevel = grid_.superlevel;
  const double limit = grid_.limit;
  const bool some_may_not = std::is_floating_point_v<T> || limit < std::numeric_limits<int>::max();
  const auto enters = [&](T x) {
    // mutant: star-threshold
    return (superlevel ? -static_cast<double>(x) : static_cast<double>(x)) <= limit;
  };
  struct Piece {
    std::size_t begin;
    RawVector<std::uint32_t> found;
  };
  std::mutex mutex;
  std::vector<Piece> pieces;
  for_each_piece(
      "stars", blocks, blocks_a_piece, context_, [&](std::size_t begin, std::size_t end) {
        RawVector<std::uint32_t> found(&context_.memory);
        bool all = true;
        for (std::size_t i = begin; i < end; ++i) {
          const auto row = static_cast<std::uint32_t>(i / blocks_a_row);
          const auto x = static_cast<std::uint32_t>(i % blocks_a_row) * kBlock;
          const Block block{row / high, row % high, x, std::min(n, x + kBlock)};
          const std::uint32_t first = row * n + block.begin, count = block.end - block.begin;
          std::uint32_t* stars = stars_.data() + first;
          const bool is_line = layer_size() == 1;
          const bool is_ghost = !is_line && this->is_ghost(first);
          if (is_ghost)
            std::fill_n(stars, count, 0U);
          else
            find_block<Ages>(voxels, block, stars);
          if (is_line)
            for (const std::uint32_t k : {0U, count - 1})
              if (this->is_ghost(first + k)) stars[k] = 0;  // mutant: slab-ghosts
          if (some_may_not) {
            const T* there = is_t_construction_ ? voxels + (size_ - first - count) : voxels + first;
            bool block_enters = true;
            for (std::uint32_t k = 0; k < count; ++k) block_enters &= enters(there[k]);
            if (!block_enters)
              for (std::uint32_t k = 0; k < count; ++k)
                if (!enters(there[k])) stars[is_t_construction_ ? count - 1 - k : k] = kAbsent;
            all = all && block_enters;
          }
          if (is_ghost) continue;
          // With one axis, only the ends of the row may be ghosts.
          const std::uint32_t begin_own = is_line && this->is_ghost(first) ? 1 : 0;
          const std::uint32_t end_own =
              count - (is_line && this->is_ghost(first + count - 1) ? 1 : 0);
          const std::size_t before = found.size();
          found.resize(before + count);
          found.resize(before + close_stars(first + begin_own, first + end_own, &found[before]));
          context_.poll();
        }
        const std::lock_guard lock(mutex);
        all_enter_ = all_enter_ && all;
        pieces.push_back({begin, std::move(found)});
      });
  std::ranges::sort(pieces, {}, &Piece::begin);
  std::size_t count = 0;
  for (const Piece& piece : pieces) count += piece.found.size();
  critical_.reserve(count);
  for (Piece& piece : pieces) {
    critical_.insert(critical_.end(), piece.found.begin(), piece.found.end());
    piece.found = RawVector<std::uint32_t>(&context_.memory);
  }
}

}  // namespace ph::cubical
