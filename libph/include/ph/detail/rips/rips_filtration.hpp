// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/rips/key_block.hpp"
#include "ph/detail/rips/packed_vertices.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/detail/rips/rips_groups.hpp"
#include "ph/error.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// The place where keys are looked up: a square matrix, sorted neighbour lists, or whichever of the
/// two the graph has.
enum class RipsLayout { dense, sparse, any };

/// A simplex with the key of its longest edge.
template <int Words>
struct RipsCell {
  RipsGraph::Key key = 0;
  PackedVertices<Words> vertices;
  friend bool operator==(const RipsCell&, const RipsCell&) = default;
};

/// The flag complex of a RipsGraph as an engine sees it; no simplex is stored. Order: (key of the
/// longest edge, dimension, vertices read from the largest down); vertices with births of their own
/// are ordered by birth first.
/// @tparam Words the size of a cell, which limits the number of vertices and their bits.
template <RipsLayout Layout, int Words>
class RipsFiltration {
 public:
  using Key = RipsGraph::Key;
  using Vertices = PackedVertices<Words>;

  using Cell = RipsCell<Words>;
  static constexpr bool first_equal_cofacet_is_oldest = true;
  static constexpr int kMostVertices = 64 * Words < 256 ? 64 * Words : 256;

  explicit RipsFiltration(const RipsGraph& graph)
      : graph_(graph),
        bits_(std::max(1, static_cast<int>(std::bit_width(
                              static_cast<std::uint64_t>(std::max<Index>(graph.size() - 1, 0)))))) {
  }

  /// The number of vertices that a cell of `Words` words can hold for a graph of that size.
  static int capacity(const RipsGraph& graph) {
    return std::min(kMostVertices, Vertices::kBits / RipsFiltration(graph).bits_);
  }

  int top_dim() const {
    return static_cast<int>(std::min<Index>(adjacency().clique_bound(), capacity(graph_))) - 1;
  }
  Key key(const Cell& c) const { return c.key; }
  double value(const Cell& c) const {
    return c.key == 0 ? graph_.birth(vertex(c, 0)) : graph_.value(c.key);
  }
  bool precedes(const Cell& a, const Cell& b) const {
    if (a.key != b.key) return a.key < b.key;
    // mutant: weights-vertex-order
    if (a.key == 0 && value(a) != value(b)) return value(a) < value(b);
    return a.vertices < b.vertices;  // mutant: rips-tie-break
  }
  static bool edges_join_vertices() { return true; }
  static CellKind cell_kind() { return CellKind::vertices; }
  void append_input_cell(int dim, const Cell& cell, std::vector<Index>& numbers) const {
    for (int slot = 0; slot <= dim; ++slot) numbers.push_back(graph_.name(vertex(cell, slot)));
  }

