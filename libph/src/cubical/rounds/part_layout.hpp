// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include "cubical/stars/grid_shape.hpp"
#include "cubical/stars/star_grid.hpp"

namespace ph::cubical {

/// Which layers of a grid each of its parts has: n · p / parts up to n · (p + 1) / parts of the n
/// of the slowest axis, as the input counts them. The stars' grid of the T-construction counts from
/// the other end.
class PartLayout {
 public:
  /// Precondition: 0 < parts <= layers of the slowest axis.
  PartLayout(const GridShape& grid, int parts)
      : layers_(grid.axis(grid.layer_axis()).extent),
        layer_size_(grid.axis(grid.layer_axis()).stride),
        parts_(static_cast<std::uint64_t>(parts)),
        is_ring_(grid.axis(grid.layer_axis()).periodic),
        from_end_(grid.is_t_construction()) {}

  int parts() const { return static_cast<int>(parts_); }
  bool is_ring() const { return is_ring_; }
  std::uint64_t layer_size() const { return layer_size_; }
  /// Voxels of the whole grid.
  std::uint64_t size() const { return layers_ * layer_size_; }
  /// In the input.
  std::uint64_t first_layer(int part) const {
    return layers_ * static_cast<std::uint64_t>(part) / parts_;
  }
  std::uint64_t end_layer(int part) const { return first_layer(part + 1); }

  // From here on as the stars' grid counts.

  SlabPlace place(int part) const {
    SlabPlace place;
    place.is_first = part == (from_end_ ? parts() - 1 : 0);
    place.is_last = part == (from_end_ ? 0 : parts() - 1);
    place.is_in_ring = is_ring_;
    return place;
  }
  std::uint64_t first_voxel(int part) const {
    return (from_end_ ? layers_ - end_layer(part) : first_layer(part)) * layer_size_;
  }
  std::uint64_t end_voxel(int part) const {
    return first_voxel(part) + (end_layer(part) - first_layer(part)) * layer_size_;
  }
  /// The first voxel of a part with its ghosts (modulo 2^64).
  std::uint64_t first_with_ghosts(int part) const {
    return first_voxel(part) - (place(part).has_ghost_before() ? layer_size_ : 0);
  }
  /// The part that has a voxel. Precondition: it is below size().
  int part_of(std::uint64_t voxel) const {
    const std::uint64_t layer = voxel / layer_size_;
    const std::uint64_t of_input = from_end_ ? layers_ - 1 - layer : layer;
    return static_cast<int>(((of_input + 1) * parts_ - 1) / layers_);
  }
  /// The part right before or after another one; in a ring it may be the same. Precondition: there
  /// is one.
  int beside(int part, bool after) const {
    const int step = after != from_end_ ? 1 : parts() - 1;
    return (part + step) % parts();
  }

 private:
  std::uint64_t layers_, layer_size_, parts_;
  bool is_ring_, from_end_;
};

}  // namespace ph::cubical
