// SPDX-License-Identifier: MIT
#pragma once
#include "ph/core/barcode.hpp"
#include "ph/cubical/pair_voxels.hpp"
#include "ph/engine/engine.hpp"
#include "ph/engine/twist.hpp"

namespace ph {

/// Images of up to three axes (axes of one voxel not counted), all dimensions: cells are paired
/// voxel by voxel, what is left by union-find and, for H1 of three axes, by reduction. See
/// docs/algorithms.md. Zero-length pairs come from the boundary matrix.
struct ArrowsEngine {
  static constexpr Engine id = Engine::arrows;
  static constexpr const char* name = "arrows";
  template <Filtration F>
  static bool can_run(const F& f, int, Representatives wanted = Representatives::none) {
    if constexpr (VoxelFiltration<F>)
      return wanted == Representatives::none && cubical::can_pair_voxels(f.voxel_grid());
    else
      return false;
  }

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    if constexpr (VoxelFiltration<F>) {
      if (bars.wants_zero_length()) return TwistEngine::run(f, field, bars, context);
      cubical::pair_voxels(f.voxel_grid(), field, bars.max_dim(), context,
                           [&](const Bar& bar, std::span<const Index> birth,
                               std::span<const Index> death) { bars.add_bar(bar, birth, death); });
    }
  }
};

}  // namespace ph