  std::size_t vertex_count() const { return static_cast<std::size_t>(graph_.size()); }
  std::span<const double> vertex_births() const { return graph_.births(); }
  const BinnedEdges& binned_edges() const { return graph_.binned_edges(); }
  /// The points if the graph holds no edges, for engines that need only points; otherwise null.
  const PointsView* points_alone() const { return graph_.points_alone(); }
  double threshold() const { return graph_.threshold(); }
  Cell vertex_cell(std::uint32_t v) const { return {0, Vertices(v)}; }
  Cell edge_cell(std::uint32_t position) const {
    const FlagEdge& e = graph_.edge(position + 1);
    return {position + 1, Vertices(e.u) << bits_ | Vertices(e.v)};
  }
  std::uint32_t edge_position(std::uint32_t u, std::uint32_t v) const {
    return adjacency().key_of(u, v) - 1;
  }
  Cell triangle_cell(std::uint32_t longest, std::uint32_t apex) const {
    return over_edge(longest, std::array{apex});
  }
  Cell tetrahedron_cell(std::uint32_t longest, std::uint32_t w, std::uint32_t x) const {
    return over_edge(longest, std::array{std::max(w, x), std::min(w, x)});
  }
  Cell pentachoron_cell(std::uint32_t longest, const std::array<std::uint32_t, 3>& others) const {
    return over_edge(longest, others);
  }
  Cell triangle_cell_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const RipsAdjacency& adjacent = adjacency();
    return {std::max({adjacent.key_of(b, a), adjacent.key_of(c, a), adjacent.key_of(c, b)}),
            (Vertices(c) << bits_ | Vertices(b)) << bits_ | Vertices(a)};
  }

  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const;
  template <class Visit>
  void for_each_facet(int dim, const Cell& cell, Visit&& visit) const;
  template <class Visit>
  void for_each_cofacet(int dim, const Cell& cell, Visit&& visit) const {
    for_each_cofacet_within(dim, cell, 0, RipsAdjacency::kNever - 1, visit);
  }
  /// A member that RangeFiltration requires.
  template <class Visit>
  void for_each_cofacet_within(int dim, const Cell& cell, Key first, Key last, Visit&& visit) const;
  Key horizon(Key key) const;

  /// The members that ApparentFiltration requires. A group has the simplices that share a longest
  /// edge.
  std::optional<Cell> apparent_cofacet(int dim, const Cell& cell) const;
  std::optional<Cell> apparent_facet(int dim, const Cell& cell) const;
  std::size_t group_count() const { return graph_.edge_count(); }
  class UnmatchedCells;
  UnmatchedCells unmatched_cells(int dim) const { return UnmatchedCells(*this, dim); }

 private:
  using Neighbour = RipsAdjacency::Neighbour;

  const RipsAdjacency& adjacency() const { return graph_.adjacency(); }
  bool has_matrix() const {
    if constexpr (Layout == RipsLayout::any)
      return adjacency().has_matrix();
    else
      return Layout == RipsLayout::dense;
  }
  std::uint32_t vertex(const Cell& cell, int slot) const {
    return static_cast<std::uint32_t>((cell.vertices >> (slot * bits_)).low_bits(bits_));
  }
  /// The simplex with the ends of an edge and the vertices `others`, which must descend.
  Cell over_edge(std::uint32_t longest, std::span<const std::uint32_t> others) const {
    const FlagEdge& e = graph_.edge(longest + 1);
    Cell cell{longest + 1, {}};
    const auto append = [&](std::uint32_t w) {
      cell.vertices = cell.vertices << bits_ | Vertices(w);
    };
    auto it = others.begin();
    for (const std::uint32_t end : {e.u, e.v}) {
      while (it != others.end() && *it > end) append(*it++);
      append(end);
    }
    while (it != others.end()) append(*it++);
    return cell;
  }
  /// The vertices without slot `slot`.
  Vertices without(const Vertices& v, int slot) const {
    const Vertices above = (v >> ((slot + 1) * bits_)) << (slot * bits_);
    return above | below(v, slot);
  }
  /// The slots below `slot`; the other slots are zero.
  Vertices below(const Vertices& v, int slot) const {
    const int drop = Vertices::kBits - slot * bits_;
    return (v << drop) >> drop;
  }

  /// The slot of the smallest vertex that is not an end of the longest edge, or dim + 1.
  int first_slot_off_longest(int dim, const Cell& cell) const {
    const FlagEdge& longest = graph_.edge(cell.key);
    for (int slot = 0; slot <= dim; ++slot)
      if (const auto v = vertex(cell, slot); v != longest.u && v != longest.v) return slot;
    return dim + 1;
  }
  /// The smallest vertex below `below` that is joined, by edges whose keys are below the key of the
  /// cell, to all vertices of the cell except the vertex in slot `skipped`; kNoVertex if there is
  /// none.
  std::uint32_t first_common_neighbour(int dim, const Cell& cell, int skipped,
                                       std::uint32_t below) const;
  static constexpr std::uint32_t kNoVertex = UINT32_MAX;
  static constexpr int kNoSlot = -1;

  /// Visits each clique that consists of the given clique and `missing` smaller vertices. The keys
  /// of the added edges are at most `limit`. @param candidates the smaller vertices that are joined
  /// to all vertices of the clique.
  template <class Visit>
  void extend_clique(const Cell& clique, std::span<const Neighbour> candidates, int missing,
                     Key limit, std::vector<std::vector<Neighbour>>& scratch, Visit&& visit) const;
  /// The vertices below `below` that are joined to `from`, ascending.
  void smaller_neighbours(std::uint32_t from, std::uint32_t below,
                          std::vector<Neighbour>& out) const;

  const RipsGraph& graph_;
  int bits_;
};

template <RipsLayout Layout, int Words>
template <class Visit>
void RipsFiltration<Layout, Words>::for_each_cell(int dim, Visit&& visit) const {
  const auto n = static_cast<std::uint32_t>(graph_.size());
  if (dim < 0 || dim > top_dim()) return;
  if (dim == 0) {
    for (std::uint32_t v = 0; v < n; ++v) visit(Cell{0, Vertices(v)});
    return;
  }
  if (dim == 1) {  // in the order of the filtration
    const auto count = static_cast<std::uint32_t>(graph_.edges().size());
    for (std::uint32_t i = 0; i < count; ++i) visit(edge_cell(i));
    return;
  }
  std::vector<std::vector<Neighbour>> scratch(static_cast<std::size_t>(dim) + 1);
  std::vector<Neighbour> candidates;
  for (std::uint32_t v = 0; v < n; ++v) {
    smaller_neighbours(v, v, candidates);
    extend_clique(Cell{0, Vertices(v)}, candidates, dim, RipsAdjacency::kNever - 1, scratch, visit);
  }
}

template <RipsLayout Layout, int Words>
void RipsFiltration<Layout, Words>::smaller_neighbours(std::uint32_t from, std::uint32_t below,
                                                       std::vector<Neighbour>& out) const {
  out.clear();
  if (has_matrix()) {
    const Key* row = adjacency().row(from);
    for (std::uint32_t w = 0; w < below; ++w)
      if (row[w] != RipsAdjacency::kNever) out.push_back({w, row[w]});
  } else {
    for (const Neighbour& w : adjacency().neighbours(from)) {
      if (w.vertex >= below) break;
      out.push_back(w);
    }
  }
}

