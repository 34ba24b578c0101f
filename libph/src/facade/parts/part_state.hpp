// SPDX-License-Identifier: MIT
#pragma once
#include <limits>
#include <memory>
#include <vector>

#include "cubical/graphs/two_graphs.hpp"
#include "cubical/pair_sink.hpp"
#include "cubical/slabs/layer_pairs.hpp"
#include "ph/parts/image_part.hpp"

namespace ph {

namespace cubical {

/// What all parts of an image have in common.
struct WholeImage {
  std::vector<Index> extents;
  std::vector<bool> periodic;
  VoxelType type;
  bool voxels_are_vertices, superlevel;
  double limit;
  int parts, min_dim, max_dim;
  bool cells;

  friend bool operator==(const WholeImage&, const WholeImage&) = default;
  /// Without voxels.
  CubicalImage image() const {
    CubicalImage image;
    image.extents = extents;
    image.periodic = periodic;
    image.type = type;
    image.voxels_are_vertices = voxels_are_vertices;
    image.superlevel = superlevel;
    image.limit = limit;
    return image;
  }
  BarRequest wanted() const { return {min_dim, max_dim, cells}; }
  ImagePartOptions options() const {
    using Construction = CubicalOptions::Construction;
    ImagePartOptions options{.min_dim = min_dim, .max_dim = max_dim, .cells = cells};
    options.cubical.construction =
        voxels_are_vertices ? Construction::vertices : Construction::cells;
    options.cubical.superlevel = superlevel;
    options.cubical.periodic = periodic;
    if (limit < std::numeric_limits<double>::max()) options.cubical.threshold = limit;
    return options;
  }
};

}  // namespace cubical

struct ImagePart::State {
  State(cubical::WholeImage whole_image, const RunContext& run_context)
      : whole(std::move(whole_image)),
        options(whole.options()),
        context(run_context),
        shape(whole.image()),
        pairs(shape,
              {.vertices = cubical::wants_vertices(shape, whole.wanted()),
               .tops = cubical::wants_top_cells(shape, whole.wanted())},
              run_context),
        bars(CellKind::grid),
        claim(run_context.memory, 0) {}

  /// Puts bars of the dimensions wanted into a barcode.
  cubical::BarSink sink(Barcode& into) const {
    const auto wants = [this](const Bar& bar) {
      return whole.min_dim <= bar.dim && bar.dim <= whole.max_dim && bar.birth < kInfinity;
    };
    return {
        [&into, wants](const Bar& bar, std::span<const Index> birth, std::span<const Index> death) {
          if (wants(bar)) into.add(bar, birth, death);
        },
        [&into, wants](std::span<const Bar> some) {
          for (const Bar& bar : some)
            if (wants(bar)) into.add(bar);
        },
        [](std::size_t) {}};
  }

  cubical::WholeImage whole;
  ImagePartOptions options;
  const RunContext& context;
  cubical::GridShape shape;
  int first = 0, last = 0;
  cubical::LayerPairs pairs;
  Barcode bars;  // in no order yet
  MemoryClaim claim;
};

}  // namespace ph
