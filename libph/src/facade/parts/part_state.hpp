// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/cubical/graphs/two_graphs.hpp"
#include "libph/src/cubical/rounds/part_layout.hpp"
#include "libph/src/cubical/rounds/part_stars.hpp"
#include "libph/src/cubical/sinks/pair_sink.hpp"
#include "libph/src/cubical/slabs/free_cells.hpp"
#include "libph/src/cubical/slabs/layer_pairs.hpp"
#include "libph/src/image/voxels_in_use.hpp"
#include "ph/detail/facade/describe.hpp"
#include "ph/parts/image_part.hpp"

namespace ph {

namespace cubical {

/// Data that all parts of an image share.
struct WholeImage {
  std::vector<Index> extents;
  std::vector<bool> periodic;
  VoxelType type;
  bool voxels_are_vertices, superlevel;
  double limit;
  int parts, min_dim, max_dim;
  bool cells;
  bool loops;  ///< true if some wanted bars come from neither graph
  /// The first layers of the parts; empty if parts have equal size.
  std::vector<Index> first_layers = {};

  friend bool operator==(const WholeImage&, const WholeImage&) = default;
  /// The image without its voxels.
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
  /// The origin of its bars.
  BarcodeInfo info() const {
    BarcodeInfo info =
        detail::info_of_task({.min_dim = min_dim},
                             std::min(max_dim, static_cast<int>(extents.size())), Engine::gradient);
    detail::describe(image(), info);
    return info;
  }
  BarRequest wanted() const { return {min_dim, max_dim, cells}; }
  ImagePartOptions options() const {
    using Construction = CubicalOptions::Construction;
    ImagePartOptions options{.min_dim = min_dim,
                             .max_dim = max_dim,
                             .cells = cells,
                             .loops = loops,
                             .first_layers = first_layers};
    options.cubical.construction =
        voxels_are_vertices ? Construction::vertices : Construction::cells;
    options.cubical.superlevel = superlevel;
    options.cubical.periodic = periodic;
    if (limit < std::numeric_limits<double>::max()) options.cubical.threshold = limit;
    return options;
  }
  /// A sink that puts bars of the wanted dimensions into a barcode.
  BarSink sink(Barcode& into) const {
    const auto wants = [this](const Bar& bar) {
      return min_dim <= bar.dim && bar.dim <= max_dim && bar.birth < kInfinity;
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
  /// True if each part has layers of its own and the parts together have all layers.
  bool has_layers(const GridShape& shape) const {
    if (first_layers.empty()) return true;
    // mutant: part-layer-order
    return static_cast<std::uint64_t>(parts) == first_layers.size() && first_layers.front() == 0 &&
           std::ranges::adjacent_find(first_layers, std::greater_equal<>()) == first_layers.end() &&
           static_cast<std::uint64_t>(first_layers.back()) < shape.axis(shape.layer_axis()).extent;
  }
  PartLayout layout(const GridShape& shape) const { return {shape, parts, first_layers}; }
  /// A hash of these data. If images or options differ, their hashes almost certainly differ.
  std::uint64_t hash() const;
};

/// @throws Error (usage) if the options are invalid or the image cannot be cut into such parts;
/// Error (bad_data) if the number of voxels is not the product of the extents.
WholeImage checked_whole(const Image& image, int parts, const ImagePartOptions& options);

/// The data from which the computation of a part's loops starts.
struct OwnLayers {
  OwnLayers(const Cubical& cubical, const PartLayout& layout, int part, const RunContext& context)
      : voxels(cubical),
        in_use(std::make_unique<VoxelsInUse>(voxels.cubical_image(), context)),
        stars(voxels.cubical_image(), layout, part, context),
        free(&context.memory) {}

  Cubical voxels;  ///< the voxels of the part and of the layers next to it
  std::unique_ptr<VoxelsInUse> in_use;
  PartStars stars;
  FreeCells free;  ///< the free cells that the part alone determines
};

}  // namespace cubical

struct ImagePart::State {
  State(cubical::WholeImage whole_image, const RunContext& run_context)
      : whole(std::move(whole_image)),
        options(whole.options()),
        context(run_context),
        shape(whole.image()),
        pairs(shape,
              {.vertices = whole.loops || cubical::wants_vertices(shape, whole.wanted()),
               .tops = whole.loops || cubical::wants_top_cells(shape, whole.wanted())},
              run_context),
        freed(&run_context.memory),
        bars(CellKind::grid),
        claim(run_context.memory, 0) {}

  cubical::BarSink sink(Barcode& into) const { return whole.sink(into); }

  cubical::WholeImage whole;
  ImagePartOptions options;
  const RunContext& context;
  cubical::GridShape shape;
  int first = 0, last = 0;
  /// Of the voxels from which the part was computed; 0 if parts were joined.
  std::uint64_t fingerprint = 0;
  cubical::LayerPairs pairs;
  cubical::FreeCells freed;  // free cells found by joins; `own` has the free cells of a part
  // Set only in a part that was not joined with other parts, until ImageLoops takes these data.
  std::optional<cubical::OwnLayers> own;
  Barcode bars;  // the bars are not sorted yet
  MemoryClaim claim;
};

}  // namespace ph
