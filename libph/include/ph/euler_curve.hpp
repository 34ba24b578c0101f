// SPDX-License-Identifier: MIT
/// Euler characteristic curves, from bars and directly from images.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "ph/run_context.hpp"
#include "ph/vectorise.hpp"

namespace ph {

/// An integer-valued step function: 0 before at[0], then value[i] on the interval [at[i], at[i +
/// 1]).
struct StepFunction {
  std::vector<double> at;           ///< ascending, each once; the first may be -infinity
  std::vector<std::int64_t> value;  ///< one per place; each differs from the one before

  /// @throws Error (usage) if the numbers of values and places differ.
  std::int64_t operator()(double t) const;
  /// Writes the values at the places of a grid. @param out has grid.points numbers. @throws Error
  /// (usage) as the operator, and as betti_curve.
  void sample(const Grid& grid, std::span<double> out) const;
  friend bool operator==(const StepFunction&, const StepFunction&) = default;
};

/// The Euler characteristic curve of a barcode: Σ (-1)^dimension over the bars alive at t, birth <=
/// t < death. It is the curve of the complex if the barcode has all dimensions of the complex and
/// all bars that never die: `threshold`, `max_dim` and `min_persistence` must not have cut off any
/// bar. O(n log n).
/// @throws Error (bad_data) on a NaN, or a death before its birth.
StepFunction euler_curve(std::span<const Bar> bars);

/// The Euler characteristic curve of an image: the number of cells of even dimension at t, minus
/// the number of cells of odd dimension. Supports all options of Cubical, but lists no cells and
/// computes no bars. The curve equals the curve of the barcode.
///
/// Each voxel counts the cells whose value it decides: for each of the 3^d - 1 directions in which
/// a cell may lie, the voxel is compared with a neighbour, many voxels of a row at a time. Each
/// thread holds only three layers along the first axis in memory. Bytes, and 16-bit numbers of
/// images of at least 2^15 voxels, go into one histogram; otherwise, the voxels at which the curve
/// may change are sorted. Threads share the layers; the result does not depend on the number of
/// threads. Source: Heiss, Wagner, Streaming
/// algorithm for Euler characteristic curves of multidimensional images, 2017 (a voxel counts the
/// cells that enter with it). O(voxels · 3^d) time and O(changes) memory.
/// @throws Error (resource, cancelled).
StepFunction euler_curve(const Cubical& image, const RunContext& context = default_context());

/// The curve at the values of a grid, in O(grid.points) memory for any type of voxel.
/// @param out grid.points numbers.
/// @throws Error (usage) as betti_curve; Error (resource, cancelled).
void euler_curve(const Cubical& image, const Grid& grid, std::span<double> out,
                 const RunContext& context = default_context());

}  // namespace ph
