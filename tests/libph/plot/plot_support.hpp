// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "ph/io/plot.hpp"

namespace ph::test {

inline constexpr std::array kPlotKinds{PlotKind::barcode, PlotKind::diagram, PlotKind::betti};

/// A barcode with these bars and arbitrary cells.
inline Barcode barcode_of(const std::vector<Bar>& bars) {
  Barcode barcode;
  const std::array<Index, 1> cell{0};
  for (const Bar& bar : bars)
    barcode.add(bar, cell, bar.is_infinite() ? std::span<const Index>() : std::span(cell));
  barcode.sort();
  return barcode;
}

/// Barcodes that are hard to draw: empty, with infinite bars, with a single value, or spanning the
/// range of doubles.
inline std::vector<std::vector<Bar>> odd_barcodes() {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  return {
      {},
      {{0, 0, kInfinity}},
      {{0, 5, kInfinity}},
      {{0, -kInfinity, kInfinity}, {0, -kInfinity, 3}, {1, -2, kInfinity}},
      {{0, -huge, huge}, {0, 0, kInfinity}},
      {{0, 0, tiny}, {1, tiny, kInfinity}},
      {{0, 1, 1 + 1e-15}},
      {{0, 1e6, 1e6 + 1e-6}},
      {{60, -3, -2}},
      {{0, 0, 0}},
  };
}

}  // namespace ph::test
