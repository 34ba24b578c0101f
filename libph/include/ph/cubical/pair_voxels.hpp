// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>

#include "ph/core/barcode.hpp"
#include "ph/core/cubical_image.hpp"
#include "ph/core/field.hpp"
#include "ph/core/run_context.hpp"

namespace ph::cubical {

/// Receives bars: from one thread at a time, not always the same.
struct BarSink {
  /// One with its cells, in doubled grid coordinates of the input.
  std::function<void(const Bar& bar, std::span<const Index> birth, std::span<const Index> death)>
      add;
  /// Some without: cells are not wanted.
  std::function<void(std::span<const Bar> bars)> add_all;
  /// Says that so many bars may come next.
  std::function<void(std::size_t count)> expect;
};

/// Whether `pair_voxels` can: at most three axes that have more than one voxel (T: or are not
/// periodic), fewer than about 2^31 voxels, and not none.
bool can_pair_voxels(const CubicalImage& grid);

/// The pairs of positive length of the cubical filtration of an image up to a dimension, at least.
/// Values of bars are those of the filtration. Cells are those of the pairs in the order of
/// VoxelFiltration.
/// @param wants_cells else bars have none.
/// Time: near-linear for H0 and the highest dimension, plus a reduction of critical cells for H1 of
/// three axes. Memory: 8 bytes a voxel, and what critical cells take.
template <Field K>
void pair_voxels(const CubicalImage& grid, const K& field, int max_dim, bool wants_cells,
                 const RunContext& context, const BarSink& sink);

extern template void pair_voxels(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                                 const BarSink&);
extern template void pair_voxels(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                                 const BarSink&);

}  // namespace ph::cubical
