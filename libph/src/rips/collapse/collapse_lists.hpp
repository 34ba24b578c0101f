// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/collapse/collapse_graph.hpp"

namespace ph::collapse {

/// The graph of an edge collapse, for large graphs with few edges. For each vertex, it has the
/// sorted list of neighbours, each with the key at which its edge enters.
class ListGraph {
 public:
  using Set = std::pmr::vector<Vertex>;  // ascending

  ListGraph(const RipsGraph& graph, std::pmr::memory_resource* memory)
      : begins_(static_cast<std::size_t>(graph.size()) + 1, 0, memory),
        sizes_(static_cast<std::size_t>(graph.size()), 0, memory),
        neighbours_(2 * graph.edge_count(), memory) {
    const std::span<const FlagEdge> edges = graph.edges();
    for (const FlagEdge& e : edges) {
      ++begins_[e.u + 1];
      ++begins_[e.v + 1];
    }
    for (std::size_t v = 1; v < begins_.size(); ++v) begins_[v] += begins_[v - 1];
    const auto append = [&](Vertex u, const Neighbour& x) {
      neighbours_[begins_[u] + sizes_[u]++] = x;
    };
    for (std::size_t end = edges.size(); end > 0;) {
      const auto key = static_cast<Key>(end);
      for (const double value = edges[end - 1].value; end > 0 && edges[end - 1].value == value;
           --end) {
        append(edges[end - 1].u, {edges[end - 1].v, key});
        append(edges[end - 1].v, {edges[end - 1].u, key});
      }
    }
    for (Vertex v = 0; v < sizes_.size(); ++v) std::ranges::sort(list(v), {}, &Neighbour::vertex);
  }

  /// The number of bytes that a ListGraph occupies.
  static double bytes(const RipsGraph& graph) {
    return 16 * static_cast<double>(graph.edge_count()) + 12 * static_cast<double>(graph.size());
  }

  Set make_set() const { return Set(neighbours_.get_allocator().resource()); }
  void enter_until(Key) {}

  void find_link(const FlagEdge& e, Key now, Set& link) const {
    link.clear();
    for_each_common(e, [&](Vertex x, Key key) {
      if (key <= now) link.push_back(x);  // mutant: collapse-list-link
    });
  }
  void find_arrivals(const FlagEdge& e, Key now, std::pmr::vector<Arrival>& arrivals) const {
    arrivals.clear();
    for_each_common(e, [&](Vertex x, Key key) {
      if (key > now) arrivals.push_back({key, x});
    });
  }

  bool are_joined(Vertex a, Vertex b, Key now) const {
    const auto of_a = list(a);
    const auto it = std::ranges::lower_bound(of_a, b, {}, &Neighbour::vertex);
    return it != of_a.end() && it->vertex == b && it->key <= now;
  }

  static bool contains(const Set& set, Vertex v) {
    return std::binary_search(set.begin(), set.end(), v);
  }
  static void insert(Set& set, Vertex v) {
    set.insert(std::lower_bound(set.begin(), set.end(), v), v);
  }
  static Vertex first(const Set& set) { return set.empty() ? kNone : set.front(); }

  Vertex first_apart(const Set& link, Vertex c, Key now) const {
    const auto of_c = list(c);
    auto it = of_c.begin();
    for (const Vertex y : link) {
      if (y == c) continue;
      while (it != of_c.end() && it->vertex < y) ++it;
      if (it == of_c.end() || it->vertex != y || it->key > now) return y;
    }
    return kNone;
  }

  void keep_neighbours(Set& set, Vertex w, Key now) const {
    const auto of_w = list(w);
    auto it = of_w.begin();
    std::erase_if(set, [&](Vertex x) {
      while (it != of_w.end() && it->vertex < x) ++it;
      return it == of_w.end() || it->vertex != x || it->key > now;
    });
  }

  void move(const FlagEdge& e, Key to) {
    move_at(e.u, e.v, to);
    move_at(e.v, e.u, to);
  }
  void leave(const FlagEdge&, Key) {}

 private:
  std::span<Neighbour> list(Vertex v) {
    return std::span(neighbours_).subspan(begins_[v], sizes_[v]);
  }
  std::span<const Neighbour> list(Vertex v) const {
    return std::span(neighbours_).subspan(begins_[v], sizes_[v]);
  }

  /// Calls `visit(vertex, key)` for each vertex that is joined to both ends at any time.
  template <class Visit>
  void for_each_common(const FlagEdge& e, Visit&& visit) const {
    const auto of_u = list(e.u), of_v = list(e.v);
    auto other = of_v.begin();
    for (const Neighbour& x : of_u) {
      while (other != of_v.end() && other->vertex < x.vertex) ++other;
      if (other == of_v.end()) return;
      if (other->vertex == x.vertex) visit(x.vertex, std::max(x.key, other->key));
    }
  }

  void move_at(Vertex u, Vertex v, Key to) {
    const auto of_u = list(u);
    const auto it = std::ranges::lower_bound(of_u, v, {}, &Neighbour::vertex);
    if (to != kNever) {
      it->key = to;
    } else {
      std::move(it + 1, of_u.end(), it);
      --sizes_[u];
    }
  }

  std::pmr::vector<std::size_t> begins_;   // start of each vertex's list
  std::pmr::vector<std::uint32_t> sizes_;  // number of neighbours left at each vertex
  std::pmr::vector<Neighbour> neighbours_;
};

}  // namespace ph::collapse
