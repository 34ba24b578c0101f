// SPDX-License-Identifier: MIT
#include "ph/core/binned_edges.hpp"

#include <bit>
#include <limits>
#include <system_error>
#include <utility>

#include "ph/core/parallel.hpp"

namespace ph {
namespace {

// Not the function itself: a call through a pointer is not inlined.
constexpr auto kInOrder = [](const FlagEdge& a, const FlagEdge& b) { return precedes(a, b); };

constexpr std::size_t kFew = 32;  // edges that are sorted by insertion

// Edges by the value of a digit.
struct Split {
  std::pmr::vector<std::size_t> ends;  // of the edges with each value
  int shift;                           // of the digit
};

// Moves edges whose values share the bits from `shift` on into parts by the next bits, about as
// many parts as edges.
Split split(std::span<FlagEdge> edges, int shift, FlagEdges& buffer) {
  constexpr int most_bits = 12;  // counts stay in the cache
  const int bits = std::min({most_bits, shift, static_cast<int>(std::bit_width(edges.size()))});
  const std::size_t parts = std::size_t{1} << bits;
  Split result{{parts, 0, buffer.get_allocator().resource()}, shift - bits};
  const auto digit = [parts, shift = result.shift](const FlagEdge& e) {
    return std::bit_cast<std::uint64_t>(e.value) >> shift & (parts - 1);
  };
  auto& next = result.ends;  // where the next edge of a part goes
  for (const FlagEdge& e : edges) ++next[digit(e)];
  std::size_t sum = 0;
  for (std::size_t& count : next) sum += std::exchange(count, sum);
  buffer.assign(edges.begin(), edges.end());
  for (const FlagEdge& e : buffer) edges[next[digit(e)]++] = e;
  return result;
}

// For edges that are few places away from theirs.
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
  // Ties arrive in order from a matrix: integers are sorted when they come.
  if (std::is_sorted(edges.begin(), edges.end(), kInOrder)) return true;
  if (shift > 0) return false;
  std::sort(edges.begin(), edges.end(), kInOrder);
  return true;
}

void sort_edges(std::span<FlagEdge> edges, int shift, FlagEdges& buffer);

// Sorts edges that were split, from one of the parts on.
void sort_parts(std::span<FlagEdge> edges, std::size_t begin, std::span<const std::size_t> ends,
                int shift, FlagEdges& buffer) {
  const std::size_t first = begin;
  for (const std::size_t end : ends) {
    if (end - begin > kFew) sort_edges(edges.subspan(begin, end - begin), shift, buffer);
    begin = end;
  }
  sort_by_insertion(edges.subspan(first, begin - first));  // the small ones, all at once
}

void sort_edges(std::span<FlagEdge> edges, int shift, FlagEdges& buffer) {
  if (is_sorted_at_once(edges, shift)) return;
  const Split parts = split(edges, shift, buffer);
  sort_parts(edges, 0, parts.ends, parts.shift, buffer);
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
  constexpr std::size_t edges_a_piece = 1 << 14;  // fewer are sorted before a thread has started
  const std::size_t pieces = edges.size() / edges_a_piece + 1;
  for_each_piece("sort edges", parts.ends.size(), (parts.ends.size() + pieces - 1) / pieces,
                 *context_, [&](std::size_t first, std::size_t last) {
                   FlagEdges own(&context_->memory);
                   sort_parts(edges, first == 0 ? 0 : parts.ends[first - 1],
                              std::span(parts.ends).subspan(first, last - first), parts.shift, own);
                 });
}

void BinnedEdges::sort_ahead(std::size_t bin) const {
  constexpr std::size_t few = 1 << 14;  // a thread costs more
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
      return;  // in some order still: whoever needs the bin sorts it, and meets the error
    }
    lazy->is_next_sorted = true;
  };
  try {
    lazy_->ahead = std::jthread(sort);
  } catch (const std::system_error&) {
    return;  // no thread to be had
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
  for (std::size_t bin = 0; bin <= bin_of(limit_); ++bin)
    for (std::size_t w = 0; w < workers(); ++w)
      sum += std::exchange(counts_[begin_of(w) + bin], sum);
  for (std::size_t w = 0; w < workers(); ++w)
    last_parts_.push_back(counts_[begin_of(w) + bin_of(limit_)]);
  edges_.resize(sum);
}

BinnedEdges EdgeBinner::finish() {
  std::pmr::vector<std::size_t> ends(&context_.memory);
  const std::size_t last = bin_of(limit_);
  std::size_t end = 0;
  const auto close_bin = [&](std::size_t at) {
    if (at > end) ends.push_back(at);
    end = at;
  };
  for (std::size_t bin = 0; bin < last; ++bin) close_bin(counts_[begin_of(workers() - 1) + bin]);
  // In the last bin not all were within the limit: the workers' parts move together.
  auto to = edges_.begin() + static_cast<std::ptrdiff_t>(end);
  for (std::size_t w = 0; w < workers(); ++w)
    to = std::copy(edges_.begin() + static_cast<std::ptrdiff_t>(last_parts_[w]),
                   edges_.begin() + static_cast<std::ptrdiff_t>(counts_[begin_of(w) + last]), to);
  edges_.erase(to, edges_.end());
  close_bin(edges_.size());
  return BinnedEdges(std::move(edges_), std::move(ends), shift_, context_);
}

BinnedEdges bin_edges(FlagEdges&& edges, const RunContext& context) {
  context.poll();
  EdgeBinner binner(edges.size(), 1, context);
  for (const FlagEdge& e : edges) binner.count(e.value);
  binner.allocate(std::numeric_limits<double>::max());
  for (const FlagEdge& e : edges) binner.add(e);
  edges = FlagEdges(edges.get_allocator());
  return binner.finish();
}

}  // namespace ph
