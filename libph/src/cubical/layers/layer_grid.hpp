// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "libph/src/cubical/grid/slab_frame.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// A grid of more than three axes, or some of its layers. It stores only the values of voxels,
/// because the two graphs need nothing else. No other cells are stored, so their number is not
/// limited.
class LayerGrid : public SlabFrame {
 public:
  /// Preconditions: can_hold(grid), and the grid has more than three axes. Memory: 8 bytes per
  /// voxel.
  LayerGrid(const CubicalImage& grid, const RunContext& context, const SlabPlace& slab = {});

  /// The value of a voxel in the order of the stars (GridFrame).
  double value(std::uint32_t v) const { return values_[v]; }
  bool enters(std::uint32_t v) const {
    return (is_t_construction() ? -values_[v] : values_[v]) <= grid_.limit;
  }
  bool all_enter() const { return all_enter_; }
  /// True if u is older than v. Preconditions: v enters and is not a ghost. A voxel that never
  /// enters counts as younger than all others in the V-construction, and as older than all others
  /// in the T-construction.
  /// @param u a voxel, or kOutside for a voxel of the border, which exists only in the
  /// T-construction.
  bool is_older(std::uint32_t u, std::uint32_t v) const {
    if (u == kOutside) return is_t_construction();
    // mutant: many-axes-tie
    return comes_before(u, v) ? values_[u] <= values_[v] : values_[u] < values_[v];
  }

  /// The voxels to which steps from a voxel lead.
  class Steps {
   public:
    Steps(const LayerGrid& grid, std::uint32_t v);
    /// The voxel one step away from u along `axis`, or kOutside. Precondition: u is the voxel
    /// itself, or is reached from it by steps along other axes. @param up false for a step down.
    std::uint32_t from(std::uint32_t u, int axis, bool up) const {
      const auto way = static_cast<std::size_t>(2 * axis + (up ? 1 : 0));
      return u == kOutside || (leaves_ >> way & 1U) != 0 ? kOutside : u + by_[way];
    }
    /// The rank of a step among the three steps along an axis. The steps are in the order in which
    /// the grid stores the cells that they lead to.
    /// @param step 0 (none), 1 (down), 2 (up).
    unsigned order(int axis, unsigned step) const {
      constexpr std::array<unsigned, 3> plain{1, 0, 2}, wrapped{1, 3, 2};  // mutant: many-axes-ring
      return (wrapped_ >> axis & 1U) != 0 ? wrapped[step] : plain[step];
    }

   private:
    // The offset of each step. The entry 2 * axis is for a step down, and 2 * axis + 1 is for a
    // step up.
    std::array<std::uint32_t, 2 * std::size_t{GridShape::kMostAxes}> by_{};  // modulo 2^32
    unsigned leaves_ = 0;   // the steps that lead outside, as bits
    unsigned wrapped_ = 0;  // the axes along which the cell below comes last, as bits
  };

 private:
  RawVector<double> values_;
  bool all_enter_ = true;
};

}  // namespace ph::cubical
