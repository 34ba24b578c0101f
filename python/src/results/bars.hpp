// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "ph/detail/core/loop.hpp"
#include "ph/persistence.hpp"
#include "ph/points.hpp"

namespace ph::python {

/// A barcode with the data of its bars.
struct Bars {
  Barcode barcode;
  /// The loops of each bar; empty if they are not requested.
  std::vector<BarLoops> loops = {};
  std::int64_t field = 2;
  /// The p-value of each bar, NaN if a bar has none; empty unless they come from a file.
  std::vector<double> p_values = {};
  /// The place of each bar, one row per bar; empty unless bars of points have cycles.
  Points centroids = {};

  /// The bars of a dimension, which are `count` bars from index `first` on.
  struct Range {
    std::size_t first, count;
  };
  Range range_of(int dim) const;
  /// States the highest dimension that was asked for, above which a complex may have no cells.
  void set_max_dim(int max_dim);
};

}  // namespace ph::python
