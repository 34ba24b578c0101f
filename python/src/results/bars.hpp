// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ph/detail/core/loop.hpp"
#include "ph/persistence.hpp"

namespace ph::python {

/// The facts found during the computation of a barcode.
struct Facts {
  std::string engine;
  int max_dim = 0;
  bool collapses = false;           ///< true if edges were collapsed
  std::optional<double> threshold;  ///< the threshold of the values
  std::optional<Index> vertices;    ///< the number of vertices of a Rips complex
  std::optional<std::size_t> edges;
  /// The covering radius of a subsample.
  std::optional<double> covering_radius;
  std::vector<Index> hidden = {};  ///< points that are not part of an alpha complex
};

/// A barcode with the data of its bars.
struct Bars {
  Barcode barcode;
  /// The loops of each bar; empty if they are not requested.
  std::vector<BarLoops> loops = {};
  Facts facts = {};
  std::int64_t field = 2;
  /// The p-value of each bar, NaN if a bar has none; empty unless they come from a file.
  std::vector<double> p_values = {};

  /// The bars of a dimension, which are `count` bars from index `first` on.
  struct Range {
    std::size_t first, count;
  };
  Range range_of(int dim) const;
};

}  // namespace ph::python
