// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/core/field.hpp"
#include "ph/detail/cubical/bar_sink.hpp"
#include "ph/detail/image/cubical_image.hpp"

namespace ph::cubical {

/// True if `pair_cells` can do it: there are some cells, and fewer than 2^32.
bool can_pair_cells(const CubicalImage& grid);
/// Bytes that it keeps for all cells.
double bytes_of_cells(const CubicalImage& grid);

/// The same as `pair_voxels` for any number of axes: components from both ends, and a reduction of
/// critical cells between them. Memory: 8 bytes per voxel, 2 per cell (2^d cells per voxel), and
/// the critical cells.
template <Field K>
void pair_cells(const CubicalImage& image, const K& field, int max_dim, bool wants_cells,
                const RunContext& context, const BarSink& bars);

extern template void pair_cells(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                                const BarSink&);
extern template void pair_cells(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                                const BarSink&);

}  // namespace ph::cubical
