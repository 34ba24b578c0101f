// SPDX-License-Identifier: MIT
#include "libph/src/cubical/grid/grid_shape.hpp"

namespace ph::cubical {

int GridShape::count_axes(const CubicalImage& image) {
  int count = 0;
  for (std::size_t k = 0; k < image.extents.size(); ++k) count += keeps_axis(image, k) ? 1 : 0;
  return count;
}

GridShape::GridShape(const CubicalImage& image)
    : input_axes_(image.extents.size()), is_t_construction_(!image.voxels_are_vertices) {
  auto axis = static_cast<std::size_t>(std::max(count_axes(image), 3));
  std::uint64_t stride = 1;
  for (std::size_t k = input_axes_; k-- > 0;) {
    if (!keeps_axis(image, k)) {
      if (image.periodic[k]) loops_.push_back(k);
      continue;
    }
    const auto extent = static_cast<std::uint64_t>(image.extents[k]);
    axes_[--axis] = {extent, stride, true, image.periodic[k], static_cast<int>(k)};
    stride *= extent;
    ++top_dim_;
  }
}

void GridShape::append_numbers(std::uint64_t voxel, std::span<const int> direction, unsigned loops,
                               std::vector<Index>& numbers) const {
  const std::size_t base = numbers.size();
  numbers.resize(base + input_axes_, 0);
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    const Axis& axis = axes_[a];
    if (!axis.exists) continue;
    const auto n = static_cast<Index>(axis.extent);
    const auto place = static_cast<Index>(voxel / axis.stride % axis.extent);
    Index x = 2 * place + (a < direction.size() ? direction[a] : 0);
    if (x < 0 && axis.periodic) x = 2 * n - 1;
    numbers[base + static_cast<std::size_t>(axis.of_input)] =
        is_t_construction_ ? 2 * n - 1 - x : x;
  }
  for (std::size_t i = 0; i < loops_.size(); ++i)
    numbers[base + loops_[i]] = static_cast<Index>(loops >> i & 1U);
}

}  // namespace ph::cubical
