// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/detail/metric/metric.hpp"
#include "ph/detail/rips/vertex_weights.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The points of a set that become vertices of a Rips filtration, and the values at which they
/// enter.
class RipsVertices {
 public:
  /// @param size number of points. @param chosen the points to take, ascending; if empty, all
  /// points.
  /// @param births one per point; if empty, all are 0. A point born beyond the threshold never
  ///        enters.
  /// @throws Error (usage) if the numbers in `chosen` do not ascend or are not below `size`, or if
  /// there is not one birth per point; Error (bad_data) on a birth that is negative, infinite or
  /// NaN.
  RipsVertices(Index size, std::span<const std::uint32_t> chosen, std::span<const double> births,
               WeightExponent exponent, std::optional<double> threshold, const RunContext& context);

  bool are_all() const { return are_all_; }
  /// The points that are vertices, ascending; empty if all points are.
  const std::pmr::vector<std::uint32_t>& members() const { return members_; }
  /// The weights, by vertex.
  VertexWeights weights() const { return {births_, exponent_}; }

 private:
  bool are_all_ = true;
  std::pmr::vector<std::uint32_t> members_;
  std::pmr::vector<double> births_;
  WeightExponent exponent_;
};

/// The restriction of a metric to some of its points. It keeps references to the metric and to the
/// list of points.
template <Metric M>
class SubsetMetric {
 public:
  SubsetMetric(const M& metric, std::span<const std::uint32_t> members)
      : metric_(metric), members_(members) {}

  Index size() const { return static_cast<Index>(members_.size()); }
  double operator()(Index i, Index j) const {
    return metric_(members_[static_cast<std::size_t>(i)], members_[static_cast<std::size_t>(j)]);
  }

 private:
  const M& metric_;
  std::span<const std::uint32_t> members_;
};

}  // namespace ph
