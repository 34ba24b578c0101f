// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/cubical/grid/grid_frame.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// The state of a cell in a grid, stored in two bytes.
class CellMark {
 public:
  /// The cell never enters.
  CellMark() = default;
  /// A cell in no known pair. @param upper the axes, as bits, along which the voxel that decides
  /// the value of the cell lies above the cell.
  static CellMark critical(unsigned upper) { return CellMark(kCritical, upper); }
  /// A cell that is killed by a cofacet. @param direction the direction from the cell to the
  /// cofacet, as in CellGrid::beside.
  static CellMark killed_by(int direction, unsigned upper) {
    return CellMark(kKilled + static_cast<unsigned>(direction), upper);
  }
  /// A cell that kills one of its facets, which lies in `direction`.
  static CellMark killing(int direction, unsigned upper) {
    return CellMark(kKiller + static_cast<unsigned>(direction), upper);
  }
  /// The same cell, marked as killing a cell outside its star.
  CellMark that_kills() const { return CellMark(kKills, upper()); }

  bool enters() const { return state() != kNever; }
  bool is_killed() const { return state() >= kKilled && state() < kKiller; }
  bool is_local_killer() const { return state() >= kKiller; }
  bool kills() const { return state() == kKills || is_local_killer(); }
  /// The direction from the cell to its partner. Precondition: is_killed() or is_local_killer().
  int direction() const {
    return static_cast<int>(state() - (is_killed() ? unsigned{kKilled} : unsigned{kKiller}));
  }
  unsigned upper() const { return bits_ & 0xFFU; }

 private:
  enum State : unsigned { kNever, kCritical, kKills, kKilled = 4, kKiller = 20 };
  CellMark(unsigned state, unsigned upper)
      : bits_(static_cast<std::uint16_t>(state << 8U | upper)) {}
  unsigned state() const { return unsigned{bits_} >> 8U; }

  std::uint16_t bits_ = 0;
};

/// The cells of an image with any number of axes. A cell is given by its position in the doubled
/// grid, in C order. Only a mark is stored for each cell, because a cell is as old as the voxel
/// that decides its value. Axes with one voxel are left out where possible. `CellSink` adds the
/// bars that are missing because a periodic axis is left out.
class CellGrid {
 public:
  static constexpr int kMostAxes = 8;
  static constexpr std::uint32_t kNone = UINT32_MAX;
  /// Doubled coordinates, or the coordinates of a voxel.
  using Coordinates = std::array<std::uint32_t, kMostAxes>;
  /// A cell as a number that orders the cells of one dimension as in the filtration. The high bits
  /// are the rank of the voxel that decides the value of the cell. The low bits are the position of
  /// the cell.
  using Name = std::uint64_t;
  static std::uint32_t cell(Name name) { return static_cast<std::uint32_t>(name); }

  struct Axis {
    std::uint32_t extent = 1;  ///< the number of voxels
    std::uint32_t length = 1;  ///< the number of doubled coordinates
    std::uint32_t stride = 1;  ///< the stride in the doubled grid
    bool periodic = false;
    Divisor by_length;
  };

  /// The number of positions in the doubled grid, without the axes that are left out.
  static double count_cells(const CubicalImage& grid);
  /// True if the image is not empty, at most 8 of its axes are kept, and it has fewer than 2^32
  /// cells.
  static bool can_hold(const CubicalImage& grid);
  /// Starts with all cells marked as never entering. Precondition: can_hold(grid). Time: O(voxels
  /// log voxels). Memory: 8 bytes per voxel and 2 per cell.
  CellGrid(const CubicalImage& grid, const RunContext& context);

  int dim() const { return dim_; }
  const Axis& axis(int k) const { return axes_[static_cast<std::size_t>(k)]; }
  bool voxels_are_vertices() const { return grid_.voxels_are_vertices; }
  std::size_t voxel_count() const { return ranks_.size(); }
  bool all_enter() const { return order_.size() == ranks_.size(); }
  /// The position of a voxel when all voxels that enter are sorted by age, or kNone if the voxel
  /// never enters.
  std::uint32_t rank(std::uint32_t voxel) const { return ranks_[voxel]; }
  double value(Name name) const { return grid_.value(order_[name >> 32U]); }

  CellMark mark(std::uint32_t cell) const { return marks_[cell]; }
  void set_mark(std::uint32_t cell, CellMark mark) { marks_[cell] = mark; }

