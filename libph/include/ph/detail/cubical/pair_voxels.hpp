// SPDX-License-Identifier: MIT
#pragma once
#include "ph/barcode.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/cubical/bar_sink.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// True if `pair_voxels` can process the image, which must have voxels. An axis counts if it has
/// more than one voxel or, in the T-construction, is not periodic. With at most two such axes,
/// `pair_voxels` finds all bars in two graphs, and the number of voxels is unlimited. With three
/// axes, it refuses an image of about 2^31 voxels or more if bars are wanted that are not found in
/// the graphs. With more axes, these bars require that the image has fewer than 2^32 cells (2^d per
/// voxel).
bool can_pair_voxels(const CubicalImage& grid, int max_dim);
/// The bytes that `pair_voxels` takes in addition to the image, not counting critical cells and
/// bars. Precondition: `can_pair_voxels`.
double bytes_to_pair_voxels(const CubicalImage& grid);
/// The bytes that `pair_voxels` takes if it processes only some layers at a time, because memory is
/// short. If the image cannot be processed in this way, the result is bytes_to_pair_voxels.
/// Precondition: `can_pair_voxels`.
double least_bytes_to_pair_voxels(const CubicalImage& grid);
/// True if `pair_voxels` needs no memory beyond least_bytes_to_pair_voxels and the bars, because no
/// wanted bar needs all layers at once. Precondition: `can_pair_voxels`.
bool can_pair_by_layers(const CubicalImage& grid, const BarRequest& wanted);

/// True if `pair_voxels` can process some layers at a time on request.
bool can_be_cut(const CubicalImage& grid, const BarRequest& wanted);

/// The pairs of positive length of the cubical filtration of an image. The bars have the values of
/// the filtration. Their cells are the cells that the order of VoxelFiltration pairs. Time:
/// near-linear for H0 and the second highest dimension, plus a reduction of critical cells for the
/// dimensions between them. Memory: 8 bytes per voxel, the critical cells, and for more than three
/// axes another 2 bytes per cell.
/// @throws Error (resource) if loops are wanted in an image that has three axes and too many
///         voxels.
template <Field K>
void pair_voxels(const CubicalImage& grid, const K& field, const BarRequest& wanted,
                 const RunContext& context, const BarSink& sink);

extern template void pair_voxels(const CubicalImage&, const Z2&, const BarRequest&,
                                 const RunContext&, const BarSink&);
extern template void pair_voxels(const CubicalImage&, const Zp&, const BarRequest&,
                                 const RunContext&, const BarSink&);

}  // namespace ph::cubical
