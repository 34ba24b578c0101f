// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>

#include "cubical/stars/grid_shape.hpp"
#include "cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// Which layers of a grid each of its parts has: n · p / parts up to n · (p + 1) / parts of the n
/// of the slowest axis, as the input counts them. The stars' grid of the T-construction counts from
/// the other end: so do all layers and voxels here.
class PartLayout {
 public:
  /// Layers that follow each other.
  struct Layers {
    std::uint64_t begin, end;
    bool contains(std::uint64_t layer) const { return begin <= layer && layer < end; }
    std::uint64_t count() const { return end - begin; }
  };

  /// Precondition: 0 < parts <= layers of the slowest axis, overlap > 0.
  /// @param overlap of how many layers beside its own a part knows the voxels, at most.
  PartLayout(const GridShape& grid, int parts, int overlap)
      : layers_(grid.axis(grid.layer_axis()).extent),
        layer_size_(grid.axis(grid.layer_axis()).stride),
        parts_(static_cast<std::uint64_t>(parts)),
        beside_(static_cast<std::uint64_t>(overlap) - 1),
        is_ring_(grid.axis(grid.layer_axis()).periodic),
        from_end_(grid.is_t_construction()) {}

  int parts() const { return static_cast<int>(parts_); }
  std::uint64_t layer_size() const { return layer_size_; }
  /// Voxels of the whole grid.
  std::uint64_t size() const { return layers_ * layer_size_; }
  Layers own(int part) const {
    const auto cut = [&](int i) { return layers_ * static_cast<std::uint64_t>(i) / parts_; };
    return turned({cut(part), cut(part + 1)});
  }
  /// The part that has a layer.
  int part_of(std::uint64_t layer) const {
    const std::uint64_t of_input = from_end_ ? layers_ - 1 - layer : layer;
    return static_cast<int>(((of_input + 1) * parts_ - 1) / layers_);
  }
  /// Those whose stars a part finds for its loops, without ghosts: they do not go around a ring.
  Layers seen(int part) const {
    const Layers own = this->own(part);
    return {own.begin - std::min(own.begin, beside_), std::min(own.end + beside_, layers_)};
  }
  /// Layers of the stars' grid as the input counts them, and the other way around.
  Layers turned(const Layers& layers) const {
    return from_end_ ? Layers{layers_ - layers.end, layers_ - layers.begin} : layers;
  }

  SlabPlace place(const Layers& layers) const {
    SlabPlace place;
    place.is_first = layers.begin == 0;
    place.is_last = layers.end == layers_;
    place.is_in_ring = is_ring_;
    return place;
  }
  /// The first voxel of layers with their ghosts (modulo 2^64).
  std::uint64_t first_voxel(const Layers& layers) const {
    return (layers.begin - (place(layers).has_ghost_before() ? 1 : 0)) * layer_size_;
  }
  /// Calls `use(layer)` for the layers that a part sees, ghosts included, and does not have; twice
  /// for what it sees on both sides.
  template <class Use>
  void for_each_beside(int part, Use&& use) const {
    const Layers own = this->own(part), seen = this->seen(part);
    const SlabPlace ends = place(seen);
    if (ends.has_ghost_before()) use((seen.begin + layers_ - 1) % layers_);
    for (std::uint64_t layer = seen.begin; layer < seen.end; ++layer)
      if (!own.contains(layer)) use(layer);
    if (ends.has_ghost_after()) use(seen.end % layers_);
  }

 private:
  std::uint64_t layers_, layer_size_, parts_, beside_;
  bool is_ring_, from_end_;
};

}  // namespace ph::cubical
