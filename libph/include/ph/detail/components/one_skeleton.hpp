// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <memory_resource>
#include <numeric>
#include <span>
#include <vector>

#include "ph/detail/components/cell_map.hpp"
#include "ph/detail/components/elder_rule.hpp"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/core/polled_sort.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// The vertices and edges of a filtration, numbered and sorted for union-find. Vertices are
/// numbered in the order in which the filtration visits them; flag filtrations number their own
/// vertices. Precondition: `filtration.edges_join_vertices()`.
template <GraphFiltration F>
struct OneSkeleton {
  using Cell = typename F::Cell;

  OneSkeleton(const F& filtration, const RunContext& context)
      : vertices(&context.memory),
        age(&context.memory),
        edges(&context.memory),
        ends(&context.memory) {
    prepare_cells(filtration, context);
    if constexpr (FlagFiltration<F>)
      take_flag_graph(filtration);
    else
      collect(filtration, context);
  }

  std::pmr::vector<Cell> vertices;
  /// The position of each vertex in the order of the filtration, by vertex number.
  std::pmr::vector<std::uint32_t> age;
  std::pmr::vector<Cell> edges;      ///< in the order of the filtration
  std::pmr::vector<GraphEdge> ends;  ///< the vertex numbers of each edge; a loop joins 0 to 0

 private:
  void take_flag_graph(const F& filtration) {
    const auto size = static_cast<std::uint32_t>(filtration.vertex_count());
    vertices.reserve(size);
    for (std::uint32_t v = 0; v < size; ++v) vertices.push_back(filtration.vertex_cell(v));
    age = vertex_ages(size, filtration.vertex_births(), vertices.get_allocator().resource());
    const auto flag_edges = filtration.binned_edges().sorted();
    edges.reserve(flag_edges.size());
    ends.reserve(flag_edges.size());
    for (std::uint32_t e = 0; e < flag_edges.size(); ++e) {
      edges.push_back(filtration.edge_cell(e));
      ends.push_back({flag_edges[e].u, flag_edges[e].v});
    }
  }

  void collect(const F& filtration, const RunContext& context) {
    const auto precedes = [&](const Cell& a, const Cell& b) { return filtration.precedes(a, b); };
    CellMap<F> number(filtration, &context.memory);
    filtration.for_each_cell(0, [&](const Cell& v) {
      number.insert(v, static_cast<std::uint32_t>(vertices.size()));
      vertices.push_back(v);
    });
    std::pmr::vector<std::uint32_t> order(vertices.size(), &context.memory);
    std::iota(order.begin(), order.end(), 0U);
    Ticker ticker(context, "graph");
    const auto value_of = [&](std::uint32_t v) { return filtration.value(vertices[v]) + 0.0; };
    const auto comes_before = [&](std::uint32_t a, std::uint32_t b) {
      return precedes(vertices[a], vertices[b]);
    };
    radix_sort_by_value(order, value_of, context);
    for (auto begin = order.begin(), end = begin; begin != order.end(); begin = end) {
      end =
          std::find_if(begin, order.end(), [&](auto v) { return value_of(v) != value_of(*begin); });
      std::span ties(begin, end);
      if (!std::ranges::is_sorted(ties, comes_before)) polled_sort(ties, comes_before, ticker);
    }
    age.resize(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) age[order[i]] = i;

    filtration.for_each_cell(1, [&](const Cell& e) { edges.push_back(e); });
    if (!std::ranges::is_sorted(edges, precedes)) polled_sort(edges, precedes, ticker);
    ends.reserve(edges.size());
    for (const Cell& e : edges) {
      GraphEdge edge;
      int count = 0;
      filtration.for_each_facet(
          1, e, [&](const Cell& v, int) { (count++ == 0 ? edge.u : edge.v) = number.find(v); });
      ends.push_back(count == 2 ? edge : GraphEdge{});
    }
  }
};

}  // namespace ph
