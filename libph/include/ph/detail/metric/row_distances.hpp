// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <vector>

#include "ph/detail/metric/metric.hpp"

namespace ph {

/// The distances from one point to all points before it, one row of the lower triangle at a time:
/// the same numbers as from the metric, but faster where many can be computed at once. It keeps a
/// reference to the metric.
template <Metric M>
class RowDistances {
 public:
  RowDistances(const M& metric, std::pmr::memory_resource*) : metric_(metric) {}
  /// The number of entries that a row must have room for.
  Index row_capacity() const { return metric_.size(); }
  /// out[j] = d(i, j), j < i; entries after these are overwritten. @throws the same errors as the
  /// metric.
  void operator()(Index i, double* out) const {
    for (Index j = 0; j < i; ++j) out[j] = metric_(i, j);
  }

 private:
  const M& metric_;
};

template <>
class RowDistances<AnyMetric> {
 public:
  RowDistances(const AnyMetric& metric, std::pmr::memory_resource*) : metric_(metric) {}
  Index row_capacity() const { return metric_.size(); }
  void operator()(Index i, double* out) const { metric_.row(i, out); }

 private:
  const AnyMetric& metric_;
};

template <>
class RowDistances<PointMetric> {
 public:
  RowDistances(const PointMetric& metric, std::pmr::memory_resource* memory);
  Index row_capacity() const;
  void operator()(Index i, double* out) const;

 private:
  const PointMetric& metric_;
  // The points, axis by axis; empty if distances are computed one pair at a time.
  std::pmr::vector<double> blocks_;
};

/// Returns the largest number of a row of distances, or NaN if a number is negative or NaN; -0.0
/// becomes +0.0. Also updates the maximum of each column.
double take_maxima(double* row, Index count, double* of_columns);

}  // namespace ph
