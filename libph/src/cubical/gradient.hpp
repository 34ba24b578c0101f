// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/cubical/representatives/represent_voxels.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/detail/cubical/pair_voxels.hpp"

namespace ph {

/// Computes the bars of images in all dimensions, except bars of length zero. Cells are first
/// paired voxel by voxel. The remaining cells are paired by union-find in the lowest and the
/// highest dimension, and by reduction between these dimensions. With three axes, the reduction can
/// handle at most about 2^31 voxels; with more axes, it can handle at most about 2^32 cells. If no
/// reduction is needed, images may have any size. (Axes with one voxel do not count.) For up to
/// three axes, the engine gives cycles or sets of voxels, but no cocycles. See
/// docs/explanation/engines/discrete-gradient.md.
struct GradientEngine {
  static constexpr Engine id = Engine::gradient;
  template <Filtration F>
  static bool can_run(const F& f, const Task& task) {
    if constexpr (VoxelFiltration<F>) {
      if (task.zero_length || task.representatives == Representatives::cocycles) return false;
      if (task.representatives == Representatives::none)
        return cubical::can_pair_voxels(f.cubical_image(), task.max_dim);
      return cubical::can_represent_voxels(f.cubical_image());
    } else {
      return false;
    }
  }
  template <Filtration F>
  static Suitability suitability(const F&, const Task&) {
    return {6, "an image is paired voxel by voxel"};
  }
  static constexpr int listed_dim(int) { return -1; }

  template <Filtration F, Field K>
  static void run(const F& f, const K& field, BarcodeBuilder<F>& bars, const RunContext& context) {
    if constexpr (VoxelFiltration<F>) {
      if (bars.representatives() != Representatives::none)
        return represent(f, field, bars, context);
      const cubical::BarSink sink{
          [&](const Bar& bar, std::span<const Index> birth, std::span<const Index> death) {
            bars.add_bar(bar, birth, death);
          },
          [&](std::span<const Bar> some) { bars.add_bars(some); },
          [&](std::size_t count) { bars.expect(count); }};
      const cubical::BarRequest wanted{bars.min_dim(), bars.max_dim(), bars.wants_cells()};
      cubical::pair_voxels(f.cubical_image(), field, wanted, context, sink);
    }
  }

 private:
  template <Filtration F, Field K>
  static void represent(const F& f, const K& field, BarcodeBuilder<F>& bars,
                        const RunContext& context) {
    const auto kept = [&](std::span<const Index> cell) {
      return bars.wants_cells() ? cell : std::span<const Index>();
    };
    const cubical::RepresentativeSink sink{
        [&](const Bar& bar, std::span<const Index> birth, std::span<const Index> death) {
          return bars.add_bar(bar, kept(birth), kept(death));
        },
        [&](const cubical::RepresentedBar& bar) {
          bars.add_representative(bar.numbers, bar.coefficients);
          bars.add_voxels(bar.voxels, bar.birth_voxel, bar.death_voxel);
        },
        [&](std::span<const std::uint32_t> places) { return bars.store_voxels(places); }};
    cubical::represent_voxels(f.cubical_image(), field, bars.max_dim(), bars.representatives(),
                              context, sink);
  }
};

}  // namespace ph
