// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// For as long as voxels are read in no order: what is read of those in a file is in memory then,
/// and is counted. At its end they leave it.
class VoxelsInUse {
 public:
  /// @param image what it points to outlives this. @throws Error (resource) beyond the limit.
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
