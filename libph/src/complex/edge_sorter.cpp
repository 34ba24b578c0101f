// SPDX-License-Identifier: MIT
#include "ph/complex/edge_sorter.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

namespace ph {
namespace {

// Not the function itself: a call through a pointer is not inlined.
constexpr auto kInOrder = [](const FlagEdge& a, const FlagEdge& b) { return precedes(a, b); };

// Sorts edges whose values share the bits from `shift` on: once more into bins by the next bits,
// until there are few in each.
void sort_bin(std::span<FlagEdge> edges, int shift, std::pmr::vector<FlagEdge>& buffer) {
  constexpr std::size_t few = 64;
  constexpr int digit_bits = 11;
  // Ties arrive in order from a matrix: integers are sorted when they come.
  if (edges.size() <= few || shift < digit_bits ||
      std::is_sorted(edges.begin(), edges.end(), kInOrder)) {
    std::sort(edges.begin(), edges.end(), kInOrder);
    return;
  }
  const int next_shift = shift - digit_bits;
  const auto digit = [&](const FlagEdge& e) {
    return std::bit_cast<std::uint64_t>(e.value) >> next_shift & ((1U << digit_bits) - 1);
  };
  std::array<std::size_t, (1U << digit_bits) + 1> begin{};
  for (const FlagEdge& e : edges) ++begin[digit(e) + 1];
  for (std::size_t d = 0; d + 1 < begin.size(); ++d) begin[d + 1] += begin[d];
  buffer.assign(edges.begin(), edges.end());
  std::array<std::size_t, (1U << digit_bits) + 1> next = begin;
  for (const FlagEdge& e : buffer) edges[next[digit(e)]++] = e;
  for (std::size_t d = 0; d + 1 < begin.size(); ++d)
    sort_bin(edges.subspan(begin[d], begin[d + 1] - begin[d]), next_shift, buffer);
}

}  // namespace

void EdgeSorter::allocate(double limit) {
  last_bin_ = bin_of(limit);
  std::size_t sum = 0;
  for (std::size_t bin = 0; bin <= last_bin_; ++bin) sum += std::exchange(counts_[bin], sum);
  edges_.resize(sum);
}

std::pmr::vector<FlagEdge> EdgeSorter::finish() {
  std::pmr::vector<FlagEdge> buffer(&context_.memory);
  std::size_t begin = 0;
  for (std::size_t bin = 0; bin <= last_bin_; ++bin) {
    const std::size_t end = counts_[bin];
    if (end == begin) continue;
    context_.poll();
    sort_bin(std::span(edges_).subspan(begin, end - begin), shift_, buffer);
    begin = end;
  }
  edges_.resize(begin);  // in the last bin not all were within the limit
  return std::move(edges_);
}

void sort_edges(std::pmr::vector<FlagEdge>& edges, const RunContext& context) {
  context.poll();
  EdgeSorter sorter(edges.size(), context);
  for (const FlagEdge& e : edges) sorter.count(e.value);
  sorter.allocate(std::numeric_limits<double>::max());
  for (const FlagEdge& e : edges) sorter.add(e);
  edges.clear();
  edges.shrink_to_fit();
  edges = sorter.finish();
}

}  // namespace ph
