// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>

#include "libph/src/cubical/grid/grid_frame.hpp"
#include "libph/src/cubical/grid/grid_shape.hpp"
#include "libph/src/cubical/slabs/free_cells.hpp"
#include "ph/detail/image/cubical_image.hpp"

namespace ph::cubical {

/// An image of any size, or a part of an image, as layers along its slowest axis. Layers are
/// counted as in the stars' grid (GridFrame), which counts from the other end in the
/// T-construction. Voxel numbers have 64 bits here, but 32 bits in a GridFrame of some of the
/// layers.
class LayeredImage {
 public:
  /// True if a GridFrame can hold three layers: a layer and the ghosts on both sides.
  static bool can_cut(const CubicalImage& image) {
    const int axes = GridShape::count_axes(image);
    if (axes < 1 || axes > GridShape::kMostAxes || image.size() == 0) return false;
    if (image.size() > GridCell::kMostVoxels) return false;
    return GridFrame::can_hold(LayeredImage(image).layers_of(image.voxels, 3));
  }
  /// Precondition: GridShape keeps at least one axis of the image, and at most
  /// GridShape::kMostAxes.
  explicit LayeredImage(const CubicalImage& image) : image_(image), shape_(image) {}

  const GridShape& shape() const { return shape_; }
  /// The number of layers.
  std::uint64_t extent() const { return layer_axis().extent; }
  std::uint64_t layer_size() const { return layer_axis().stride; }
  /// The number of voxels.
  std::uint64_t size() const { return extent() * layer_size(); }
  /// True if the first layer and the last layer are neighbours.
  bool is_ring() const { return layer_axis().periodic; }

  const CubicalImage& all() const { return image_; }
  /// The image that consists of the layers from `begin` up to `end`. Its slowest axis is not
  /// periodic.
  CubicalImage layers(std::uint64_t begin, std::uint64_t end) const {
    const std::uint64_t first = shape_.is_t_construction() ? extent() - end : begin;
    return layers_of(
        static_cast<const std::byte*>(image_.voxels) + first * layer_size() * bytes_of(image_.type),
        end - begin);
  }
  /// An image of `count` layers whose voxels are stored elsewhere, in the order of this image.
  CubicalImage layers_of(const void* voxels, std::uint64_t count) const {
    const auto axis = static_cast<std::size_t>(layer_axis().of_input);
    CubicalImage image = image_;
    image.extents[axis] = static_cast<Index>(count);
    image.periodic[axis] = false;
    image.voxels = voxels;
    return image;
  }

 private:
  const GridShape::Axis& layer_axis() const { return shape_.axis(shape_.layer_axis()); }

  CubicalImage image_;
  GridShape shape_;
};

}  // namespace ph::cubical
