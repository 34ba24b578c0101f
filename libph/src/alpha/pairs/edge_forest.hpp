// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "libph/src/alpha/pairs/critical_simplices.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::alpha {

template <Field K>
struct EdgeTerm {
  std::uint32_t edge;
  typename K::Element coefficient;
};

/// The spanning forest of the edges that join components. It completes chains to cycles, because
/// the edges of a cycle outside the forest determine its edges in the forest.
template <Field K>
class EdgeForest {
 public:
  using Element = typename K::Element;

  /// @param joins for each edge: true if the edge is critical and joins components. (Edges that are
  /// paired with late vertices belong to the forest as well.)
  EdgeForest(const AlphaCells& cells, const SimplexSet& joins, const K& field,
             const RunContext& context)
      : cells_(cells),
        field_(field),
        context_(context),
        up_(cells.sites.size(), Up(), &context.memory),
        heap_(&context.memory) {
    std::pmr::vector<std::uint32_t> begin(up_.size() + 1, 0, &context.memory);
    const auto for_each_edge = [&](auto&& use) {
      for (std::uint32_t e = 0; e < cells.edge_states.size(); ++e)
        if (joins[e] || cells.edge_states[e].up == kJoins) use(e, cells.edges.ends[e]);
    };
    for_each_edge([&](std::uint32_t, const auto& ends) {
      ++begin[ends[0]];
      ++begin[ends[1]];
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& b : begin) b = sum += b;
    std::pmr::vector<std::uint32_t> around(sum, &context.memory);
    for_each_edge([&](std::uint32_t e, const auto& ends) {
      around[--begin[ends[0]]] = e;
      around[--begin[ends[1]]] = e;
    });
    std::pmr::vector<std::uint32_t> queue(&context.memory);
    Ticker ticker(context, "forest", up_.size());
    for (std::uint32_t first = 0; first < up_.size(); ++first) {
      if (up_[first].is_met) continue;
      up_[first].is_met = true;
      queue.assign(1, first);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        ticker.tick();
        const std::uint32_t from = queue[i];
        for (std::uint32_t k = begin[from]; k < begin[from + 1]; ++k) {
          const std::uint32_t e = around[k], to = other_end(e, from);
          if (up_[to].is_met) continue;
          up_[to] = {e, up_[from].depth + 1, true};
          queue.push_back(to);
        }
      }
    }
  }

  /// Completes a cycle: appends the terms inside the forest to the terms outside it.
  void close(std::pmr::vector<EdgeTerm<K>>& chain) {
    heap_.clear();
    for (const EdgeTerm<K>& term : chain) {
      const auto& ends = cells_.edges.ends[term.edge];
      heap_.push_back(at(ends[1], term.coefficient));
      heap_.push_back(at(ends[0], field_.negate(term.coefficient)));
    }
    std::ranges::make_heap(heap_, before);
    Ticker ticker(context_, {});
    while (!heap_.empty()) {
      ticker.work();
      AtVertex sum = pop();
      while (!heap_.empty() && heap_.front().vertex == sum.vertex)
        sum.amount = field_.add(sum.amount, pop().amount);
      const std::uint32_t e = up_[sum.vertex].edge;
      if (field_.is_zero(sum.amount) || e == kNone) continue;
      // Moves the boundary at this vertex to the other end of the edge.
      const bool goes_up = cells_.edges.ends[e][0] == sum.vertex;
      // mutant: alpha-cycle-sign
      chain.push_back({e, goes_up ? sum.amount : field_.negate(sum.amount)});
      heap_.push_back(at(other_end(e, sum.vertex), sum.amount));
      std::ranges::push_heap(heap_, before);
    }
  }

 private:
  struct Up {
    std::uint32_t edge = kNone, depth = 0;
    bool is_met = false;
  };
  /// A part of the coefficient that a vertex has in the boundary of a chain.
  struct AtVertex {
    std::uint32_t depth, vertex;
    Element amount;
  };
  AtVertex at(std::uint32_t vertex, Element amount) const {
    return {up_[vertex].depth, vertex, amount};
  }
  static bool before(const AtVertex& a, const AtVertex& b) {
    return a.depth != b.depth ? a.depth < b.depth : a.vertex < b.vertex;
  }
  AtVertex pop() {
    std::ranges::pop_heap(heap_, before);
    const AtVertex top = heap_.back();
    heap_.pop_back();
    return top;
  }
  std::uint32_t other_end(std::uint32_t e, std::uint32_t v) const {
    const auto& ends = cells_.edges.ends[e];
    return ends[0] == v ? ends[1] : ends[0];
  }

  const AlphaCells& cells_;
  const K& field_;
  const RunContext& context_;
  std::pmr::vector<Up> up_;  // for each vertex, the edge towards the root of its tree
  std::pmr::vector<AtVertex> heap_;
};

}  // namespace ph::alpha
