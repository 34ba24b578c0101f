// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Weighted edges in the order of a flag filtration, (value, u, v), as far as anybody has asked for
/// it: they lie in bins of nearly equal values, and a bin is sorted when its edges are first needed
/// in order. Whoever stops early never pays for the rest. Thread-safe.
class BinnedEdges {
 public:
  /// @param edges sorted, ties in any order.
  explicit BinnedEdges(FlagEdges&& edges);
  /// @param ends of each bin in `edges`, ascending. @param shared_bits that the values of a bin
  /// have in common, from this one up.
  BinnedEdges(FlagEdges&& edges, std::pmr::vector<std::size_t>&& ends, int shared_bits,
              const RunContext& context);

  std::size_t size() const { return edges_.size(); }
  /// By position in the order.
  const FlagEdge& operator[](std::size_t position) const {
    if (position >= lazy_->sorted_edges.load(std::memory_order_acquire)) sort_until(position + 1);
    return edges_[position];
  }
  /// All of them, in order.
  std::span<const FlagEdge> sorted() const { return sorted_bins(bin_count()); }

  std::size_t bin_count() const { return ends_.size(); }
  /// Where a bin begins; bin_count() is a place, too.
  std::size_t bin_begin(std::size_t bin) const { return bin == 0 ? 0 : ends_[bin - 1]; }
  /// Lets another thread sort a bin while the caller is busy with those before it, if the context
  /// allows two and they are sorted. What fails there is done again by whoever needs the bin.
  void sort_ahead(std::size_t bin) const;
  /// The edges of the first `count` bins, in order.
  std::span<const FlagEdge> sorted_bins(std::size_t count) const;
  /// Calls `use(edges)` with those of the bins [first, last): bin after bin, but within a bin in no
  /// particular order. They must not be kept.
  template <class Use>
  decltype(auto) with_bins(std::size_t first, std::size_t last, Use&& use) const {
    const std::lock_guard lock(lazy_->mutex);
    finish_ahead();
    return use(std::span<const FlagEdge>(edges_).subspan(bin_begin(first),
                                                         bin_begin(last) - bin_begin(first)));
  }

 private:
  struct Lazy {
    std::mutex mutex;  // held by who sorts and by who looks at what is not sorted
    std::size_t sorted_bins = 0;
    std::atomic<std::size_t> sorted_edges{0};  // in these bins
    bool is_next_sorted = false;               // by `ahead`, which is the only one to look there
    std::jthread ahead;
  };
  std::span<FlagEdge> edges_of(std::size_t bin) const {
    return std::span(edges_).subspan(bin_begin(bin), bin_begin(bin + 1) - bin_begin(bin));
  }
  /// Sorts the bins with the first `count` edges.
  void sort_until(std::size_t count) const;
  void sort_bin(std::size_t bin) const;
  /// Waits for the bin that is sorted ahead, if there is one. Needs the mutex.
  void finish_ahead() const;
  void count_sorted_bin() const;

  mutable FlagEdges edges_;
  std::pmr::vector<std::size_t> ends_;
  int shared_bits_ = 0;
  const RunContext* context_ = nullptr;
  std::unique_ptr<Lazy> lazy_ = std::make_unique<Lazy>();
};

/// Bins of nearly equal values: those with the same first bits, as many bits as there are values,
/// up to the exponent and four of the mantissa. (The order of non-negative doubles is that of their
/// bits.)
class ValueBins {
 public:
  /// @param values how many there are, more or less.
  explicit ValueBins(std::size_t values)
      : shift_(kBits - std::clamp(static_cast<int>(std::bit_width(values)), 1, kMostBinBits)) {}
  std::size_t count() const { return std::size_t{1} << (kBits - shift_); }
  /// @param value >= 0, not NaN.
  std::size_t operator()(double value) const {
    return std::bit_cast<std::uint64_t>(value) >> shift_;
  }
  /// Bits of a value that say nothing about its bin.
  int shared_bits() const { return shift_; }

 private:
  static constexpr int kBits = 63, kMostBinBits = 15;
  int shift_;
};

/// Puts edges that can be listed twice into bins, with little more memory than they take: a first
/// pass over the values counts how many fall into each bin, a second one puts each edge where its
/// bin is, in the order of the pass. Several workers may share a pass: each has its own part of
/// every bin, in the order of the workers.
class EdgeBinner {
 public:
  /// @param values how many will be counted, more or less.
  EdgeBinner(std::size_t values, std::size_t workers, const RunContext& context)
      : context_(context),
        bin_of_(values),
        workers_(workers),
        counts_(workers * bin_of_.count(), 0, &context.memory),
        last_parts_(&context.memory),
        edges_(&context.memory) {}

  /// First pass. @param value >= 0, not NaN.
  void count(double value, std::size_t worker = 0) { ++counts_[begin_of(worker) + bin_of_(value)]; }
  /// Between the passes: makes room for the values counted up to `limit`.
  void allocate(double limit);
  /// Second pass: an edge that the worker counted, of value <= limit.
  void add(const FlagEdge& edge, std::size_t worker = 0) {
    edges_[counts_[begin_of(worker) + bin_of_(edge.value)]++] = edge;
  }
  BinnedEdges finish();

 private:
  std::size_t begin_of(std::size_t worker) const { return worker * bin_of_.count(); }

  const RunContext& context_;
  ValueBins bin_of_;
  std::size_t workers_;
  double limit_ = 0;
  std::pmr::vector<std::size_t> counts_;      // from allocate on: where the next edge of a bin goes
  std::pmr::vector<std::size_t> last_parts_;  // by worker: where its part of the last bin begins
  FlagEdges edges_;
};

/// Takes edges that can be listed only once, nobody knows how many. Blocks take little more than
/// the edges; a vector that doubles takes up to three times as much.
class EdgeCollector {
 public:
  explicit EdgeCollector(const RunContext& context) : blocks_(&context.memory) {}
  void add(const FlagEdge& edge) {
    if (blocks_.empty() || blocks_.back().size() == blocks_.back().capacity()) add_block();
    blocks_.back().push_back(edge);
  }
  /// In the order in which they were added.
  FlagEdges finish();

 private:
  void add_block();
  std::size_t size_ = 0;  // of the blocks that are full
  std::pmr::vector<FlagEdges> blocks_;
};

/// Edges in no order, moved into bins where they are.
BinnedEdges bin_edges(FlagEdges&& edges, const RunContext& context);

}  // namespace ph
