// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ph/filtration.hpp"

namespace ph {

/// How the numbers of an image are stored.
enum class VoxelType { uint8, uint16, int16, float32, float64 };

/// Calls `use(pointer)` with a pointer of the type that `type` names.
template <class Use>
decltype(auto) with_voxels(VoxelType type, const void* data, Use&& use) {
  switch (type) {
    case VoxelType::uint8:
      return use(static_cast<const std::uint8_t*>(data));
    case VoxelType::uint16:
      return use(static_cast<const std::uint16_t*>(data));
    case VoxelType::int16:
      return use(static_cast<const std::int16_t*>(data));
    case VoxelType::float32:
      return use(static_cast<const float*>(data));
    default:
      return use(static_cast<const double*>(data));
  }
}

/// Size of a number of a type, in bytes.
inline std::size_t bytes_of(VoxelType type) {
  return with_voxels(type, nullptr, []<class T>(const T*) { return sizeof(T); });
}

/// The cubical filtration of an image, given by the image itself. An engine that works voxel by
/// voxel and never lists cells needs nothing else. The struct points to voxels, which must outlive
/// it. NaN marks an absent voxel.
struct CubicalImage {
  std::vector<Index> extents;  ///< in C order: the last axis is the fastest
  std::vector<bool> periodic;  ///< one per axis
  VoxelType type = VoxelType::float64;
  const void* voxels = nullptr;     ///< null if there are no voxels
  bool is_in_file = false;          ///< see ph/detail/core/file_pages.hpp
  bool voxels_are_vertices = true;  ///< V-construction; otherwise the voxels are top cubes (T)
  bool superlevel = false;          ///< values are the values of -f
  /// Voxels with values above this limit never enter; the limit is below +infinity.
  double limit = std::numeric_limits<double>::max();

  std::size_t size() const {
    std::size_t product = voxels == nullptr ? 0 : 1;
    for (const Index n : extents) product *= static_cast<std::size_t>(n);
    return product;
  }
  /// The value at which a voxel enters; infinity if the voxel is absent.
  double value(std::size_t i) const {
    const double v =
        with_voxels(type, voxels, [i](const auto* all) { return static_cast<double>(all[i]); });
    if (v != v) return std::numeric_limits<double>::infinity();  // mutant: cubical-absent
    return (superlevel ? -v : v) + 0.0;
  }
};

/// Capability: the cubical filtration of an image. Its order is (value, place of the voxel that
/// decides the value, dimension, place of the cell in the doubled grid). Both places are in C
/// order.
template <class F>
concept VoxelFiltration = Filtration<F> && requires(const F& f) {
  { f.cubical_image() } -> std::same_as<CubicalImage>;
};

}  // namespace ph
