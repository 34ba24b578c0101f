// SPDX-License-Identifier: MIT
#pragma once
#include "ph/barcode.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/cubical/bar_sink.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// True if `pair_voxels` can do it: there are some voxels, and their number is unlimited if all
/// bars come from its two graphs, as with at most two axes of more than one voxel (T: or of axes
/// that are not periodic). For three axes, the other bars are refused when they are asked for, from
/// about 2^31 voxels on; for more axes, they need fewer than 2^32 cells (2^d per voxel).
bool can_pair_voxels(const CubicalImage& grid, int max_dim);
/// The bytes that `pair_voxels` takes in addition to the image, without critical cells and bars.
/// Precondition: `can_pair_voxels`.
double bytes_to_pair_voxels(const CubicalImage& grid);
/// The same bytes if memory is so short that `pair_voxels` processes some layers at a time; the
/// larger number above if it cannot do so. Precondition: `can_pair_voxels`.
double least_bytes_to_pair_voxels(const CubicalImage& grid);
/// True if least_bytes_to_pair_voxels, and the bars, are all the memory needed: no bars are wanted
/// that need all layers at once. Precondition: `can_pair_voxels`.
bool can_pair_by_layers(const CubicalImage& grid, const BarRequest& wanted);

/// True if `pair_voxels` can process some layers at a time on request.
bool can_be_cut(const CubicalImage& grid, const BarRequest& wanted);

/// The pairs of positive length of the cubical filtration of an image. Values of bars are values of
/// the filtration. Cells are the cells of the pairs in the order of VoxelFiltration. Time:
/// near-linear for H0 and the second highest dimension, plus a reduction of critical cells for the
/// dimensions between them. Memory: 8 bytes per voxel, for more than three axes another 2 per cell,
/// and the critical cells.
/// @throws Error (resource) if loops of three axes are wanted for too many voxels.
template <Field K>
void pair_voxels(const CubicalImage& grid, const K& field, const BarRequest& wanted,
                 const RunContext& context, const BarSink& sink);

extern template void pair_voxels(const CubicalImage&, const Z2&, const BarRequest&,
                                 const RunContext&, const BarSink&);
extern template void pair_voxels(const CubicalImage&, const Zp&, const BarRequest&,
                                 const RunContext&, const BarSink&);

}  // namespace ph::cubical
