// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/core/field.hpp"
#include "ph/detail/cubical/bar_sink.hpp"
#include "ph/detail/image/cubical_image.hpp"

namespace ph::cubical {

/// True if `pair_cells` can pair the image: it is not empty, at most 8 of its axes are kept, and it
/// has fewer than 2^32 cells (see CellGrid).
bool can_pair_cells(const CubicalImage& grid);
/// The number of bytes that `pair_cells` keeps for the marks of all cells.
double bytes_of_cells(const CubicalImage& grid);

/// Does the same as `pair_voxels` for any number of axes. It uses union-find in the lowest and the
/// highest dimension, and reduces critical cells between these dimensions. Memory: 8 bytes per
/// voxel, 2 bytes per cell (there are 2^d cells per voxel for d axes), and the critical cells.
template <Field K>
void pair_cells(const CubicalImage& image, const K& field, int max_dim, bool wants_cells,
                const RunContext& context, const BarSink& bars);

extern template void pair_cells(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                                const BarSink&);
extern template void pair_cells(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                                const BarSink&);

}  // namespace ph::cubical