template <RipsLayout Layout, int Words>
template <class Visit>
void RipsFiltration<Layout, Words>::extend_clique(const Cell& clique,
                                                  std::span<const Neighbour> candidates,
                                                  int missing, Key limit,
                                                  std::vector<std::vector<Neighbour>>& scratch,
                                                  Visit&& visit) const {
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Neighbour& w = candidates[i];
    const Cell larger{std::max(clique.key, w.key), clique.vertices << bits_ | Vertices(w.vertex)};
    if (missing == 1) {
      visit(larger);
      continue;
    }
    // Candidates below w that are also joined to w are kept; each carries the key of its longest
    // edge to the clique.
    auto& next = scratch[static_cast<std::size_t>(missing)];
    next.clear();
    if (has_matrix()) {
      const Key* row = adjacency().row(w.vertex);
      for (std::size_t k = 0; k < i; ++k) {
        const Key key = row[candidates[k].vertex];
        if (key <= limit) next.push_back({candidates[k].vertex, std::max(key, candidates[k].key)});
      }
    } else {
      auto it = adjacency().neighbours(w.vertex).begin();
      const auto end = adjacency().neighbours(w.vertex).end();
      for (std::size_t k = 0; k < i; ++k) {
        while (it != end && it->vertex < candidates[k].vertex) ++it;
        if (it == end) break;
        if (it->vertex == candidates[k].vertex && it->key <= limit)
          next.push_back({it->vertex, std::max(it->key, candidates[k].key)});
      }
    }
    extend_clique(larger, next, missing - 1, limit, scratch, visit);
  }
}

template <RipsLayout Layout, int Words>
template <class Visit>
void RipsFiltration<Layout, Words>::for_each_facet(int dim, const Cell& cell, Visit&& visit) const {
  if (dim == 0) return;
  if (dim == 1) {
    visit(Cell{0, without(cell.vertices, 0)}, 1);
    visit(Cell{0, without(cell.vertices, 1)}, -1);
    return;
  }
  const RipsAdjacency& adjacent = adjacency();
  // A facet that contains the longest edge keeps the key.
  const FlagEdge longest = graph_.edge(cell.key);
  std::array<std::uint32_t, kMostVertices> vertices;
  for (int slot = 0; slot <= dim; ++slot)
    vertices[static_cast<std::size_t>(slot)] = vertex(cell, slot);
  for (int slot = 0; slot <= dim; ++slot) {
    const std::uint32_t gone = vertices[static_cast<std::size_t>(slot)];
    Key key = cell.key;
    if (gone == longest.u || gone == longest.v) {  // mutant: rips-facet-key
      key = 0;
      for (std::size_t i = 1; i <= static_cast<std::size_t>(dim); ++i) {
        if (vertices[i] == gone) continue;
        for (std::size_t j = 0; j < i; ++j)
          if (vertices[j] != gone) key = std::max(key, adjacent.key_of(vertices[i], vertices[j]));
      }
    }
    // mutant: rips-facet-sign
    visit(Cell{key, without(cell.vertices, slot)}, slot % 2 == 0 ? 1 : -1);
  }
}

/// Calls `use` with the filtration whose cells are just large enough for dimension max_dim + 1.
template <class Use>
decltype(auto) with_rips_filtration(const RipsGraph& graph, int max_dim, Use&& use) {
  const auto fits = [&]<class F>(std::type_identity<F>) {
    const Index capacity = F::capacity(graph);
    return Index{max_dim} + 2 <= capacity || graph.adjacency().clique_bound() <= capacity;
  };
  using Dense = RipsFiltration<RipsLayout::dense, 1>;
  using Sparse = RipsFiltration<RipsLayout::sparse, 1>;
  if (graph.points_alone()) return use(Sparse(graph));  // cells are never made
  if (fits(std::type_identity<Sparse>()))
    return graph.is_dense() ? use(Dense(graph)) : use(Sparse(graph));
  using Wide = RipsFiltration<RipsLayout::any, 4>;
  if (fits(std::type_identity<Wide>())) return use(Wide(graph));
  throw Error(
      ErrorKind::resource,
      "simplices of " +
          std::to_string(std::min<Index>(Index{max_dim} + 2, graph.adjacency().clique_bound())) +
          " vertices out of " + std::to_string(graph.size()) +
          " are too large; lower the dimension or the threshold, or subsample");
}

}  // namespace ph

template <int Words>
struct std::hash<ph::RipsCell<Words>> {
  std::size_t operator()(const ph::RipsCell<Words>& c) const { return c.vertices.hash(); }
};

#include "ph/detail/rips/rips_cofacets.ipp"
#include "ph/detail/rips/rips_filtration.ipp"
