// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "libph/src/cubical/grid/slab_frame.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// A grid of more than three axes, or some of its layers, for its two graphs: voxels with their
/// age. It has no cells between the cells of the graphs; their number is therefore irrelevant.
class LayerGrid : public SlabFrame {
 public:
  /// Precondition: can_hold(grid), more than three axes. Memory: 8 bytes per voxel.
  LayerGrid(const CubicalImage& grid, const RunContext& context, const SlabPlace& slab = {});

  /// The value in the order of the stars.
  double value(std::uint32_t v) const { return values_[v]; }
  bool enters(std::uint32_t v) const {
    return (is_t_construction() ? -values_[v] : values_[v]) <= grid_.limit;
  }
  bool all_enter() const { return all_enter_; }
  /// True if a voxel is older than another one, which must enter and must not be a ghost. By its
  /// value, a voxel that never enters is younger than all others in the V-construction, and older
  /// in the T-construction.
  /// @param u kOutside stands for a voxel of the border, which exists only in the T-construction.
  bool is_older(std::uint32_t u, std::uint32_t v) const {
    if (u == kOutside) return is_t_construction();
    // mutant: many-axes-tie
    return comes_before(u, v) ? values_[u] <= values_[v] : values_[u] < values_[v];
  }

  /// The voxels to which steps from a voxel lead.
  class Steps {
   public:
    Steps(const LayerGrid& grid, std::uint32_t v);
    /// A step from the voxel, or from a voxel that lies beside it along other axes. @param up false
    /// means down.
    std::uint32_t from(std::uint32_t u, int axis, bool up) const {
      const auto way = static_cast<std::size_t>(2 * axis + (up ? 1 : 0));
      return u == kOutside || (leaves_ >> way & 1U) != 0 ? kOutside : u + by_[way];
    }
    /// Orders the steps along an axis like the cells that they lead to in the grid.
    /// @param step 0 (none), 1 (down), 2 (up).
    unsigned order(int axis, unsigned step) const {
      constexpr std::array<unsigned, 3> plain{1, 0, 2}, wrapped{1, 3, 2};  // mutant: many-axes-ring
      return (wrapped_ >> axis & 1U) != 0 ? wrapped[step] : plain[step];
    }

   private:
    // At 2 * axis downwards, and at 2 * axis + 1 upwards.
    std::array<std::uint32_t, 2 * std::size_t{GridShape::kMostAxes}> by_{};  // modulo 2^32
    unsigned leaves_ = 0;   // steps that lead outside, as bits
    unsigned wrapped_ = 0;  // axes along which the cell below comes last, as bits
  };

 private:
  RawVector<double> values_;
  bool all_enter_ = true;
};

}  // namespace ph::cubical
