// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "libph/src/cubical/grid/grid_shape.hpp"
#include "libph/src/cubical/grid/star_tables.hpp"

namespace ph::cubical {

/// A direction in any number of axes, as GridShape counts them.
using WideDirection = std::array<int, GridShape::kMostAxes>;
inline WideDirection widened(const Direction& direction) {
  return {direction[0], direction[1], direction[2]};
}

/// The direction that the number of a cell encodes in a star of more than three axes. As in
/// StarShapes, the number has one base-3 digit for each axis. The lowest digit is for the first
/// axis. The digits mean 0 (no step), 1 (down) and 2 (up).
inline WideDirection direction_of_code(std::uint32_t code, int axes) {
  WideDirection direction{};
  for (int& step : std::span(direction).first(static_cast<std::size_t>(axes))) {
    step = code % 3 == 0 ? 0 : code % 3 == 1 ? -1 : 1;
    code /= 3;
  }
  return direction;
}

/// The direction of a cell of some dimension, given by the number of the cell in a star. Returns
/// nothing if there is no such number. @param axes the number of axes of the grid.
inline std::optional<WideDirection> direction_in_star(int axes, int dim, std::uint32_t number) {
  WideDirection direction{};
  if (dim == 0) return number == 0 ? std::optional(direction) : std::nullopt;
  if (axes > 3) {
    std::uint32_t codes = 1;
    for (int k = 0; k < axes; ++k) codes *= 3;
    if (number >= codes) return std::nullopt;
    direction = direction_of_code(number, axes);
    const auto steps = GridShape::kMostAxes - std::ranges::count(direction, 0);
    return steps == dim ? std::optional(direction) : std::nullopt;
  }
  const auto of = [&](std::span<const Direction> all) -> std::optional<WideDirection> {
    return number < all.size() ? std::optional(widened(all[number])) : std::nullopt;
  };
  return dim == 1 ? of(kEdges) : dim == 2 ? of(kSquares) : of(kCubes);
}

}  // namespace ph::cubical
