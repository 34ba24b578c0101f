// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>
#include <span>

#include "ph/barcode.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// The representative of a bar: a chain or a set of voxels.
struct RepresentedBar {
  std::span<const Index> numbers;  ///< numbers of the cells of the chain, one after another
  std::span<const std::int64_t> coefficients;
  VoxelRange voxels;                                ///< the range among the stored voxels
  std::span<const Index> birth_voxel, death_voxel;  ///< coordinates; empty if there is no death
};

/// Receives bars and their representatives, from one thread.
struct RepresentativeSink {
  /// Adds a bar with its cells, which are given by coordinates in the doubled grid of the input.
  /// @return true if the bar is kept.
  std::function<bool(const Bar& bar, std::span<const Index> birth, std::span<const Index> death)>
      add;
  /// Adds the representative of the last bar that was kept.
  std::function<void(const RepresentedBar&)> represent;
  /// Stores positions of voxels in the input. @return the index of the first of these positions
  /// among all stored positions.
  std::function<std::size_t(std::span<const std::uint32_t>)> store;
};

/// True if `represent_voxels` can process the image: it is not empty, has fewer than about 2^31
/// voxels, and at most three axes are kept (GridShape::keeps_axis).
bool can_represent_voxels(const CubicalImage& grid);

/// Computes the bars of `pair_voxels`, each with a cycle. If `kind` is voxels, bars of H0 and of
/// the second highest dimension have a set of voxels instead of a cycle. A bar of the second
/// highest dimension has a cycle nevertheless if its set would be empty, or if an axis with one
/// voxel is periodic. Preconditions: can_represent_voxels(grid), and `kind` is cycles or voxels.
/// Time: three to five times the time of `pair_voxels`. Memory: 20 bytes per voxel, the critical
/// cells and the output. The function does not work in slabs, so the entire image must fit in
/// memory.
template <Field K>
void represent_voxels(const CubicalImage& grid, const K& field, int max_dim, Representatives kind,
                      const RunContext& context, const RepresentativeSink& sink);

extern template void represent_voxels(const CubicalImage&, const Z2&, int, Representatives,
                                      const RunContext&, const RepresentativeSink&);
extern template void represent_voxels(const CubicalImage&, const Zp&, int, Representatives,
                                      const RunContext&, const RepresentativeSink&);

}  // namespace ph::cubical
