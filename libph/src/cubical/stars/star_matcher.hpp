// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/cubical/grid/cell_grid.hpp"

namespace ph::cubical {

/// For each dimension, the cells of a grid that are in no known pair, in the order of the
/// filtration.
using CriticalNames = std::array<std::pmr::vector<CellGrid::Name>, CellGrid::kMostAxes + 1>;

/// Marks each cell of a grid with the voxel that decides its value, and with its partner inside the
/// star of that voxel. The pairs of partners form a discrete gradient. @return the cells that have
/// no partner.
CriticalNames mark_cells(CellGrid& grid, const RunContext& context);

/// The cells of a star as seen from its voxel, for a given number of axes. The code of a cell is a
/// number in base 3 with one digit for each axis. The digit gives the step away from the voxel
/// along that axis: 0 (none), 1 (down), 2 (up).
struct StarShapes {
  struct Shape {
    std::uint8_t steps = 0;  ///< the number of axes with a step
    std::uint8_t down = 0;   ///< the axes with a step down, as bits
    std::array<std::uint16_t, CellGrid::kMostAxes> without{};  ///< codes with one step fewer
  };
  explicit StarShapes(int axes, std::pmr::memory_resource* memory);

  std::array<std::uint16_t, CellGrid::kMostAxes> digit{};  ///< the value of a step down, by axis
  std::pmr::vector<Shape> shapes;                          ///< indexed by code
};

/// Finds the star of a voxel, that is, the cells whose value this voxel decides, and pairs cells
/// inside it. Each thread has its own object.
///
/// A cell of the star is some steps away from the voxel, with at most one step along each axis. In
/// the V-construction (V), the cell is in the star if all its other voxels are older. In the
/// T-construction (T), it is in the star if all its other voxels are younger or missing. Adding a
/// step turns a cell into a coface (V) or a face (T). The stars of both constructions are therefore
/// subsets of the same 3^d cells. If steps and cells are sorted by their places (in T, backwards),
/// both stars have the same pairs.
///
/// Apparent pairs (ph/detail/reduction/apparent_pairs.hpp) come first. An apparent pair consists of
/// two cells one step apart. The step between them is the first step that can be added to the lower
/// cell, and also the first step that the upper cell has. Then paths of the gradient are reversed
/// (Forman, Morse theory for cell complexes, section 11). If exactly one path leads from a cell to
/// the youngest cell that it can reach, the first cell kills the second cell, and the path is
/// reversed.
class StarMatcher {
 public:
  StarMatcher(CellGrid& grid, const StarShapes& shapes, const RunContext& context);

  /// Marks the cells in the star of a voxel, which must enter. @param at the coordinates of the
  /// voxel.
  void mark_star(std::uint32_t voxel, const CellGrid::Coordinates& at);
  CriticalNames& critical() { return critical_; }

 private:
  struct Step {
    std::int64_t places;       // the offset in the doubled grid
    std::uint32_t to;          // the offset to the next voxel, modulo 2^32
    std::uint32_t steps_back;  // the opposite step along the axis, as a bit
    std::uint16_t code;
    std::uint8_t direction;  // 2 * axis, plus 1 for upwards
    bool is_outside;         // true if the step leads outside the grid
  };
  using Place = std::uint16_t;  // index among the cells of the star
  static constexpr Place kNone = UINT16_MAX;
  struct StarCell {
    std::uint32_t cell;
    // The farthest voxel that the cell touches, or CellGrid::kNone if this voxel is outside the
    // grid.
    std::uint32_t voxel;
    std::uint32_t steps;  // the steps, as bits
    std::uint16_t code;
    Place partner = kNone;
    // These members are used only while paths are counted.
    Place paths_in = 0, paths = 0, from = kNone;
  };

  void find_steps(const CellGrid::Coordinates& at);
  void find_cells(std::uint32_t voxel, const CellGrid::Coordinates& at);
  void pair_apparent_cells();
  void pair_rest();
  /// If paths lead from a cell to unpaired cells one step below, reverses the path to the youngest
  /// of these cells, which pairs both ends of the path. If several paths lead to the youngest cell,
  /// no cell is paired. @return true unless several paths lead to the youngest cell.
  bool pair_along_path(Place cell);
  /// Counts the paths from a cell to each of the cells in `reached_`. A count stops at two.
  void count_paths(Place cell);
  /// Calls `visit(place)` for the cells one step below through which a path from `cell` continues.
  template <class Visit>
  void for_each_next(Place cell, Visit&& visit);
  void mark_cells(std::uint32_t voxel);

  bool is_in_star(std::uint32_t rank, std::uint32_t voxel) const {
    if (voxel == CellGrid::kNone) return true;  // only T has steps to the outside
    return grid_.voxels_are_vertices() ? grid_.rank(voxel) < rank : grid_.rank(voxel) > rank;
  }
  bool is_younger(Place a, Place b) const {
    const std::uint32_t x = cells_[a].cell, y = cells_[b].cell;
    return grid_.voxels_are_vertices() ? x > y : x < y;
  }
  /// True if a cell is in a pair with a cell one step below.
  bool is_upper(const StarCell& c) const {
    return c.partner != kNone && (cells_[c.partner].steps & ~c.steps) == 0;
  }

  CellGrid& grid_;
  const StarShapes& shapes_;
  // The steps are in the order in which apparent pairs use them.
  std::array<Step, 2 * std::size_t{CellGrid::kMostAxes}> steps_;
  std::size_t step_count_ = 0;
  // The ends of axes that the previous voxel touched.
  std::uint32_t border_ = UINT32_MAX;
  // The cells are sorted so that each cell comes after the cells that have one step fewer.
  std::pmr::vector<StarCell> cells_;
  std::pmr::vector<Place> place_;  // indexed by code; kNone if the cell is not in the star
  std::pmr::vector<Place> rest_, reached_, stack_;
  CriticalNames critical_;
};

}  // namespace ph::cubical
