// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "ph/core/filtration.hpp"

namespace ph {

/// A dense array of any dimension: `extents[k]` voxels along axis k, the last axis fastest (C
/// order). The axes are those of the input file.
struct Image {
  std::vector<Index> extents;
  std::vector<double> values;

  int dim() const { return static_cast<int>(extents.size()); }
};

}  // namespace ph
