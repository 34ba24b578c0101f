// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The vertices of each component, linked as a ring: a walk around the ring may start at any
/// vertex.
class ComponentRings {
 public:
  ComponentRings(std::size_t size, std::pmr::memory_resource* memory) : next_(size, memory) {
    std::iota(next_.begin(), next_.end(), 0U);
  }
  /// Precondition: the vertices are in different components.
  void join(std::uint32_t u, std::uint32_t v) { std::swap(next_[u], next_[v]); }
  template <class Visit>
  void for_each(std::uint32_t of, Visit&& visit) const {
    std::uint32_t v = of;
    do visit(v);
    while ((v = next_[v]) != of);
  }

 private:
  std::pmr::vector<std::uint32_t> next_;
};

/// Returns the position of each vertex in the order of (birth, number). @param births if empty, all
/// births are equal.
inline std::pmr::vector<std::uint32_t> vertex_ages(std::size_t size, std::span<const double> births,
                                                   std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> order(size, memory);
  std::iota(order.begin(), order.end(), 0U);
  if (births.empty()) return order;
  std::ranges::sort(order, [&](std::uint32_t u, std::uint32_t v) {
    return births[u] != births[v] ? births[u] < births[v] : u < v;
  });
  std::pmr::vector<std::uint32_t> age(size, memory);
  for (std::uint32_t i = 0; i < size; ++i) age[order[i]] = i;
  return age;
}

/// An edge of a filtered graph; the two ends of a loop are equal.
struct GraphEdge {
  std::uint32_t u = 0, v = 0;
};

/// Kruskal's algorithm with the elder rule (Edelsbrunner & Harer, Computational Topology, VII.2):
/// when an edge joins two components, the component whose oldest vertex is the younger of the two
/// dies.
/// @param age the position of each vertex in the order of the filtration.
/// @param edges in the order of the filtration.
/// @param on_merge called with (position of the edge, oldest vertex of the elder component, oldest
///        vertex of the younger one).
template <class OnMerge>
void join_by_elder_rule(std::span<const std::uint32_t> age, std::span<const GraphEdge> edges,
                        const RunContext& context, OnMerge&& on_merge) {
  DisjointSets sets(age.size(), &context.memory);
  Ticker ticker(context, "components", edges.size());
  std::size_t components = age.size();
  // The root of each set is its oldest vertex.
  for (std::size_t i = 0; i < edges.size() && components > 1; ++i) {
    ticker.tick();
    std::uint32_t elder = sets.find(edges[i].u), younger = sets.find(edges[i].v);
    if (elder == younger) continue;
    if (age[younger] < age[elder]) std::swap(elder, younger);  // mutant: elder-rule
    sets.link(younger, elder);
    --components;
    on_merge(i, elder, younger);
  }
}

}  // namespace ph
