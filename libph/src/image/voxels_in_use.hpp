// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Keeps the pages of an image file in memory while voxels are read in random order. The budget
/// counts these pages. The destructor allows them to leave the memory.
class VoxelsInUse {
 public:
  /// @param image the image; the data that it points to must outlive this object. @throws Error
  /// (resource) if the pages exceed the memory limit.
  VoxelsInUse(const CubicalImage& image, const RunContext& context)
      : voxels_(image.voxels),
        claim_(context.memory, image.is_in_file ? image.size() * bytes_of(image.type) : 0) {}
  ~VoxelsInUse() {
    if (claim_.bytes() > 0) forget_file_pages(voxels_, claim_.bytes());
  }
  VoxelsInUse(const VoxelsInUse&) = delete;
  VoxelsInUse& operator=(const VoxelsInUse&) = delete;

 private:
  const void* voxels_;
  MemoryClaim claim_;
};

}  // namespace ph
