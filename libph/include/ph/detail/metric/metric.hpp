// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <memory>
#include <string>

#include "ph/detail/core/names.hpp"
#include "ph/filtration.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The error for a coordinate that is infinite or NaN; the message marks its place and its value.
Error not_finite(Index point, Index coordinate, double found);

/// A matrix, whatever its numbers are.
template <class M>
concept HasColumns = requires(const M& m) {
  m.cols();
};

/// A finite set with a dissimilarity: symmetric, zero on the diagonal, never negative or NaN;
/// +infinity means that two points are never joined. The triangle inequality is not required.
/// Several threads may request distances at once. Points alone are not a metric: they need a
/// distance. Other matrices are no metric either; ph/eigen.hpp makes points of them.
template <class M>
concept Metric = !std::convertible_to<const M&, PointsView> && !HasColumns<M> &&
                 requires(const M& m, Index i, Index j) {
  { m.size() } -> std::convertible_to<Index>;
  { m(i, j) } -> std::convertible_to<double>;
};

/// Any metric behind one type. Code that uses this type is compiled only once. It keeps a reference
/// to the metric.
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

/// Distances between rows of a matrix that libph knows by name.
enum class PointDistance {
  euclidean,
  manhattan,
  chebyshev,
  minkowski,  ///< (sum |x-y|^p)^(1/p), p >= 1
  cosine,     ///< 1 - cos(angle); a zero row is refused
  hamming,    ///< the number of coordinates that differ
};

template <>
inline constexpr std::array names_of<PointDistance>{
    Named{PointDistance::euclidean, "euclidean"}, Named{PointDistance::manhattan, "manhattan"},
    Named{PointDistance::chebyshev, "chebyshev"}, Named{PointDistance::minkowski, "minkowski"},
    Named{PointDistance::cosine, "cosine"},       Named{PointDistance::hamming, "hamming"},
};

/// The name of a distance as in the JSON of bars: "euclidean", "minkowski:3".
/// @param p exponent of PointDistance::minkowski.
std::string metric_name(PointDistance distance, double p = 2);

/// The device on which a computation runs.
enum class Device {
  cpu,
  gpu,  ///< an NVIDIA GPU, if libph was built with PH_WITH_CUDA
};

template <>
inline constexpr std::array names_of<Device>{
    Named{Device::cpu, "cpu"},
    Named{Device::gpu, "gpu"},
};

/// A set of points with one of the named distances. It keeps a view of the points. Coordinates of
/// any finite size are allowed: sums of squares are scaled before they overflow.
class PointMetric {
 public:
  /// @param points one point per row, finite coordinates. @param p exponent of `minkowski`.
  /// @param largest if these points are a part of a cloud: the largest absolute coordinate of that
  ///        cloud. With this number, the distances equal the distances in the whole cloud to the
  ///        last bit. 0 if these are all points.
  /// @throws Error (bad_data) on a coordinate that is not finite or on a zero row with `cosine`;
  ///         Error (usage) if p < 1.
  explicit PointMetric(PointsView points, PointDistance distance = PointDistance::euclidean,
                       double p = 2, double largest = 0);

  /// Computes the direction of each point once, instead of once per distance, if the distance is
  /// `cosine`. The distances stay equal to the last bit. The directions take as much memory as the
  /// points. Copies of this object share them.
  void keep_directions(const RunContext& context);

  Index size() const { return points().rows(); }
  /// @throws Error (bad_data) if the distance exceeds the largest double.
  double operator()(Index i, Index j) const;
  /// The points, each with contiguous coordinates.
  PointsView points() const { return points_.view(); }
  /// True if distances are square roots of sums of squares, none of which overflows; only a
  /// non-zero sum below kLeastPlainSquare may have lost digits.
  bool is_plain_euclidean() const {
    return distance_ == PointDistance::euclidean && !may_need_scaling_;
  }
  static constexpr double kLeastPlainSquare = 1e-280;

 private:
  double euclidean(Index i, Index j) const;
  double other(Index i, Index j) const;
  double cosine(Index i, Index j) const;

  class Directions;

  WholeRows points_;
  std::shared_ptr<const Directions> directions_;
  PointDistance distance_;
  double p_;
  // Squares of coordinate differences may leave the range of double.
  bool may_need_scaling_ = false;
};

}  // namespace ph
