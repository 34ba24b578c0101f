// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory_resource>
#include <vector>

#include "libph/src/vectors/euler/layers.hpp"
#include "libph/src/vectors/euler/mask_rows.hpp"

namespace ph::vectors {

/// The change of the Euler characteristic at each voxel of a row.
///
/// V-construction: a voxel decides the values of the cells whose last vertex it is. Each of these
/// cells extends from the voxel in one of 3^d - 1 directions. A direction has the component -1, 0
/// or 1 along each axis. The other vertices of the cell are in the directions that have some of
/// these components set to 0. The voxel therefore decides a cell if the neighbour in the cell's
/// direction precedes the voxel and if the voxel decides the facets of the cell that contain the
/// voxel. If vertices are equal, the vertex in the larger direction counts as last. Each cell is
/// therefore decided once, even if an axis is periodic and has only one or two voxels.
///
/// T-construction: the same rule applies to the faces between top cubes. A voxel decides the face
/// in a direction if all other cubes around the face come later or do not exist. The dimension of
/// the face is d minus the number of non-zero components of the direction.
class DecidedCells {
 public:
  static constexpr std::size_t kBlock = 512;

  DecidedCells(const Layered& image, std::pmr::memory_resource* memory)
      : axes_(image.axes()),
        length_(image.row_length()),
        is_circle_(image.periodic.back()),
        outside_(image.image.voxels_are_vertices ? 0 : 0xFF),
        has_own_(axes_ % 2 == 0 || image.image.voxels_are_vertices),
        masks_(memory) {
    std::size_t count = 1;
    for (std::size_t k = 0; k < axes_; ++k) count *= 3;
    directions_.resize(count);
    for (std::size_t number = 1; number < count; ++number) {
      Direction& direction = directions_[number];
      std::size_t steps = 0, power = 1;
      for (std::size_t rest = number; rest > 0; rest /= 3, power *= 3) {
        const std::size_t digit = rest % 3;  // 0 means no step, 1 down, 2 up
        if (digit == 0) continue;
        direction.is_down = digit == 1;  // the first axis along which the direction leads decides
        direction.facets.push_back(number - digit * power);
        ++steps;
      }
      direction.adds = (steps + (has_own_ ? 0 : 1)) % 2 == 0;
    }
    masks_.resize(count * kBlock);
    std::fill_n(masks_.data(), kBlock, Mask{0xFF});  // an unused direction imposes no condition
  }

  /// @param rows 3^(d-1) rows of keys, indexed by direction. The first row is the row of the voxels
  /// themselves. Missing rows are null.
  /// @param begin, end a part of the row, at most kBlock long.
  template <class T, class Sum>
  void count(const T* const* rows, std::size_t begin, std::size_t end, Sum* sums) {
    const std::size_t size = end - begin;
    const T* voxels = rows[0] + begin;
    std::fill_n(sums, size, static_cast<Sum>(has_own_ ? 1 : -1));
    for (std::size_t number = 1; number < directions_.size(); ++number) {
      const Direction& direction = directions_[number];
      Mask* masks = masks_of(number);
      if (const T* row = rows[number / 3]) {
        const std::size_t along = number % 3;
        const T* neighbours = row + begin + (along == 2 ? 1 : 0) - (along == 1 ? 1 : 0);
        // mutant: euler-equal
        find_preceding(neighbours, voxels, size, direction.is_down, outside_, masks);
        if (along == 1 && begin == 0 && !is_circle_) masks[0] = outside_;
        // mutant: euler-circle
        if (along == 2 && end == length_ && !is_circle_) masks[size - 1] = outside_;
      } else {
        std::memset(masks, outside_, size);
      }
      const auto& facets = direction.facets;
      for (std::size_t i = 3; i < facets.size(); ++i) {  // mutant: euler-facets
        const Mask* facet = masks_of(facets[i]);
        for (std::size_t x = 0; x < size; ++x) masks[x] &= facet[x];
      }
      count_where_all(masks, masks_of(facets[0]), masks_of(facets.size() > 1 ? facets[1] : 0),
                      masks_of(facets.size() > 2 ? facets[2] : 0), size, direction.adds, sums);
    }
  }

 private:
  struct Direction {
    std::vector<std::size_t> facets;
    bool is_down = false, adds = false;
  };
  Mask* masks_of(std::size_t direction) { return masks_.data() + direction * kBlock; }

  std::size_t axes_, length_;
  bool is_circle_;
  // The mask of a neighbour outside the image. In the V-construction, this neighbour precedes no
  // voxel. In the T-construction, it comes after all voxels.
  Mask outside_;
  bool has_own_;  // true if the cell of the zero direction counts 1, otherwise it counts -1
  std::vector<Direction> directions_;
  RawVector<Mask> masks_;
};

}  // namespace ph::vectors
