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

/// Which points of a set become vertices of a Rips filtration, and when they enter.
class RipsVertices {
 public:
  /// @param size number of points. @param chosen the points to take, ascending; empty: all.
  /// @param births by point; empty: 0. Who is born beyond the threshold never enters.
  /// @throws Error (usage) if `chosen` is not ascending below `size` or there is not one birth a
  /// point; Error (bad_data) on a birth that is negative, infinite or NaN.
  RipsVertices(Index size, std::span<const std::uint32_t> chosen, std::span<const double> births,
               WeightExponent exponent, std::optional<double> threshold, const RunContext& context);

  bool are_all() const { return are_all_; }
  /// The points that are vertices, ascending; nothing is here if all are.
  const std::pmr::vector<std::uint32_t>& members() const { return members_; }
  /// By vertex.
  VertexWeights weights() const { return {births_, exponent_}; }

 private:
  bool are_all_ = true;
  std::pmr::vector<std::uint32_t> members_;
  std::pmr::vector<double> births_;
  WeightExponent exponent_;
};

/// Some of the points of a metric. Keeps references to both.
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
