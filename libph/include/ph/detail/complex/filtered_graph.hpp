// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/filtration.hpp"
#include "ph/run_context.hpp"
#include "ph/sparse_distances.hpp"

namespace ph {

/// A graph whose vertices and edges have values, as a filtration. It is enough for H0 and the merge
/// tree, and takes 16 bytes per edge. Vertices and edges with the value +infinity never enter.
/// Order: (value, dimension, vertex number or position of the edge).
class FilteredGraph {
 public:
  /// Vertex v is cell v; the edge at position i of the order is cell vertex_count() + i.
  using Cell = std::uint32_t;

  /// @param births a value for each vertex 0 … size-1. @param edges in any order; parallel edges
  /// and loops are allowed; ties are broken by position. O(vertices + edges log edges).
  /// @throws Error (bad_data) on NaN, on a vertex out of range and on an edge that enters before
  ///         one of its ends; Error (resource) beyond 2^32 - 2 cells or the memory limit.
  FilteredGraph(std::span<const double> births, std::span<const WeightedEdge> edges,
                const RunContext& context = default_context());

  /// The lower-star filtration of a graph: each edge enters with the later of its ends.
  /// @param edges the edges, whose values are ignored. O(vertices log vertices + edges).
  static FilteredGraph lower_star(std::span<const double> vertex_values,
                                  std::span<const WeightedEdge> edges,
                                  const RunContext& context = default_context());

  Index size() const { return static_cast<Index>(births_.size()); }
  std::size_t edge_count() const { return edges_.size(); }  ///< number of edges that enter
  /// Number of vertices, including vertices that never enter.
  std::size_t vertex_count() const { return births_.size(); }
  static std::size_t vertex_number(Cell vertex) { return vertex; }

  int top_dim() const { return none_enters_ ? -1 : edges_.empty() ? 0 : 1; }
  double value(Cell c) const {
    return c < births_.size() ? births_[c] : edges_[c - births_.size()].value;
  }
  bool precedes(Cell a, Cell b) const {
    if (a < births_.size() && births_[a] != births_[b]) return births_[a] < births_[b];
    return a < b;
  }
  std::size_t slot_count() const { return births_.size() + edges_.size(); }
  static std::size_t slot(Cell c) { return c; }
  static bool edges_join_vertices() { return true; }
  static CellKind cell_kind() { return CellKind::vertices; }
  void append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const;

  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    const auto vertices = static_cast<Cell>(births_.size());
    const auto cells = static_cast<Cell>(slot_count());
    if (dim == 0)
      for (Cell v = 0; v < vertices; ++v)
        // mutant: graph-infinite
        if (births_[v] < std::numeric_limits<double>::infinity()) visit(v);
    if (dim == 1)
      for (Cell e = vertices; e < cells; ++e) visit(e);
  }
  template <class Visit>
  void for_each_facet(int dim, Cell cell, Visit&& visit) const {
    if (dim != 1) return;
    const Edge& e = edges_[cell - births_.size()];
    if (e.u == e.v) return;  // the two ends of a loop cancel
    visit(Cell{e.v}, 1);
    visit(Cell{e.u}, -1);
  }

 private:
  struct Edge {
    std::uint32_t u, v;  // u <= v
    double value;
  };
  FilteredGraph(std::span<const double> births, std::size_t edge_count, const RunContext& context);
  /// The edge with the value of its later end. @throws Error (bad_data) on a vertex out of range.
  Edge edge_between(const WeightedEdge& edge) const;

  /// Removes the edges that never enter, which come last in the order.
  void leave_out_what_never_enters();

  std::pmr::vector<double> births_;
  std::pmr::vector<Edge> edges_;  // in the order of the filtration
  bool none_enters_ = true;       // no vertex enters
};

}  // namespace ph
