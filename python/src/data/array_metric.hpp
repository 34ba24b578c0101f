// SPDX-License-Identifier: MIT
#pragma once
// Distances that lie in an array of Python's: a metric that reads them there.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "ph/filtration.hpp"
#include "ph/io/read.hpp"
#include "ph/run_context.hpp"

namespace ph::python {

/// Where the distances lie, and what they may be.
struct DistanceArray {
  const char* data = nullptr;
  Index points = 0;
  std::ptrdiff_t row_stride = 0, column_stride = 0;  ///< bytes; of the only axis: column_stride
  /// The upper triangle row by row, as SciPy's pdist gives it; else all of a square matrix.
  bool is_condensed = false;
  Symmetrise symmetrise = Symmetrise::none;  ///< of a square matrix
  NanPolicy nan = NanPolicy::error;          ///< drop: such a pair is never joined
  bool has_zero_diagonal = true;             ///< else what stands there is not looked at
  bool has_nan_option = true;                ///< false: messages do not advise it

  /// Where the pair i < j stands in the condensed form.
  Index condensed_place(Index i, Index j) const { return i * (2 * points - i - 1) / 2 + j - i - 1; }
};

/// A metric, once `check_distances` has passed.
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
  /// NaN is never joined; what is negative is so for rounding.
  static double distance(double number) {
    if (std::isnan(number)) return std::numeric_limits<double>::infinity();
    return number > 0 ? number : 0;
  }

  DistanceArray array_;
};

/// Looks at all numbers once. As the readers of ph::io, it takes for rounding what is below 1e-6 of
/// the largest distance: a negative one, a difference of the two numbers of a pair, a diagonal.
/// @throws Error (bad_data) that names row and column, Error (cancelled).
template <class Number>
void check_distances(const DistanceArray& array, const RunContext& context);

}  // namespace ph::python