  Coordinates coordinates(std::uint32_t cell) const {
    Coordinates x{};
    for (std::size_t k = static_cast<std::size_t>(dim_); k-- > 0;) {
      const std::uint32_t rest = axes_[k].by_length.divide(cell);
      x[k] = cell - rest * axes_[k].length;
      cell = rest;
    }
    return x;
  }
  /// The cell one step away from a cell. The step leads upwards if `direction` is 2 * axis + 1, and
  /// downwards if it is 2 * axis. Returns kNone if the step leads outside. @param x the doubled
  /// coordinate of the given cell on that axis.
  std::uint32_t beside(std::uint32_t cell, std::uint32_t x, int direction) const {
    const Axis& a = axes_[static_cast<std::size_t>(direction) / 2];
    if (direction % 2 != 0) {
      if (x + 1 < a.length) return cell + a.stride;
      return a.periodic ? cell - x * a.stride : kNone;
    }
    if (x > 0) return cell - a.stride;
    return a.periodic ? cell + (a.length - 1) * a.stride : kNone;
  }
  /// For the cell that `beside` returns, the doubled coordinate on the axis of the step.
  /// Precondition: the step does not lead outside.
  std::uint32_t next(std::uint32_t x, int direction) const {
    const std::uint32_t last = axes_[static_cast<std::size_t>(direction) / 2].length - 1;
    if (direction % 2 != 0) return x == last ? 0 : x + 1;
    return x == 0 ? last : x - 1;
  }
  /// The name of a cell. Precondition: the cell enters. @param x the coordinates of the cell.
  Name name(std::uint32_t cell, const Coordinates& x) const {
    return Name{ranks_[deciding_voxel(cell, x)]} << 32U | cell;
  }
  Name name(std::uint32_t cell) const { return name(cell, coordinates(cell)); }

  /// Calls `visit(facet, its coordinates, incidence)` for each facet of a cell. Incidences are as
  /// in ph/detail/complex/cubical_cells.hpp.
  /// @param x the coordinates of the cell.
  template <class Visit>
  void for_each_facet(std::uint32_t cell, Coordinates x, Visit&& visit) const {
    int sign = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim_); ++k) {
      const std::uint32_t own = x[k];
      if (own % 2 == 0) continue;
      const Axis& a = axes_[k];
      x[k] = own + 1 < a.length ? own + 1 : 0;
      visit(cell + (x[k] - own) * a.stride, x, sign);
      x[k] = own - 1;
      visit(cell - a.stride, x, -sign);
      x[k] = own;
      sign = -sign;
    }
  }
  /// Calls `visit(cell, its coordinates)` for each cell of the grid whose coordinates are odd on
  /// the axes that `parity` names, and even on all other axes.
  template <class Visit>
  void for_each_of_parity(const Coordinates& parity, Visit&& visit) const;

  /// The number of periodic axes with one voxel. For each such axis, every cell has a copy one
  /// dimension higher that goes around the axis.
  std::size_t loop_count() const { return loops_.size(); }
  /// Appends the coordinates of a cell in the input's doubled grid. @param loops the periodic axes
  /// with one voxel that the copy of the cell goes around, as bits; 0 for the cell itself.
  void append_numbers(std::uint32_t cell, unsigned loops, std::vector<Index>& numbers) const;

 private:
  void rank_voxels(const RunContext& context);
  std::uint32_t deciding_voxel(std::uint32_t cell, const Coordinates& x) const {
    const unsigned upper = marks_[cell].upper();
    const std::uint32_t between = grid_.voxels_are_vertices ? 1 : 0;
    std::uint32_t voxel = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim_); ++k) {
      std::uint32_t i = x[k] / 2;
      if (x[k] % 2 == between) i += (upper >> k & 1U) - 1 + between;
      if (i >= axes_[k].extent) i = i == axes_[k].extent ? 0 : axes_[k].extent - 1;
      voxel = voxel * axes_[k].extent + i;
    }
    return voxel;
  }

  CubicalImage grid_;
  int dim_ = 0;
  std::array<Axis, kMostAxes> axes_;                 // the last axis is the fastest
  std::array<std::size_t, kMostAxes> input_axis_{};  // the axis of the input
  std::vector<std::size_t> loops_;                   // periodic axes of the input with one voxel
  std::pmr::vector<std::uint32_t> ranks_, order_;    // ranks by voxel, and voxels by rank
  std::pmr::vector<CellMark> marks_;
};

template <class Visit>
void CellGrid::for_each_of_parity(const Coordinates& parity, Visit&& visit) const {
  Coordinates x{};
  std::uint32_t cell = 0;
  for (int k = 0; k < dim_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (parity[i] >= axes_[i].length) return;
    x[i] = parity[i];
    cell += x[i] * axes_[i].stride;
  }
  for (int k = dim_; k >= 0;) {
    visit(cell, x);
    for (k = dim_ - 1; k >= 0; --k) {
      const auto i = static_cast<std::size_t>(k);
      x[i] += 2;
      cell += 2 * axes_[i].stride;
      if (x[i] < axes_[i].length) break;
      cell -= (x[i] - parity[i]) * axes_[i].stride;
      x[i] = parity[i];
    }
  }
}

}  // namespace ph::cubical
