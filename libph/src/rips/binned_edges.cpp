// SPDX-License-Identifier: MIT
#include "ph/detail/rips/binned_edges.hpp"

#include <bit>
#include <iterator>
#include <numeric>
#include <system_error>
#include <utility>

#include "libph/src/core/system/pages.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph {
namespace {

// The comparison is a lambda, because a call of `precedes` through a pointer would not be inlined.
constexpr auto kInOrder = [](const FlagEdge& a, const FlagEdge& b) { return precedes(a, b); };

constexpr std::size_t kFew = 32;  // edges up to this number are sorted by insertion

// Edges that are divided into parts by some bits (a digit) of their values.
struct Split {
  std::pmr::vector<std::size_t> ends;  // end of the range of edges with each digit
  int shift;                           // position of the digit
};

// Divides edges by the bits just below `shift`, into about as many parts as there are edges, but at
// most 4096 parts. The values of all edges must agree in the bits at and above `shift`.
Split split(std::span<FlagEdge> edges, int shift, FlagEdges& buffer) {
  constexpr int most_bits = 12;  // this keeps the counts in the cache
  const int bits = std::min({most_bits, shift, static_cast<int>(std::bit_width(edges.size()))});
  const std::size_t parts = std::size_t{1} << bits;
  Split result{{parts, 0, buffer.get_allocator().resource()}, shift - bits};
  const auto digit = [parts, shift = result.shift](const FlagEdge& e) {
    return std::bit_cast<std::uint64_t>(e.value) >> shift & (parts - 1);
  };
  auto& next = result.ends;  // place of the next edge of a part
  for (const FlagEdge& e : edges) ++next[digit(e)];
  std::size_t sum = 0;
  for (std::size_t& count : next) sum += std::exchange(count, sum);
  buffer.assign(edges.begin(), edges.end());
  for (const FlagEdge& e : buffer) edges[next[digit(e)]++] = e;
  return result;
}

// Sorts edges, each of which is only a few places away from its final place.
void sort_by_insertion(std::span<FlagEdge> edges) {
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const FlagEdge e = edges[i];
    std::size_t k = i;
    for (; k > 0 && precedes(e, edges[k - 1]); --k) edges[k] = edges[k - 1];
    if (k != i) edges[k] = e;
  }
}

bool is_sorted_at_once(std::span<FlagEdge> edges, int shift) {
  if (edges.size() <= kFew) {
    sort_by_insertion(edges);
    return true;
  }
  // Edges of equal value from a matrix arrive in order, so edges with integer values are already
  // sorted.
  if (std::is_sorted(edges.begin(), edges.end(), kInOrder)) return true;
  if (shift > 0) return false;
  std::sort(edges.begin(), edges.end(), kInOrder);
  return true;
}

void sort_edges(std::span<FlagEdge> edges, int shift, FlagEdges& buffer);

// Sorts edges that were divided into parts. @param begin start of the first part. @param ends ends
// of the parts.
void sort_parts(std::span<FlagEdge> edges, std::size_t begin, std::span<const std::size_t> ends,
                int shift, FlagEdges& buffer) {
  const std::size_t first = begin;
  for (const std::size_t end : ends) {
    if (end - begin > kFew) sort_edges(edges.subspan(begin, end - begin), shift, buffer);
    begin = end;
  }
  // This sorts all small parts at once.
  sort_by_insertion(edges.subspan(first, begin - first));
}

void sort_edges(std::span<FlagEdge> edges, int shift, FlagEdges& buffer) {
  if (is_sorted_at_once(edges, shift)) return;
  const Split parts = split(edges, shift, buffer);
  sort_parts(edges, 0, parts.ends, parts.shift, buffer);
}

// Returns the ends of the bins that are not empty. @param ends the ends of all bins, ascending.
std::pmr::vector<std::size_t> without_empty(std::span<const std::size_t> ends,
                                            const RunContext& context) {
  std::pmr::vector<std::size_t> result(&context.memory);
  std::ranges::unique_copy(ends, std::back_inserter(result));
  if (!result.empty() && result.front() == 0) result.erase(result.begin());
  return result;
}

}  // namespace

BinnedEdges::BinnedEdges(FlagEdges&& edges)
    : edges_(std::move(edges)), ends_(edges_.get_allocator()) {
  ends_.push_back(edges_.size());
  lazy_->sorted_bins = 1;
  lazy_->sorted_edges = edges_.size();
}

BinnedEdges::BinnedEdges(FlagEdges&& edges, std::pmr::vector<std::size_t>&& ends, int shared_bits,
                         const RunContext& context)
    : edges_(std::move(edges)),
      ends_(std::move(ends)),
      shared_bits_(shared_bits),
      context_(&context) {}

std::span<const FlagEdge> BinnedEdges::sorted_bins(std::size_t count) const {
  const std::size_t edges = bin_begin(count);
  if (lazy_->sorted_edges.load(std::memory_order_acquire) < edges) sort_until(edges);
  return std::span<const FlagEdge>(edges_).first(edges);
}

void BinnedEdges::sort_until(std::size_t count) const {
  const std::lock_guard lock(lazy_->mutex);
  finish_ahead();
  while (bin_begin(lazy_->sorted_bins) < count) {
    sort_bin(lazy_->sorted_bins);
    count_sorted_bin();
  }
}

void BinnedEdges::count_sorted_bin() const {
  lazy_->sorted_edges.store(bin_begin(++lazy_->sorted_bins), std::memory_order_release);
}

