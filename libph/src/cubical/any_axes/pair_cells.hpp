// SPDX-License-Identifier: MIT
#pragma once
#include "cubical/pair_voxels.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::cubical {

/// Whether `pair_cells` can: fewer than 2^32 cells, and some.
bool can_pair_cells(const CubicalImage& grid);
/// What it keeps of all cells.
double bytes_of_cells(const CubicalImage& grid);

/// As `pair_voxels`, for any number of axes: components from both ends, a reduction of critical
/// cells between them. Memory: 8 bytes a voxel, 2 a cell (2^d a voxel), and what critical cells
/// take.
template <Field K>
void pair_cells(const CubicalImage& image, const K& field, int max_dim, bool wants_cells,
                const RunContext& context, const BarSink& bars);

extern template void pair_cells(const CubicalImage&, const Z2&, int, bool, const RunContext&,
                                const BarSink&);
extern template void pair_cells(const CubicalImage&, const Zp&, int, bool, const RunContext&,
                                const BarSink&);

}  // namespace ph::cubical
