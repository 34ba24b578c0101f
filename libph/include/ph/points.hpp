// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

#include "ph/metric.hpp"

namespace ph {

/// The distances between rows of a matrix that libph knows by name.
enum class PointDistance {
  euclidean,
  manhattan,
  chebyshev,
  minkowski,  ///< (sum |x-y|^p)^(1/p), p >= 1
  cosine,     ///< 1 - cos(angle); a zero row is refused
  hamming,    ///< the number of coordinates that differ
};

/// A set of points with one of the named distances. Keeps a reference to the points.
/// Coordinates of any finite size are fine: sums of squares are scaled before they overflow.
class PointMetric {
 public:
  /// @param points one point a row, finite coordinates. @param p exponent of `minkowski`.
  /// @throws Error (bad_data) on a coordinate that is not finite or a zero row with `cosine`;
  ///         Error (usage) if p < 1.
  explicit PointMetric(const Points& points, PointDistance distance = PointDistance::euclidean,
                       double p = 2);

  Index size() const { return points_.rows(); }
  /// @throws Error (bad_data) if the distance exceeds the largest double.
  double operator()(Index i, Index j) const;
  const Points& points() const { return points_; }
  /// Whether distances are square roots of sums of squares, none of which overflows; only a sum
  /// below the least plain square, zero apart, may have lost digits.
  bool is_plain_euclidean() const {
    return distance_ == PointDistance::euclidean && !may_need_scaling_;
  }
  static constexpr double kLeastPlainSquare = 1e-280;

 private:
  double euclidean(Index i, Index j) const;
  double other(Index i, Index j) const;

  const Points& points_;
  PointDistance distance_;
  double p_;
  bool may_need_scaling_ =
      false;  // squares of coordinate differences may leave the range of double
};

}  // namespace ph
