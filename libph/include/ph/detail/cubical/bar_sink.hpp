// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>

#include "ph/barcode.hpp"

namespace ph::cubical {

/// Receives bars from one thread at a time, though not always the same thread.
struct BarSink {
  /// Adds one bar with its cells, in doubled grid coordinates of the input.
  std::function<void(const Bar& bar, std::span<const Index> birth, std::span<const Index> death)>
      add;
  /// Adds several bars without cells; used if cells are not wanted.
  std::function<void(std::span<const Bar> bars)> add_all;
  /// Announces that about `count` bars may come next.
  std::function<void(std::size_t count)> expect;
};

/// The bars that are wanted; a sink may receive other bars as well.
struct BarRequest {
  int min_dim = 0, max_dim = 0;
  bool cells = true;  ///< if false, bars have no cells
};

}  // namespace ph::cubical
