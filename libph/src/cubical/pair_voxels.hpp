// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>

#include "ph/barcode.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"

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

/// Which bars are wanted, at least.
struct BarRequest {
  int min_dim = 0, max_dim = 0;
  bool cells = true;  ///< else bars have none
};

/// Whether `pair_voxels` can: some voxels, and any number of them if bars come from its two graphs
/// alone, as all do of at most two axes that have more than one voxel (T: or are not periodic). Of
/// three axes the others are refused as they are asked for from about 2^31 voxels on; of more they
/// need fewer than 2^32 cells (2^d a voxel).
bool can_pair_voxels(const CubicalImage& grid, int max_dim);
/// The bytes that it takes beside the image, but for what critical cells and bars take.
/// Precondition: it can.
double bytes_to_pair_voxels(const CubicalImage& grid);
/// The same where memory is so short that it sees the image some layers at a time; more, if it does
/// not do so. Precondition: it can.
double least_bytes_to_pair_voxels(const CubicalImage& grid);
/// Whether that is enough but for the bars: none are wanted for which all layers are needed at
/// once. Precondition: it can.
bool can_pair_by_layers(const CubicalImage& grid, const BarRequest& wanted);

/// Whether it sees some layers at a time if it is asked to.
bool can_be_cut(const CubicalImage& grid, const BarRequest& wanted);

/// The pairs of positive length of the cubical filtration of an image.
/// Values of bars are those of the filtration. Cells are those of the pairs in the order of
/// VoxelFiltration.
/// Time: near-linear for H0 and the highest dimension but one, plus a reduction of critical cells
/// for those between them. Memory: 8 bytes a voxel, of more than three axes 2 a cell besides, and
/// what critical cells take.
/// @throws Error (resource) if loops of three axes are wanted of too many voxels.
template <Field K>
void pair_voxels(const CubicalImage& grid, const K& field, const BarRequest& wanted,
                 const RunContext& context, const BarSink& sink);

extern template void pair_voxels(const CubicalImage&, const Z2&, const BarRequest&,
                                 const RunContext&, const BarSink&);
extern template void pair_voxels(const CubicalImage&, const Zp&, const BarRequest&,
                                 const RunContext&, const BarSink&);

}  // namespace ph::cubical
