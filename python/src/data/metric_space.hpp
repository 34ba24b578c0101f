// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "ph/detail/metric/metric.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/greedy_permutation.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"
#include "python/src/data/array_metric.hpp"

namespace ph::python {

namespace py = pybind11;

/// Points and their metric.
struct PointSet {
  PointsView points;
  PointDistance distance = PointDistance::euclidean;
  double p = 2;  ///< the exponent of PointDistance::minkowski

  Index size() const { return points.rows(); }
};

inline GreedyPermutation greedy_permutation(const PointSet& set, const GreedyLimits& limits,
                                            const RunContext& context) {
  return ph::greedy_permutation(set.points, limits, set.distance, set.p, context);
}
inline std::vector<double> core_distances(const PointSet& set, Index neighbours,
                                          const RunContext& context) {
  return ph::core_distances(set.points, neighbours, set.distance, set.p, context);
}
inline std::vector<double> distance_to_measure(const PointSet& set, Index neighbours,
                                               const RunContext& context) {
  return ph::distance_to_measure(set.points, neighbours, set.distance, set.p, context);
}

/// A finite set with distances. It is given by points, by all distances, or by the distances of
/// some pairs. The numbers are in Python arrays, which this object keeps alive. The arrays must not
/// change during a computation.
class MetricSpace {
 public:
  /// @param points float64, one point per row.
  MetricSpace(const py::buffer& points, PointDistance distance, double p);
  /// @param distances float32 or float64, a square matrix or, with one axis, its condensed form.
  /// @param has_nan_option if false, messages do not suggest this option.
  MetricSpace(const py::buffer& distances, Symmetrise symmetrise, NanPolicy nan,
              bool has_zero_diagonal, bool has_nan_option);
  /// @param i, j the pairs i < j, each of which occurs once. @param distances their distances.
  MetricSpace(Index size, const py::buffer& i, const py::buffer& j, const py::buffer& distances);

  Index size() const { return size_; }
  /// True if each pair has a distance.
  bool is_complete() const { return !std::holds_alternative<Pairs>(numbers_); }

  /// The memory of the pairs, once in Python's arrays and once as edges; 0 for other spaces.
  std::size_t bytes_of_pairs() const {
    const auto* pairs = std::get_if<Pairs>(&numbers_);
    constexpr std::size_t each = 2 * sizeof(std::int64_t) + sizeof(double) + sizeof(WeightedEdge);
    return pairs != nullptr ? pairs->i.size() * each : 0;
  }

  /// The points, if the space consists of points.
  const PointSet* point_set() const { return std::get_if<PointSet>(&numbers_); }

  /// Calls `use` with a PointSet, an ArrayMetric or SparseDistances.
  /// @throws Error (bad_data) on invalid distances.
  template <class Use>
  decltype(auto) visit(const RunContext& context, Use&& use) const {
    if (const auto* points = std::get_if<PointSet>(&numbers_)) return use(*points);
    if (const auto* pairs = std::get_if<Pairs>(&numbers_)) return use(sparse_distances(*pairs));
    const auto& array = std::get<DistanceArray>(numbers_);
    if (is_single_) {
      check_distances<float>(array, context);
      return use(ArrayMetric<float>(array));
    }
    check_distances<double>(array, context);
    return use(ArrayMetric<double>(array));
  }

 private:
  struct Pairs {
    std::span<const std::int64_t> i, j;
    std::span<const double> distances;
  };
  SparseDistances sparse_distances(const Pairs& pairs) const;

  std::vector<py::buffer_info> arrays_;  // keeps the numbers alive
  Index size_ = 0;
  bool is_single_ = false;  // true if distances are float32
  std::variant<PointSet, DistanceArray, Pairs> numbers_;
};

}  // namespace ph::python
