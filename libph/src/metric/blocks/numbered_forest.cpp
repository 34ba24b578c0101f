// SPDX-License-Identifier: MIT
#include "libph/src/metric/blocks/numbered_forest.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

bool is_same(const FlagEdge& a, const FlagEdge& b) {
  return a.value == b.value && a.u == b.u && a.v == b.v;
}

/// The union of two ascending lists of numbers. For each entry of the two lists, `places` gives its
/// position in the union.
struct Merged {
  std::pmr::vector<Index> numbers;
  std::pmr::vector<std::uint32_t> places[2];
};
Merged merged(const std::pmr::vector<Index>& a, const std::pmr::vector<Index>& b,
              const RunContext& context) {
  using Places = std::pmr::vector<std::uint32_t>;
  Merged all{std::pmr::vector<Index>(a.get_allocator()),
             {Places(&context.memory), Places(&context.memory)}};
  std::size_t size = a.size() + b.size();
  {
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
      const Index x = a[i], y = b[j];
      if (x == y) --size;
      i += x <= y ? 1 : 0;
      j += y <= x ? 1 : 0;
    }
  }
  if (size >= UINT32_MAX)
    throw Error(ErrorKind::resource,
                "parts of a cloud: found 2^32 - 1 points or more in the joined parts");
  all.numbers.reserve(size);
  all.places[0].reserve(a.size());
  all.places[1].reserve(b.size());
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const bool is_of_a = j == b.size() || (i < a.size() && a[i] <= b[j]);
    const bool is_of_b = i == a.size() || (j < b.size() && b[j] <= a[i]);
    const auto place = static_cast<std::uint32_t>(all.numbers.size());
    all.numbers.push_back(is_of_a ? a[i] : b[j]);
    if (is_of_a) {
      all.places[0].push_back(place);
      ++i;
    }
    if (is_of_b) {
      all.places[1].push_back(place);
      ++j;
    }
  }
  return all;
}

/// Merges two lists of edges, and leaves both lists empty.
FlagEdges merged(FlagEdges& a, FlagEdges& b, const Merged& all, const RunContext& context) {
  const auto renumber = [](FlagEdges& edges, const std::pmr::vector<std::uint32_t>& places) {
    for (FlagEdge& e : edges) e = {e.value, places[e.u], places[e.v]};
  };
  renumber(a, all.places[0]);
  renumber(b, all.places[1]);
  context.poll();
  FlagEdges both(a.get_allocator());
  both.reserve(a.size() + b.size());
  std::ranges::merge(a, b, std::back_inserter(both), precedes);
  a = FlagEdges(a.get_allocator());
  b = FlagEdges(b.get_allocator());
  return both;
}

}  // namespace

void NumberedForest::join(NumberedForest other, const RunContext& context) {
  context.poll();
  Merged all = merged(numbers, other.numbers, context);
  numbers = std::move(all.numbers);
  other.numbers = std::pmr::vector<Index>(other.numbers.get_allocator());
  edges = merged(edges, other.edges, all, context);
  claims = merged(claims, other.claims, all, context);
  all.places[0] = all.places[1] = std::pmr::vector<std::uint32_t>(&context.memory);
  reduce(context);
}

void NumberedForest::reduce(const RunContext& context) {
  DisjointSets sets(numbers.size(), &context.memory);
  Ticker ticker(context, "spanning forest", edges.size());
  auto next = claims.begin(), kept = claims.begin();
  const auto look_at_claims = [&](double below) {
    for (; next != claims.end() && next->value < below; ++next)  // mutant: cloud-claims
      if (sets.find(next->u) != sets.find(next->v)) *kept++ = *next;
  };
  std::size_t taken = 0;
  for (const FlagEdge& e : edges) {
    ticker.tick();
    look_at_claims(e.value);
    const std::uint32_t u = sets.find(e.u), v = sets.find(e.v);
    if (u == v) continue;
    sets.link(std::max(u, v), std::min(u, v));
    edges[taken++] = e;
  }
  edges.resize(taken);
  look_at_claims(std::numeric_limits<double>::infinity());
  claims.erase(std::unique(claims.begin(), kept, is_same), claims.end());
}

void sort_edges(FlagEdges& edges, const RunContext& context) {
  radix_sort_by_value(
      edges, [](const FlagEdge& e) { return e.value; }, context);
  for (auto begin = edges.begin(), end = begin; begin != edges.end(); begin = end) {
    end = std::find_if(begin, edges.end(),
                       [&](const FlagEdge& e) { return e.value != begin->value; });
    if (end - begin > 1) std::sort(begin, end, precedes);
  }
}

}  // namespace ph
