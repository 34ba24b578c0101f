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

/// What represents a bar: a chain, or a set of voxels.
struct RepresentedBar {
  std::span<const Index> numbers;  ///< of the cells of the chain, one after another
  std::span<const std::int64_t> coefficients;
  VoxelRange voxels;                                ///< of what was stored
  std::span<const Index> birth_voxel, death_voxel;  ///< coordinates; none for a death that never is
};

/// Receives bars and what represents them, from one thread.
struct RepresentativeSink {
  /// A bar with its cells, in doubled grid coordinates of the input. @return whether it is kept.
  std::function<bool(const Bar& bar, std::span<const Index> birth, std::span<const Index> death)>
      add;
  /// What represents the bar kept last.
  std::function<void(const RepresentedBar&)> represent;
  /// Keeps places of voxels. @return where they begin among all that are kept.
  std::function<std::size_t(std::span<const std::uint32_t>)> store;
};

/// Whether `represent_voxels` can: if at most three axes have more than one voxel (T: or are not
/// periodic), and there are fewer than about 2^31 voxels, and not none.
bool can_represent_voxels(const CubicalImage& grid);

/// The bars that `pair_voxels` gives, each with a cycle or, if `kind` is voxels, those of H0 and of
/// the highest dimension less one with a set of voxels. Precondition: it can, and kind is
/// cycles or voxels.
/// Time: three to five times that of `pair_voxels`. Memory: 20 bytes a voxel, what critical cells
/// take, and what is put out. Not in slabs: the image must fit.
template <Field K>
void represent_voxels(const CubicalImage& grid, const K& field, int max_dim, Representatives kind,
                      const RunContext& context, const RepresentativeSink& sink);

extern template void represent_voxels(const CubicalImage&, const Z2&, int, Representatives,
                                      const RunContext&, const RepresentativeSink&);
extern template void represent_voxels(const CubicalImage&, const Zp&, int, Representatives,
                                      const RunContext&, const RepresentativeSink&);

}  // namespace ph::cubical
