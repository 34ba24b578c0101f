// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "cubical/any_axes/cell_grid.hpp"

namespace ph::cubical {

/// By dimension the cells of a grid that are in no pair that is known, in the order of the
/// filtration.
using CriticalNames = std::array<std::pmr::vector<CellGrid::Name>, CellGrid::kMostAxes + 1>;

/// Marks the cells of a grid: which voxel decides when they enter, and their pairs inside stars as
/// a discrete gradient. @return those that are in no such pair.
CriticalNames mark_cells(CellGrid& grid, const RunContext& context);

/// What the cells of a star look like from its voxel, for a number of axes: a cell has a code, its
/// steps away from the voxel along the axes as digits 0 (none), 1 (down), 2 (up), to base 3.
struct StarShapes {
  struct Shape {
    std::uint8_t steps = 0;  ///< how many axes it leaves the voxel along
    std::uint8_t down = 0;   ///< along which of them downwards, as bits
    std::array<std::uint16_t, CellGrid::kMostAxes> without{};  ///< codes with one step less
  };
  explicit StarShapes(int axes, std::pmr::memory_resource* memory);

  std::array<std::uint16_t, CellGrid::kMostAxes> digit{};  ///< what one step down adds, by axis
  std::pmr::vector<Shape> shapes;                          ///< by code
};

/// Finds the star of a voxel, the cells whose value it decides, and pairs inside it. One for each
/// thread.
///
/// A cell of the star lies some steps away from the voxel, one along each of some axes. It is in
/// the star if all voxels that it can be reached by are older (V; younger or none: T). Adding a
/// step turns a cell into a coface (V) or a face (T): both stars are cut out of the same 3^d cells,
/// and with steps and cells in the order of their places (backwards: T) both have the same pairs.
/// Apparent ones (ph/detail/reduction/apparent_pairs.hpp) first: two cells one step apart such that
/// it is the first that can be added to the one and the first that the other has. Then as in any
/// discrete gradient: a cell from which one path alone leads to the youngest cell that can be
/// reached kills it, and the path is turned around (Forman, Morse theory for cell complexes,
/// section 11).
class StarMatcher {
 public:
  StarMatcher(CellGrid& grid, const StarShapes& shapes, const RunContext& context);

  /// Marks the cells in the star of a voxel that enters. @param at its coordinates.
  void mark_star(std::uint32_t voxel, const CellGrid::Coordinates& at);
  CriticalNames& critical() { return critical_; }

 private:
  struct Step {
    std::int64_t places;       // how far it leads in the doubled grid
    std::uint32_t to;          // how far to the next voxel, modulo 2^32
    std::uint32_t steps_back;  // the other step along the axis, as bit
    std::uint16_t code;
    std::uint8_t direction;  // 2 * axis + 1: up
    bool is_outside;         // beyond it there is no voxel
  };
  using Place = std::uint16_t;  // among the cells of the star
  static constexpr Place kNone = UINT16_MAX;
  struct StarCell {
    std::uint32_t cell;
    std::uint32_t voxel;  // the far one of those it touches; CellGrid::kNone: outside
    std::uint32_t steps;  // as bits
    std::uint16_t code;
    Place partner = kNone;
    // While paths are counted:
    Place paths_in = 0, paths = 0, from = kNone;
  };

  void find_steps(const CellGrid::Coordinates& at);
  void find_cells(std::uint32_t voxel, const CellGrid::Coordinates& at);
  void pair_apparent_cells();
  void pair_rest();
  /// Pairs a cell with one of those a step below. @return false if that is not decided by paths.
  bool pair_along_path(Place cell);
  /// Counts the paths from a cell to those in `reached_`: none, one, or more.
  void count_paths(Place cell);
  /// Calls `visit(place)` for the cells a step below that are left along a path from `cell`.
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
  /// Whether a cell is in a pair with one a step below.
  bool is_upper(const StarCell& c) const {
    return c.partner != kNone && (cells_[c.partner].steps & ~c.steps) == 0;
  }

  CellGrid& grid_;
  const StarShapes& shapes_;
  std::array<Step, 2 * std::size_t{CellGrid::kMostAxes}> steps_;  // in the order of apparent pairs
  std::size_t step_count_ = 0;
  std::uint32_t border_ = UINT32_MAX;  // at which ends of the axes the last voxel was
  std::pmr::vector<StarCell> cells_;   // a cell after those with a step less
  std::pmr::vector<Place> place_;      // by code; kNone: it is not in the star
  std::pmr::vector<Place> rest_, reached_, stack_;
  CriticalNames critical_;
};

}  // namespace ph::cubical
