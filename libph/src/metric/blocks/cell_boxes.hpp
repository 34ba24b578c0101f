// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/metric/blocks/sample_tree.hpp"
#include "libph/src/metric/plain_squares.hpp"

namespace ph {

// Distances are compared by their squares. The slack is so large that each conclusion also holds
// for the rounded distances of PointMetric.

inline double squared_distance(const double* x, const double* y, Index axes) {
  double sum = 0;
  for (Index k = 0; k < axes; ++k) sum += (x[k] - y[k]) * (x[k] - y[k]);
  return sum;
}
/// A bound for computed squared distances. If the squared distance computed for two points exceeds
/// this bound, the distance between the points exceeds the root of `square`. A computed sum of
/// squares has a relative error of at most (axes + 2) · 2^-53. Below 1e-280, its error can have any
/// size. The bound need not be tight.
inline double reach_of(double square) {
  constexpr double slack = 1 + 1e-12, least = 4 * kSmallestPlain * kSmallestPlain;
  return std::max(square, least) * slack;
}

/// For each cell, the box around all or some of its points, and the largest distance from these
/// points to the sample point of the cell.
class CellBoxes {
 public:
  /// Makes empty boxes. @param count the number of boxes.
  CellBoxes(std::size_t count, Index axes, const RunContext& context)
      : axes_(axes), sides_(count * box_size(), &context.memory), squares_(count, &context.memory) {
    for (std::size_t i = 0; i < sides_.size(); i += 2) {
      sides_[i] = std::numeric_limits<double>::infinity();
      sides_[i + 1] = -std::numeric_limits<double>::infinity();
    }
  }
  /// Adds a point x to box i. @param square the squared distance from x to the sample.
  void add_point(std::size_t i, const double* x, double square) {
    double* const box = sides_.data() + i * box_size();
    for (Index k = 0; k < axes_; ++k) {
      box[2 * k] = std::min(box[2 * k], x[k]);
      box[2 * k + 1] = std::max(box[2 * k + 1], x[k]);
    }
    squares_[i] = std::max(squares_[i], square);
  }
  void add(std::size_t i, const CellBoxes& others, std::size_t j) {
    double* const box = sides_.data() + i * box_size();
    const double* const other = others.sides_.data() + j * box_size();
    for (Index k = 0; k < axes_; ++k) {
      box[2 * k] = std::min(box[2 * k], other[2 * k]);
      box[2 * k + 1] = std::max(box[2 * k + 1], other[2 * k + 1]);
    }
    squares_[i] = std::max(squares_[i], others.squares_[j]);
  }
  /// The smallest and the largest coordinate of a box, axis by axis. They are infinite if the box
  /// has no points.
  std::span<const double> box(std::size_t i) const {
    return {sides_.data() + i * box_size(), box_size()};
  }
  /// The square of the largest distance from a point of the box to the sample.
  double square(std::size_t i) const { return squares_[i]; }
  /// The square of the gap between box i and the box from `low` to `high`. The coordinates in these
  /// two arrays are `stride` apart. For a point, `low` and `high` are the same.
  double gap(std::size_t i, const double* low, const double* high, Index stride) const {
    const double* const box = sides_.data() + i * box_size();
    double sum = 0;
    for (Index k = 0; k < axes_; ++k) {
      const double gap =
          std::max({box[2 * k] - high[k * stride], low[k * stride] - box[2 * k + 1], 0.0});
      sum += gap * gap;
    }
    return sum;
  }

 private:
  std::size_t box_size() const { return 2 * static_cast<std::size_t>(axes_); }

  Index axes_;
  std::pmr::vector<double> sides_;
  std::pmr::vector<double> squares_;
};

}  // namespace ph
