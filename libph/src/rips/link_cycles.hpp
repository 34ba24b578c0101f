// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory_resource>
#include <utility>
#include <vector>

#include "libph/src/rips/annotations/annotations.hpp"
#include "libph/src/rips/sweep/link_graph.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// Finds cycles for the classes of H1 in a sweep of edge links. The cycle of a generator of H^1
/// consists of the edge that gave birth to the generator and of a path with as few older edges as
/// possible.
///
/// On this cycle z_g, the generator g has the value one, younger generators have the value zero,
/// and older generators have any value. A class of homology, given by its values under the
/// generators, is therefore a combination of cycles z_g. The coefficients are found one after
/// another, for the youngest generator first. The class is born with the youngest generator of the
/// combination. See docs/explanation/engines/edge-links.md.
template <Field K>
class LinkCycles {
 public:
  using Vertex = LinkGraph::Vertex;
  using Generator = typename Annotations<K>::Generator;
  using Element = typename K::Element;

  /// @param graph, annotations must outlive this object.
  LinkCycles(const LinkGraph& graph, Annotations<K>& annotations, const K& field,
             std::pmr::memory_resource* memory)
      : graph_(graph),
        annotations_(annotations),
        field_(field),
        paths_(memory),
        unvisited_((graph.vertex_count() + 63) / 64, 0, memory),
        before_(graph.vertex_count(), 0, memory),
        queue_(memory),
        values_(memory),
        terms_(memory) {}

  /// Adds the cycle of the next generator, in the order of the generators' numbers. @param u, v the
  /// ends of its edge, which must be connected in the graph without that edge. The generator has
  /// the value one from u to v.
  void add(Vertex u, Vertex v) { paths_.push_back(shortest_path(v, u)); }
  /// Frees the cycle of a dead generator, which is no longer needed.
  void erase(Generator g) { paths_[g] = Path(paths_.get_allocator()); }

  /// Finds a cycle on which each generator has the value that it has in `values`, and calls
  /// `visit(larger end, smaller end, coefficient)` once per edge.
  template <class Visit>
  void for_each_term(typename Annotations<K>::Class values, Visit&& visit);
  /// The cycle of one generator.
  template <class Visit>
  void for_each_term(Generator g, Visit&& visit) {
    terms_.clear();
    add_terms(g, field_.from_int(1));
    visit_terms(visit);
  }

 private:
  using Path = std::pmr::vector<Vertex>;
  template <class Key>
  using Sums = std::pmr::map<Key, Element>;

  Path shortest_path(Vertex from, Vertex to);
  /// Calls `visit(from, to)` for all consecutive vertices of the cycle of g, which starts with g's
  /// own edge.
  template <class Visit>
  void for_each_step(Generator g, Visit&& visit) const {
    const Path& path = paths_[g];
    visit(path.back(), path.front());
    for (std::size_t i = 0; i + 1 < path.size(); ++i) visit(path[i], path[i + 1]);
  }
  void add_terms(Generator g, Element scale) {
    for_each_step(g, [&](Vertex from, Vertex to) {
      if (from > to)
        add(terms_, std::pair{from, to}, scale);
      else
        add(terms_, std::pair{to, from}, field_.negate(scale));
    });
  }
  template <class Visit>
  void visit_terms(Visit&& visit) const {
    for (const auto& [edge, value] : terms_) visit(edge.first, edge.second, value);
  }
  template <class Key>
  void add(Sums<Key>& sums, const Key& key, Element value) {
    const auto [it, is_new] = sums.try_emplace(key, value);
    if (is_new) return;
    it->second = field_.add(it->second, value);
    if (field_.is_zero(it->second)) sums.erase(it);
  }

  const LinkGraph& graph_;
  Annotations<K>& annotations_;
  const K& field_;
  // For each generator, the path from the end of its edge to the start.
  std::pmr::vector<Path> paths_;
  std::pmr::vector<LinkGraph::Word> unvisited_;
  std::pmr::vector<Vertex> before_;  // for each vertex, the vertex from which it was reached
  std::pmr::vector<Vertex> queue_;
  Sums<Generator> values_;
  Sums<std::pair<Vertex, Vertex>> terms_;
};

template <Field K>
auto LinkCycles<K>::shortest_path(Vertex from, Vertex to) -> Path {
  std::ranges::fill(unvisited_, ~LinkGraph::Word{0});
  const auto visit = [&](Vertex v, Vertex before) {
    unvisited_[v / 64] &= ~(LinkGraph::Word{1} << (v % 64));
    before_[v] = before;
    queue_.push_back(v);
  };
  queue_.clear();
  visit(to, to);
  for (std::size_t next = 0; queue_[next] != from; ++next) {
    const Vertex v = queue_[next];
    graph_.for_each_neighbour(v, unvisited_.data(), [&](Vertex w) { visit(w, v); });
  }
  Path path(paths_.get_allocator());
  for (Vertex v = from; v != to; v = before_[v]) path.push_back(v);
  path.push_back(to);
  return path;
}

template <Field K>
template <class Visit>
void LinkCycles<K>::for_each_term(typename Annotations<K>::Class values, Visit&& visit) {
  terms_.clear();
  values_.clear();
  const auto add_values = [&](typename Annotations<K>::Class a, Element scale) {
    annotations_.for_each_generator(
        a, [&](Generator g, Element value) { add(values_, g, field_.multiply(scale, value)); });
  };
  add_values(values, field_.from_int(1));
  while (!values_.empty()) {
    const auto [g, value] = *values_.rbegin();
    add_terms(g, value);
    for_each_step(
        g, [&](Vertex u, Vertex v) { add_values(annotations_.of(u, v), field_.negate(value)); });
  }
  visit_terms(visit);
}

}  // namespace ph
