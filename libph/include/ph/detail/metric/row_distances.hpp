// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <vector>

#include "ph/detail/metric/metric.hpp"

namespace ph {

/// The distances from one point to all before it, a row of the lower triangle at a time: the same
/// numbers that the metric gives, faster where many can be computed at once. Keeps a reference.
template <Metric M>
class RowDistances {
 public:
  RowDistances(const M& metric, std::pmr::memory_resource*) : metric_(metric) {}
  /// How many numbers a row must have room for.
  Index row_capacity() const { return metric_.size(); }
  /// out[j] = d(i, j), j < i; what follows is overwritten. @throws what the metric throws.
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
  std::pmr::vector<double> blocks_;  // of points, axis by axis; empty: one pair at a time
};

/// The largest number of a row of distances; each is made the new maximum of its column where it
/// is larger. @return the largest, or NaN if a number is negative or NaN; -0.0 becomes +0.0.
double take_maxima(double* row, Index count, double* of_columns);

}  // namespace ph
