// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/filtration.hpp"
#include "ph/core/run_context.hpp"

namespace ph {

/// Collects weighted edges and sorts them by (value, u, v) with little more memory than they take:
/// a first pass over the values counts how many fall into each of some ten thousand bins of nearly
/// equal values, a second one puts each edge where its bin is, and then the bins are sorted one by
/// one.
class EdgeSorter {
 public:
  explicit EdgeSorter(const RunContext& context)
      : context_(context), counts_(kBins, 0, &context.memory), edges_(&context.memory) {}

  /// First pass. @param value >= 0, not NaN.
  void count(double value) { ++counts_[bin_of(value)]; }
  /// Between the passes: makes room for the values counted up to `limit`.
  void allocate(double limit);
  /// Second pass: an edge that was counted, of value <= limit.
  void add(const FlagEdge& edge) { edges_[counts_[bin_of(edge.value)]++] = edge; }
  /// The edges added, sorted.
  std::pmr::vector<FlagEdge> finish();

 private:
  // Sign, exponent and four bits of the mantissa: the order of non-negative doubles is that of
  // their bits.
  static constexpr int kShift = 48;
  static constexpr std::size_t kBins = std::size_t{1} << (63 - kShift);
  static std::size_t bin_of(double value) { return std::bit_cast<std::uint64_t>(value) >> kShift; }

  const RunContext& context_;
  std::size_t last_bin_ = 0;              // the one of the limit
  std::pmr::vector<std::size_t> counts_;  // from allocate on: where the next edge of a bin goes
  std::pmr::vector<FlagEdge> edges_;
};

/// Sorts by (value, u, v).
void sort_edges(std::pmr::vector<FlagEdge>& edges, const RunContext& context);

}  // namespace ph
