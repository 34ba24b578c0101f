// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/collapse/collapse_graph.hpp"
#include "ph/detail/core/bit_matrix.hpp"

namespace ph::collapse {

/// The graph of an edge collapse, for graphs whose rows of bits are affordable. Edges that entered
/// before the current edge are stored as rows of bits. Later edges that were kept are stored as
/// sorted lists.
class RowGraph {
 public:
  using Set = std::pmr::vector<BitMatrix::Word>;

  RowGraph(const RipsGraph& graph, std::pmr::memory_resource* memory)
      : edges_(graph.edges()),
        present_(static_cast<std::size_t>(graph.size()), static_cast<std::size_t>(graph.size()),
                 memory),
        later_(static_cast<std::size_t>(graph.size()), memory),
        also_(memory) {}

  /// The number of bytes that a RowGraph occupies, without the later edges.
  static double bytes(const RipsGraph& graph) {
    const auto n = static_cast<double>(graph.size());
    return n * n / 8 + 32 * n;
  }

  Set make_set() const { return Set(present_.words(), 0, later_.get_allocator().resource()); }

  /// Enters the edges up to key `last`.
  void enter_until(Key last) {
    for (; entered_ < last; ++entered_) {
      present_.set(edges_[entered_].u, edges_[entered_].v);
      present_.set(edges_[entered_].v, edges_[entered_].u);
    }
  }

  void find_link(const FlagEdge& e, Key now, Set& link) {
    present_key_ = now;
    const auto *u = present_.row(e.u), *v = present_.row(e.v);
    for (std::size_t k = 0; k < link.size(); ++k) link[k] = u[k] & v[k];
  }

  void find_arrivals(const FlagEdge& e, Key, std::pmr::vector<Arrival>& arrivals) const {
    arrivals.clear();
    const auto &of_u = later_[e.u], &of_v = later_[e.v];
    auto other = of_v.begin();
    for (const Neighbour& x : of_u) {
      for (; other != of_v.end() && other->vertex < x.vertex; ++other)
        if (present_.test(e.u, other->vertex)) arrivals.push_back({other->key, other->vertex});
      if (other != of_v.end() && other->vertex == x.vertex) {
        // mutant: collapse-row-arrival
        arrivals.push_back({std::max(x.key, other->key), x.vertex});
        ++other;
      } else if (present_.test(e.v, x.vertex)) {
        arrivals.push_back({x.key, x.vertex});
      }
    }
    for (; other != of_v.end(); ++other)
      if (present_.test(e.u, other->vertex)) arrivals.push_back({other->key, other->vertex});
  }

  bool are_joined(Vertex a, Vertex b, Key now) const {
    if (present_.test(a, b)) return true;
    if (now == present_key_) return false;
    const auto it = std::ranges::lower_bound(later_[a], b, {}, &Neighbour::vertex);
    // mutant: collapse-row-later
    return it != later_[a].end() && it->vertex == b && it->key <= now;
  }

  static bool contains(const Set& set, Vertex v) { return set[v / 64] >> (v % 64) & 1; }
  static void insert(Set& set, Vertex v) { set[v / 64] |= BitMatrix::Word{1} << (v % 64); }
  static Vertex first(const Set& set) {
    for (std::size_t k = 0; k < set.size(); ++k)
      if (set[k] != 0)
        return static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(set[k])));
    return kNone;
  }

  Vertex first_apart(const Set& link, Vertex c, Key now) const {
    const auto* row = present_.row(c);
    for (std::size_t k = 0;; ++k) {
      k = bits::first_outside(link.data(), row, k, link.size());
      if (k == link.size()) return kNone;
      for (auto rest = link[k] & ~row[k]; rest != 0; rest &= rest - 1) {
        const auto y =
            static_cast<Vertex>(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
        if (y != c && !are_joined(c, y, now)) return y;
      }
    }
  }

  void keep_neighbours(Set& set, Vertex w, Key now) {
    also_.clear();
    if (now != present_key_) {
      for (const Neighbour& x : later_[w])
        if (x.key <= now && contains(set, x.vertex)) also_.push_back(x.vertex);
    }
    const auto* row = present_.row(w);
    for (std::size_t k = 0; k < set.size(); ++k) set[k] &= row[k];
    for (const Vertex x : also_) insert(set, x);  // mutant: collapse-row-also
  }

  void move(const FlagEdge& e, Key to) {
    present_.clear(e.u, e.v);
    present_.clear(e.v, e.u);
    if (to == kNever) return;
    insert_later(e.u, {e.v, to});
    insert_later(e.v, {e.u, to});
  }
  /// Must be called once all edges of the same value are done. The collapse then continues with
  /// earlier edges, for which this edge is a later edge.
  void leave(const FlagEdge& e, Key now) { move(e, now); }

 private:
  void insert_later(Vertex u, const Neighbour& x) {
    auto& list = later_[u];
    list.insert(std::ranges::lower_bound(list, x.vertex, {}, &Neighbour::vertex), x);
  }

  std::span<const FlagEdge> edges_;
  Key entered_ = 0;
  Key present_key_ = 0;  // key of the current edge; the edges in later_ come after it
  BitMatrix present_;
  std::pmr::vector<std::pmr::vector<Neighbour>> later_;  // one list per vertex, sorted by neighbour
  std::pmr::vector<Vertex> also_;
};

}  // namespace ph::collapse
