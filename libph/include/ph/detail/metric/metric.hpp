// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <string>

#include "ph/filtration.hpp"
#include "ph/points.hpp"

namespace ph {

/// What is thrown for a coordinate that is infinite or NaN: its place and what was found are
/// marked.
Error not_finite(Index point, Index coordinate, double found);

/// A finite set with a dissimilarity: symmetric, zero on the diagonal, never negative or NaN;
/// +infinity means that two points are never joined. The triangle inequality is not required.
/// Several threads may ask at once. Points are no metric: they need a distance.
template <class M>
concept Metric =
    !std::convertible_to<const M&, PointsView> && requires(const M& m, Index i, Index j) {
  { m.size() } -> std::convertible_to<Index>;
  { m(i, j) } -> std::convertible_to<double>;
};

/// Any metric behind one type, so that what is done with it is compiled once. Keeps a reference.
class AnyMetric {
 public:
  template <Metric M>
  explicit AnyMetric(const M& metric)
      : metric_(&metric),
        size_(metric.size()),
        distance_([](const void* m, Index i, Index j) {
          return static_cast<double>((*static_cast<const M*>(m))(i, j));
        }),
        row_([](const void* m, Index i, double* out) {
          for (Index j = 0; j < i; ++j) out[j] = (*static_cast<const M*>(m))(i, j);
        }) {}

  Index size() const { return size_; }
  double operator()(Index i, Index j) const { return distance_(metric_, i, j); }
  /// out[j] = d(i, j) for j < i.
  void row(Index i, double* out) const { row_(metric_, i, out); }

 private:
  const void* metric_;
  Index size_;
  double (*distance_)(const void*, Index, Index);
  void (*row_)(const void*, Index, double*);
};

/// The distances between rows of a matrix that libph knows by name.
enum class PointDistance {
  euclidean,
  manhattan,
  chebyshev,
  minkowski,  ///< (sum |x-y|^p)^(1/p), p >= 1
  cosine,     ///< 1 - cos(angle); a zero row is refused
  hamming,    ///< the number of coordinates that differ
};

/// The name of a distance, as JSON of bars has it: "euclidean", "minkowski:3".
/// @param p exponent of PointDistance::minkowski.
std::string metric_name(PointDistance distance, double p = 2);

/// What computes.
enum class Device {
  cpu,
  gpu,  ///< of NVIDIA, in a libph that was built with PH_WITH_CUDA
};

/// A set of points with one of the named distances. Keeps a view of the points.
/// Coordinates of any finite size are fine: sums of squares are scaled before they overflow.
class PointMetric {
 public:
  /// @param points one point a row, finite coordinates. @param p exponent of `minkowski`.
  /// @param largest the largest absolute coordinate of the cloud that these are some points of,
  ///        whose distances they have to the last bit; 0: they are all.
  /// @throws Error (bad_data) on a coordinate that is not finite or a zero row with `cosine`;
  ///         Error (usage) if p < 1.
  explicit PointMetric(PointsView points, PointDistance distance = PointDistance::euclidean,
                       double p = 2, double largest = 0);

  Index size() const { return points().rows(); }
  /// @throws Error (bad_data) if the distance exceeds the largest double.
  double operator()(Index i, Index j) const;
  /// Their coordinates lie side by side.
  PointsView points() const { return points_.view(); }
  /// Whether distances are square roots of sums of squares, none of which overflows; only a sum
  /// below the least plain square, zero apart, may have lost digits.
  bool is_plain_euclidean() const {
    return distance_ == PointDistance::euclidean && !may_need_scaling_;
  }
  static constexpr double kLeastPlainSquare = 1e-280;

 private:
  double euclidean(Index i, Index j) const;
  double other(Index i, Index j) const;

  WholeRows points_;
  PointDistance distance_;
  double p_;
  bool may_need_scaling_ =
      false;  // squares of coordinate differences may leave the range of double
};

}  // namespace ph
