// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/filtration.hpp"
#include "ph/core/run_context.hpp"

namespace ph {

/// Collects weighted edges and sorts them by (value, u, v) with little more memory than they take:
/// a first pass over the values counts how many fall into each of many bins of nearly equal values,
/// a second one puts each edge where its bin is, and then the bins are sorted one by one.
class EdgeSorter {
 public:
  /// @param values how many will be counted, more or less.
  EdgeSorter(std::size_t values, const RunContext& context)
      : context_(context),
        shift_(kBits - std::clamp(static_cast<int>(std::bit_width(values)), 1, kMostBinBits)),
        counts_(std::size_t{1} << (kBits - shift_), 0, &context.memory),
        edges_(&context.memory) {}

  /// First pass. @param value >= 0, not NaN.
  void count(double value) { ++counts_[bin_of(value)]; }
  /// Between the passes: makes room for the values counted up to `limit`.
  void allocate(double limit);
  /// Second pass: an edge that was counted, of value <= limit.
  void add(const FlagEdge& edge) { edges_[counts_[bin_of(edge.value)]++] = edge; }
  /// The edges added, sorted.
  std::pmr::vector<FlagEdge> finish();

 private:
  // The order of non-negative doubles is that of their bits: a bin is their first ones, as many as
  // there are values, up to the exponent and four bits of the mantissa.
  static constexpr int kBits = 63, kMostBinBits = 15;
  std::size_t bin_of(double value) const { return std::bit_cast<std::uint64_t>(value) >> shift_; }

  const RunContext& context_;
  int shift_;
  std::size_t last_bin_ = 0;              // the one of the limit
  std::pmr::vector<std::size_t> counts_;  // from allocate on: where the next edge of a bin goes
  std::pmr::vector<FlagEdge> edges_;
};

/// Sorts by (value, u, v).
void sort_edges(std::pmr::vector<FlagEdge>& edges, const RunContext& context);

}  // namespace ph
