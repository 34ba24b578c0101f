// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "libph/src/cubical/grid/grid_shape.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// Describes which layers of a grid each part of the grid has. Unless the first layers of the parts
/// are given, part p has the layers from n · p / parts up to n · (p + 1) / parts of the n layers
/// along the slowest axis of the input. The functions of this class count layers and voxels as in
/// the stars' grid (GridFrame), that is, from the other end in the T-construction.
class PartLayout {
 public:
  /// Consecutive layers.
  struct Layers {
    std::uint64_t begin, end;
    std::uint64_t count() const { return end - begin; }
  };

  /// Precondition: 0 < parts <= layers of the slowest axis.
  /// @param first_layers empty, or the first layers of the parts, ascending from 0.
  PartLayout(const GridShape& grid, int parts, const std::vector<Index>& first_layers = {})
      : layers_(grid.axis(grid.layer_axis()).extent),
        layer_size_(grid.axis(grid.layer_axis()).stride),
        parts_(static_cast<std::uint64_t>(parts)),
        first_layers_(first_layers.begin(), first_layers.end()),
        is_ring_(grid.axis(grid.layer_axis()).periodic),
        from_end_(grid.is_t_construction()) {}

  int parts() const { return static_cast<int>(parts_); }
  std::uint64_t layer_size() const { return layer_size_; }
  /// The number of voxels of the entire grid.
  std::uint64_t size() const { return layers_ * layer_size_; }
  Layers own(int part) const {
    const auto cut = [&](std::uint64_t i) {
      if (i == parts_) return layers_;
      return first_layers_.empty() ? layers_ * i / parts_ : first_layers_[i];
    };
    const auto i = static_cast<std::uint64_t>(part);
    return turned({cut(i), cut(i + 1)});
  }
  /// The part that contains a layer.
  int part_of(std::uint64_t layer) const {
    const std::uint64_t of_input = from_end_ ? layers_ - 1 - layer : layer;
    if (first_layers_.empty()) return static_cast<int>(((of_input + 1) * parts_ - 1) / layers_);
    // mutant: part-first-layer
    return static_cast<int>(std::ranges::upper_bound(first_layers_, of_input) -
                            first_layers_.begin()) -
           1;
  }
  /// Converts layers of the stars' grid to layers of the input, and vice versa.
  Layers turned(const Layers& layers) const {
    return from_end_ ? Layers{layers_ - layers.end, layers_ - layers.begin} : layers;
  }

  SlabPlace place(int part) const {
    SlabPlace place;
    place.is_first = own(part).begin == 0;
    place.is_last = own(part).end == layers_;
    place.is_in_ring = is_ring_;
    return place;
  }
  /// The first voxel of a part, including ghosts (modulo 2^64).
  std::uint64_t first_voxel(int part) const {
    return (own(part).begin - (place(part).has_ghost_before() ? 1 : 0)) * layer_size_;
  }
  /// The layers that are ghosts of a part. In a ring of two layers, both ghosts may be the same
  /// layer.
  std::vector<std::uint64_t> ghosts(int part) const {
    std::vector<std::uint64_t> layers;
    if (place(part).has_ghost_before()) layers.push_back((own(part).begin + layers_ - 1) % layers_);
    if (place(part).has_ghost_after()) layers.push_back(own(part).end % layers_);
    return layers;
  }

 private:
  std::uint64_t layers_, layer_size_, parts_;
  std::vector<std::uint64_t> first_layers_;
  bool is_ring_, from_end_;
};

}  // namespace ph::cubical
