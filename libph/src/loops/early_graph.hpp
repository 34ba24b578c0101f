// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "ph/detail/rips/rips_graph.hpp"

namespace ph::detail {

/// The edges of a RipsGraph up to the value at which the last loop is born. The neighbours of each
/// vertex are sorted by the order of their edges. The neighbours at any earlier value are therefore
/// the first ones in each list.
class EarlyGraph {
 public:
  using Key = RipsGraph::Key;
  struct Neighbour {
    std::uint32_t vertex;
    Key key;
  };

  /// @param last edges with larger values are left out.
  EarlyGraph(const RipsGraph& graph, double last, const RunContext& context)
      : graph_(graph), last_value_(last), offsets_(&context.memory), neighbours_(&context.memory) {
    edges_ = edges_up_to(last);
    const auto n = static_cast<std::size_t>(graph.size());
    offsets_.assign(n + 1, 0);
    for (Key key = 1; key <= edges_; ++key) {
      ++offsets_[graph.edge(key).u + 1];
      ++offsets_[graph.edge(key).v + 1];
    }
    for (std::size_t v = 0; v < n; ++v) offsets_[v + 1] += offsets_[v];
    neighbours_.resize(offsets_.back());
    std::pmr::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1, &context.memory);
    for (Key key = 1; key <= edges_; ++key) {
      const FlagEdge& e = graph.edge(key);
      neighbours_[next[e.u]++] = {e.v, key};
      neighbours_[next[e.v]++] = {e.u, key};
    }
  }

  std::size_t vertices() const { return offsets_.size() - 1; }
  Key edges() const { return edges_; }
  double last_value() const { return last_value_; }
  /// The number of edges with a value <= `last`. It is also the key of the last such edge.
  Key edges_up_to(double last) const {
    // Reading an edge sorts all edges before it. The search therefore starts at the first edge and
    // doubles its steps, so that it reads no edge beyond twice the result.
    const Key all = static_cast<Key>(graph_.edge_count());
    Key low = 0, high = std::min<Key>(1, all);
    while (high < all && graph_.value(high) <= last) {
      low = high;
      high = high < all / 2 ? 2 * high : all;
    }
    while (low < high) {
      const Key middle = low + (high - low) / 2;
      if (graph_.value(middle + 1) <= last)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }
  double value(Key key) const { return graph_.value(key); }
  const FlagEdge& edge(Key key) const { return graph_.edge(key); }

  /// Calls `use(vertex, key)` for each neighbour of v along the edges up to `limit`, except along
  /// the edge `except`.
  template <class Use>
  void for_each_neighbour(std::uint32_t v, Key limit, Key except, Use&& use) const {
    for (const Neighbour& n : neighbours(v)) {
      if (n.key > limit) return;  // mutant: loops-edge-age
      if (n.key != except) use(n.vertex, n.key);
    }
  }
  /// The key of the edge between u and v. Returns nothing if no early edge joins them.
  std::optional<Key> key_of(std::uint32_t u, std::uint32_t v) const {
    const auto of_u = neighbours(u), of_v = neighbours(v);
    const bool u_has_fewer = of_u.size() <= of_v.size();
    for (const Neighbour& n : u_has_fewer ? of_u : of_v)
      if (n.vertex == (u_has_fewer ? v : u)) return n.key;
    return std::nullopt;
  }
  /// The vertex that represents a point. Precondition: the point has a vertex.
  std::uint32_t vertex_of(Index point) const {
    if (!graph_.has_names())
      return static_cast<std::uint32_t>(std::clamp<Index>(point, 0, graph_.size() - 1));
    std::uint32_t low = 0, high = static_cast<std::uint32_t>(graph_.size());  // names ascend
    while (low + 1 < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      (graph_.name(middle) <= point ? low : high) = middle;
    }
    return low;
  }
  Index name(std::uint32_t v) const { return graph_.name(v); }

 private:
  std::span<const Neighbour> neighbours(std::uint32_t v) const {
    return std::span(neighbours_).subspan(offsets_[v], offsets_[v + 1] - offsets_[v]);
  }

  const RipsGraph& graph_;
  double last_value_;
  Key edges_ = 0;
  std::pmr::vector<std::size_t> offsets_;
  std::pmr::vector<Neighbour> neighbours_;
};

}  // namespace ph::detail