void BinnedEdges::sort_bin(std::size_t bin) const {
  context_->poll();
  const std::span<FlagEdge> edges = edges_of(bin);
  if (is_sorted_at_once(edges, shared_bits_)) return;
  FlagEdges buffer(&context_->memory);
  const Split parts = split(edges, shared_bits_, buffer);
  buffer = FlagEdges(&context_->memory);
  constexpr std::size_t edges_a_piece = 1 << 14;  // fewer edges do not justify a thread
  const std::size_t pieces = edges.size() / edges_a_piece + 1;
  for_each_piece("sort edges", parts.ends.size(), (parts.ends.size() + pieces - 1) / pieces,
                 *context_, [&](std::size_t first, std::size_t last) {
                   FlagEdges own(&context_->memory);
                   sort_parts(edges, first == 0 ? 0 : parts.ends[first - 1],
                              std::span(parts.ends).subspan(first, last - first), parts.shift, own);
                 });
}

void BinnedEdges::sort_ahead(std::size_t bin) const {
  constexpr std::size_t few = 1 << 14;  // fewer edges do not justify a thread
  if (bin >= bin_count() || bin_begin(bin + 1) - bin_begin(bin) < few) return;
  if (thread_count(*context_) < 2) return;
  const std::lock_guard lock(lazy_->mutex);
  finish_ahead();
  if (bin != lazy_->sorted_bins) return;
  const auto sort = [lazy = lazy_.get(), edges = edges_of(bin), shift = shared_bits_,
                     context = context_] {
    try {
      context->poll();
      FlagEdges buffer(&context->memory);
      sort_edges(edges, shift, buffer);
    } catch (...) {
      // The bin stays unsorted; the caller that needs it sorts it and gets the error.
      return;
    }
    lazy->is_next_sorted = true;
  };
  try {
    lazy_->ahead = std::jthread(sort);
  } catch (const std::system_error&) {
    return;  // no thread is available
  }
}

void BinnedEdges::finish_ahead() const {
  if (!lazy_->ahead.joinable()) return;
  lazy_->ahead.join();
  if (std::exchange(lazy_->is_next_sorted, false)) count_sorted_bin();
}

void EdgeBinner::allocate(double limit) {
  limit_ = limit;
  std::size_t sum = 0;
  for (std::size_t bin = 0; bin <= bin_of_(limit_); ++bin)
    for (std::size_t w = 0; w < workers_; ++w)
      sum += std::exchange(counts_[begin_of(w) + bin], sum);
  for (std::size_t w = 0; w < workers_; ++w)
    last_parts_.push_back(counts_[begin_of(w) + bin_of_(limit_)]);
  edges_.resize(sum);
}

BinnedEdges EdgeBinner::finish() {
  const std::size_t last = bin_of_(limit_);
  const auto ends = std::span(counts_).subspan(begin_of(workers_ - 1), last + 1);
  // The last bin has gaps, because not all of its edges were within the limit. The edges that each
  // worker put there are moved together.
  auto to = edges_.begin() + static_cast<std::ptrdiff_t>(last == 0 ? 0 : ends[last - 1]);
  for (std::size_t w = 0; w < workers_; ++w)
    // mutant: last-bin
    to = std::copy(edges_.begin() + static_cast<std::ptrdiff_t>(last_parts_[w]),
                   edges_.begin() + static_cast<std::ptrdiff_t>(counts_[begin_of(w) + last]), to);
  edges_.erase(to, edges_.end());
  ends[last] = edges_.size();
  return BinnedEdges(std::move(edges_), without_empty(ends, context_), bin_of_.shared_bits(),
                     context_);
}

void EdgeCollector::add_block() {
  constexpr std::size_t least = 1 << 10, most = 1 << 17;
  if (!blocks_.empty()) size_ += blocks_.back().size();
  FlagEdges block(blocks_.get_allocator().resource());
  block.reserve(std::clamp(size_, least, most));
  blocks_.push_back(std::move(block));
}

FlagEdges EdgeCollector::finish() {
  if (blocks_.size() == 1) return std::move(blocks_.front());
  FlagEdges edges(blocks_.get_allocator().resource());
  edges.reserve(blocks_.empty() ? 0 : size_ + blocks_.back().size());
  for (FlagEdges& block : blocks_) {
    edges.insert(edges.end(), block.begin(), block.end());
    drop_pages(block.data(), block.capacity() * sizeof(FlagEdge));
    block = FlagEdges(block.get_allocator());
  }
  return edges;
}

BinnedEdges bin_edges(FlagEdges&& edges, const RunContext& context) {
  context.poll();
  const ValueBins bin_of(edges.size());
  std::pmr::vector<std::size_t> next(bin_of.count(), 0, &context.memory), ends(next);
  for (const FlagEdge& e : edges) ++next[bin_of(e.value)];
  std::inclusive_scan(next.begin(), next.end(), ends.begin());
  for (std::size_t bin = 0; bin < next.size(); ++bin) next[bin] = ends[bin] - next[bin];
  // This is the "American flag" sort of McIlroy, Bostic and McIlroy, Engineering radix sort (1993).
  // An edge moves to the next place of its bin and displaces the edge at that place. The displaced
  // edge moves on in the same way, until an edge arrives that belongs in the first place.
  for (std::size_t bin = 0; bin < next.size(); ++bin)
    for (; next[bin] < ends[bin]; ++next[bin]) {
      FlagEdge& here = edges[next[bin]];
      for (std::size_t b = bin_of(here.value); b != bin; b = bin_of(here.value))
        std::swap(here, edges[next[b]++]);
    }
  return BinnedEdges(std::move(edges), without_empty(ends, context), bin_of.shared_bits(), context);
}

}  // namespace ph
