// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>

#include "ph/core/barcode.hpp"
#include "ph/core/field.hpp"
#include "ph/core/run_context.hpp"
#include "ph/core/voxel_grid.hpp"

namespace ph::cubical {

/// Receives a bar with its cells in doubled grid coordinates of the input; no death cell: infinite.
using BarSink =
    std::function<void(const Bar& bar, std::span<const Index> birth, std::span<const Index> death)>;

/// Whether `pair_voxels` can: at most three axes count (see StarGrid).
bool can_pair_voxels(const VoxelGrid& grid);

/// The pairs of the cubical filtration of an image up to a dimension: those of positive length, and
/// some of length zero. Values of bars are those of the filtration. Cells are those of the pairs in
/// the order of VoxelFiltration.
/// Time: near-linear for H0 and the highest dimension, plus a reduction of critical cells for H1 of
/// three axes. Memory: 8 bytes a voxel, and what critical cells take.
template <Field K>
void pair_voxels(const VoxelGrid& grid, const K& field, int max_dim, const RunContext& context,
                 const BarSink& sink);

extern template void pair_voxels(const VoxelGrid&, const Z2&, int, const RunContext&,
                                 const BarSink&);
extern template void pair_voxels(const VoxelGrid&, const Zp&, int, const RunContext&,
                                 const BarSink&);

}  // namespace ph::cubical
