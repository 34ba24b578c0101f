// SPDX-License-Identifier: MIT
/// Euler characteristic curves, of bars and straight from images.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "ph/run_context.hpp"
#include "ph/vectorise.hpp"

namespace ph {

/// A function of whole numbers that changes at some values: 0 before at[0], value[i] from at[i] to
/// before at[i + 1].
struct StepFunction {
  std::vector<double> at;           ///< ascending, each once; the first may be -infinity
  std::vector<std::int64_t> value;  ///< as many; each differs from the one before

  /// @throws Error (usage) if there are not as many values as places.
  std::int64_t operator()(double t) const;
  /// @param out grid.points numbers. @throws Error (usage) also as betti_curve.
  void sample(const Grid& grid, std::span<double> out) const;
  friend bool operator==(const StepFunction&, const StepFunction&) = default;
};

/// The Euler characteristic curve of a barcode: Σ (-1)^dimension over the bars that live at t,
/// birth <= t < death. It is that of the complex if the barcode has all dimensions of it, and the
/// bars that never die: none of `threshold`, `max_dim` and `min_persistence` may have cut any off.
/// O(n log n).
/// @throws Error (bad_data) on a NaN, or a death before its birth.
StepFunction euler_curve(std::span<const Bar> bars);

/// The Euler characteristic curve of an image: how many cells of even dimension there are at t,
/// less those of odd dimension. For all options of Cubical, without the cells that it would list,
/// and without bars. Equal to that of the barcode.
///
/// A voxel counts the cells whose value it decides: for each of the 3^d - 1 directions in which a
/// cell may lie it is compared with a neighbour, rows of voxels at a time. Three layers along the
/// first axis are in memory. Bytes and 16-bit numbers go into one histogram; of floats those voxels
/// are sorted at which the curve may change. Threads share layers; the result does not depend on
/// them. Source: Heiss, Wagner, Streaming algorithm for Euler characteristic curves of
/// multidimensional images, 2017 (a voxel counts the cells that enter with it).
/// O(voxels · 3^d), and O(changes) memory.
/// @throws Error (resource, cancelled).
StepFunction euler_curve(const Cubical& image, const RunContext& context = default_context());

/// The same at the values of a grid, in O(grid.points) memory whatever numbers the image has.
/// @param out grid.points numbers.
/// @throws Error (usage) as betti_curve; Error (resource, cancelled).
void euler_curve(const Cubical& image, const Grid& grid, std::span<double> out,
                 const RunContext& context = default_context());

}  // namespace ph
