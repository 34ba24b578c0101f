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

/// Weighted edges in the order of a flag filtration, (value, u, v), sorted on demand: edges lie in
/// bins of nearly equal values, and a bin is sorted when its edges are first needed in order. A
/// caller that stops early does not pay for sorting the rest. Thread-safe.
class BinnedEdges {
 public:
  /// @param edges sorted by value; edges of equal value may be in any order.
  explicit BinnedEdges(FlagEdges&& edges);
  /// @param ends the end of each bin in `edges`, ascending. @param shared_bits the values of a bin
  /// agree in all bits from this bit up.
  BinnedEdges(FlagEdges&& edges, std::pmr::vector<std::size_t>&& ends, int shared_bits,
              const RunContext& context);

  std::size_t size() const { return edges_.size(); }
  /// The edge at a position in the order.
  const FlagEdge& operator[](std::size_t position) const {
    if (position >= lazy_->sorted_edges.load(std::memory_order_acquire)) sort_until(position + 1);
    return edges_[position];
  }
  /// All edges, in order.
  std::span<const FlagEdge> sorted() const { return sorted_bins(bin_count()); }

  std::size_t bin_count() const { return ends_.size(); }
  /// The place where a bin begins; bin_count() is allowed as well.
  std::size_t bin_begin(std::size_t bin) const { return bin == 0 ? 0 : ends_[bin - 1]; }
  /// Lets another thread sort a bin while the caller works on the bins before it, if the context
  /// allows two threads and those bins are sorted. If that fails, the first caller that needs the
  /// bin sorts it.
  void sort_ahead(std::size_t bin) const;
  /// The edges of the first `count` bins, in order.
  std::span<const FlagEdge> sorted_bins(std::size_t count) const;
  /// Calls `use(edges)` with the edges of the bins [first, last): bin after bin, but within a bin
  /// in no particular order. The span is valid only during the call.
  template <class Use>
  decltype(auto) with_bins(std::size_t first, std::size_t last, Use&& use) const {
    const std::lock_guard lock(lazy_->mutex);
    finish_ahead();
    return use(std::span<const FlagEdge>(edges_).subspan(bin_begin(first),
                                                         bin_begin(last) - bin_begin(first)));
  }

 private:
  struct Lazy {
    std::mutex mutex;  // held by a thread that sorts, or that looks at unsorted edges
    std::size_t sorted_bins = 0;
    std::atomic<std::size_t> sorted_edges{0};  // number of edges in these bins
    // Set by the thread `ahead`; read after that thread has been joined.
    bool is_next_sorted = false;
    std::jthread ahead;
  };
  std::span<FlagEdge> edges_of(std::size_t bin) const {
    return std::span(edges_).subspan(bin_begin(bin), bin_begin(bin + 1) - bin_begin(bin));
  }
  /// Sorts the bins that contain the first `count` edges.
  void sort_until(std::size_t count) const;
  void sort_bin(std::size_t bin) const;
  /// Waits for the bin that is being sorted ahead, if there is one. The caller must hold the mutex.
  void finish_ahead() const;
  void count_sorted_bin() const;

  mutable FlagEdges edges_;
  std::pmr::vector<std::size_t> ends_;
  int shared_bits_ = 0;
  const RunContext* context_ = nullptr;
  std::unique_ptr<Lazy> lazy_ = std::make_unique<Lazy>();
};

/// Bins of nearly equal values: the values of a bin share their first bits. The number of these
/// bits depends on the number of values; the shared bits are at most the exponent and four bits of
/// the mantissa. (Non-negative doubles are ordered as their bits.)
class ValueBins {
 public:
  /// @param values the approximate number of values.
  explicit ValueBins(std::size_t values)
      : shift_(kBits - std::clamp(static_cast<int>(std::bit_width(values)), 1, kMostBinBits)) {}
  std::size_t count() const { return std::size_t{1} << (kBits - shift_); }
  /// @param value >= 0, not NaN.
  std::size_t operator()(double value) const {
    return std::bit_cast<std::uint64_t>(value) >> shift_;
  }
  /// Number of low bits of a value that do not determine its bin.
  int shared_bits() const { return shift_; }

 private:
  static constexpr int kBits = 63, kMostBinBits = 15;
  int shift_;
};

/// Puts edges that can be listed twice into bins, with little more memory than the edges take: a
/// first pass over the values counts how many fall into each bin, and a second pass puts each edge
/// into its bin, in the order of the pass. Several workers may share a pass: each has its own part
/// of every bin; the parts lie in the order of the workers.
class EdgeBinner {
 public:
  /// @param values the approximate number of values that will be counted.
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
  /// Second pass: adds an edge of value <= limit that the worker counted.
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
  std::pmr::vector<std::size_t> counts_;      // after allocate: the place of the next edge of a bin
  std::pmr::vector<std::size_t> last_parts_;  // by worker: start of its part of the last bin
  FlagEdges edges_;
};

/// Collects edges that can be listed only once and whose number is unknown. It stores them in
/// blocks, which take little more memory than the edges; a vector that doubles its size takes up to
/// three times as much.
class EdgeCollector {
 public:
  explicit EdgeCollector(const RunContext& context) : blocks_(&context.memory) {}
  void add(const FlagEdge& edge) {
    if (blocks_.empty() || blocks_.back().size() == blocks_.back().capacity()) add_block();
    blocks_.back().push_back(edge);
  }
  /// Returns the edges in the order in which they were added.
  FlagEdges finish();

 private:
  void add_block();
  std::size_t size_ = 0;  // edges in full blocks
  std::pmr::vector<FlagEdges> blocks_;
};

/// Moves edges, which may come in any order, into bins in place.
BinnedEdges bin_edges(FlagEdges&& edges, const RunContext& context);

}  // namespace ph
