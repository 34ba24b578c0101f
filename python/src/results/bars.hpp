// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ph/detail/core/loop.hpp"
#include "ph/persistence.hpp"

namespace ph::python {

/// What was found out on the way to a barcode.
struct Facts {
  std::string engine;
  int max_dim = 0;
  bool collapses = false;           ///< whether edges were collapsed
  std::optional<double> threshold;  ///< that the values obey
  std::optional<Index> vertices;    ///< of a Rips complex
  std::optional<std::size_t> edges;
  std::optional<double> covering_radius;  ///< of a subsample
  std::vector<Index> hidden = {};         ///< points that have no part in an alpha complex
};

/// A barcode with what belongs to it.
struct Bars {
  Barcode barcode;
  std::vector<BarLoops> loops = {};  ///< by bar; empty: they were not asked for
  Facts facts = {};
  std::int64_t field = 2;

  /// The bars of a dimension: from place `first` on, `count` of them.
  struct Range {
    std::size_t first, count;
  };
  Range range_of(int dim) const;
};

}  // namespace ph::python
