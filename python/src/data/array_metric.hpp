// SPDX-License-Identifier: MIT
#pragma once
// This header declares a metric that reads its distances in place from a Python array.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "ph/filtration.hpp"
#include "ph/io/read.hpp"
#include "ph/run_context.hpp"

namespace ph::python {

/// The layout of the distances, and the values that they may have.
struct DistanceArray {
  const char* data = nullptr;
  Index points = 0;
  /// In bytes; an array with a single axis uses column_stride.
  std::ptrdiff_t row_stride = 0, column_stride = 0;
  /// True if the array is the upper triangle row by row, as SciPy's pdist returns it. Otherwise it
  /// is the whole square matrix.
  bool is_condensed = false;
  Symmetrise symmetrise = Symmetrise::none;  ///< used for a square matrix
  /// With `drop`, a pair with NaN is never joined.
  NanPolicy nan = NanPolicy::error;
  /// If false, the values on the diagonal are ignored.
  bool has_zero_diagonal = true;
  /// If false, messages do not suggest the option.
  bool has_nan_option = true;

  /// The index of the pair i < j in the condensed form.
  Index condensed_place(Index i, Index j) const { return i * (2 * points - i - 1) / 2 + j - i - 1; }
};

/// Reads distances from an array. This class is a metric if `check_distances` has accepted the
/// array.
template <class Number>
class ArrayMetric {
 public:
  explicit ArrayMetric(const DistanceArray& array) : array_(array) {}

  Index size() const { return array_.points; }
  double operator()(Index i, Index j) const {
    if (i == j) return 0;
    if (i < j) std::swap(i, j);
    if (array_.is_condensed) return distance(condensed(j, i));
    const double lower = distance(entry(i, j));
    switch (array_.symmetrise) {
      case Symmetrise::max:
        return std::max(distance(entry(j, i)), lower);
      case Symmetrise::min:
        return std::min(distance(entry(j, i)), lower);
      default:
        return lower;
    }
  }

  /// The number in a row and column of a square matrix.
  double entry(Index i, Index j) const {
    return at(i * array_.row_stride + j * array_.column_stride);
  }
  /// The number of the pair i < j in the condensed form.
  double condensed(Index i, Index j) const {
    return at(array_.condensed_place(i, j) * array_.column_stride);
  }

 private:
  double at(std::ptrdiff_t byte) const {
    return static_cast<double>(*reinterpret_cast<const Number*>(array_.data + byte));
  }
  /// A pair with NaN is never joined. A negative number is a rounding error.
  static double distance(double number) {
    if (std::isnan(number)) return std::numeric_limits<double>::infinity();
    return number > 0 ? number : 0;
  }

  DistanceArray array_;
};

/// Checks all numbers once. Like the readers of ph::io, it treats deviations below 1e-6 of the
/// largest distance as rounding. Deviations are negative numbers, differences between the two
/// numbers of a pair, and numbers on the diagonal other than 0.
/// @throws Error (bad_data), which names row and column; Error (cancelled).
template <class Number>
void check_distances(const DistanceArray& array, const RunContext& context);

}  // namespace ph::python
